// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/reference_point.hpp>
#include <flexpm/kernel/geometry/tessellation.hpp>
#include <flexpm/kernel/tiling/diagonals.hpp>
#include <flexpm/kernel/tiling/joint_cut.hpp>

#include "fuzz/bytes.hpp"
#include "fuzz/holds.hpp"
#include "fuzz/targets.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace fuzz {

namespace {

using flexpm::Disc;
using flexpm::JointLine;
using flexpm::Outline;
using flexpm::Point;
using flexpm::Tessellation;

/// Discs in rows in a unit square, each as far from its place as the bytes say.
std::vector<Disc> draw_discs(Bytes& bytes)
{
    const int rows = bytes.whole(1, 5);
    const double size = 1.0 / rows;
    const bool same = bytes.flag();
    std::vector<Disc> discs;
    for (int i = 0; i < rows * rows; ++i) {
        const double x = (i % rows + 0.5) * size, y = (i / rows + 0.5) * size;
        const double aside = 0.05 * bytes.whole(-4, 4), up = 0.05 * bytes.whole(-4, 4);
        discs.push_back({ { x + aside * size, y + up * size },
            (same ? 0.5 : 0.35 + 0.15 * bytes.share()) * size });
    }
    return discs;
}

/// On a coarse lattice at times: lines along sides, over vertices and along each other.
double coordinate(Bytes& bytes)
{
    const double place = bytes.flag() ? 1.2 * bytes.share() - 0.1 : 0.05 * bytes.whole(-2, 22);
    return bytes.wild(place);
}

std::vector<JointLine> draw_lines(Bytes& bytes)
{
    std::vector<JointLine> lines;
    for (int k = bytes.whole(1, 12); k > 0; --k) {
        JointLine line;
        line.joint = bytes.whole(0, 1);
        for (int i = bytes.whole(1, 4); i >= 0; --i) {
            const double x = coordinate(bytes), y = coordinate(bytes);
            line.points.push_back({ x, y });
        }
        lines.push_back(line);
    }
    return lines;
}

/// No sliver, no sharp corner, no edge without length, all edges seen from the centre of the disc.
bool is_sound(const std::vector<Point>& polygon, const Disc& disc, double mean_area)
{
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point next = polygon[(k + 1) % polygon.size()];
        if (!(flexpm::norm(next - polygon[k]) > 1e-6 * std::sqrt(mean_area))) return false;
        if (!(flexpm::angle_at(polygon, k) >= (1.0 - 1e-9) * flexpm::least_angle)) return false;
    }
    const double least = (1.0 - 1e-9) * flexpm::least_piece * mean_area;
    return flexpm::polygon_shape(polygon).area >= least
        && flexpm::clearance(polygon, disc.centre) > 0.0;
}

bool all_sound(const Tessellation& t, const std::vector<Disc>& discs, double mean_area)
{
    for (int c = 0; c < t.cells(); ++c)
        if (!is_sound(flexpm::cell_polygon(t, c), discs[c], mean_area)) return false;
    return true;
}

}  // namespace

void joints(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    try {
        const std::vector<Disc> discs = draw_discs(bytes);
        const std::vector<JointLine> lines = draw_lines(bytes);
        const Outline square =
            Outline::polygon({ { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } });
        const Tessellation cells = flexpm::tessellate(discs, square, {});
        const double mean_area = 1.0 / cells.cells();
        if (!all_sound(cells, discs, mean_area)) return;
        const flexpm::JointCut made = flexpm::cut_by_joints(cells, discs, {}, lines);
        const flexpm::Tiling& cut = made.tiling;
        require(all_sound(cut.cells, cut.discs, mean_area), "pieces are sound");
        double area = 0.0;
        for (int c = 0; c < cut.cells.cells(); ++c)
            area += flexpm::cell_area(cut.cells, c);
        require(std::abs(area - 1.0) < 1e-12, "the whole area is there");
        for (const flexpm::LineCut& line : made.lines) {
            const double sum = line.cut + line.taken + line.outside;
            require(line.cut >= 0.0 && line.taken >= 0.0 && line.outside >= 0.0
                    && sum <= (1.0 + 1e-9) * line.length,
                "parts of a line are no longer than the line");
            require(line.contacts > 0 || line.cut == 0.0, "what is cut has a contact");
        }
    } catch (const std::invalid_argument&) {
    }
}

}  // namespace fuzz
