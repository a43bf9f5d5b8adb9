// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solid_tests/solid_parts.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/solid_tests/solid_drive.hpp>
#include <flexpm/kernel/solid_tests/solid_sets.hpp>
#include <flexpm/kernel/solid_tests/solid_softening.hpp>
#include <flexpm/kernel/solids/solid_access.hpp>
#include <flexpm/kernel/solids/solid_energies.hpp>
#include <flexpm/kernel/solids/solid_plan.hpp>
#include <flexpm/kernel/solids/solid_plates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace flexpm {

namespace {

/// Least cosine between a plate's normal and that of a triangle, inwards, that it may touch.
constexpr double facing = 0.5;
/// Share of a triangle that is none, and gap over the size of the box that is none: round-off [-].
constexpr double no_share = 1e-12, no_gap = 1e-9;
/// Strain at which all is linear, but no round-off, and such a part of the way to the first
/// softening, where the length of a test is none of the specimen's [-].
constexpr double small_strain = 1e-7, small_part = 0.1;
/// Strength of a test over the stress at which its first point softens, as of the plane [-].
constexpr double strength_over_softening = 2.0;

/// Place in a triangle: weights of its corners.
using Weights = std::array<double, 3>;

double along(const Vector& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vector at(const std::array<Vector, 3>& corners, const Weights& w)
{
    return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
}

/// Part of a polygon in which a value of its corners is not above 0.
template <class Value> std::vector<Weights> within(const std::vector<Weights>& polygon, Value value)
{
    std::vector<Weights> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Weights &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double of_a = value(a), of_b = value(b);
        if (of_a <= 0.0) kept.push_back(a);
        if ((of_a < 0.0 && of_b > 0.0) || (of_a > 0.0 && of_b < 0.0)) {
            const double part = of_a / (of_a - of_b);
            Weights crossing;
            for (int k = 0; k < 3; ++k)
                crossing[k] = a[k] + part * (b[k] - a[k]);
            kept.push_back(crossing);
        }
    }
    return kept;
}

/// What of a triangle lies in a box: its share of the area, and its middle.
struct Piece {
    double share = 0.0;
    Weights middle {};
};

Piece piece_in(const std::array<Vector, 3>& corners, const SolidPatch& box)
{
    std::vector<Weights> polygon { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    for (int axis = 0; axis < 3; ++axis) {
        const double low = along(box.low, axis), high = along(box.high, axis);
        polygon =
            within(polygon, [&](const Weights& w) { return low - along(at(corners, w), axis); });
        polygon =
            within(polygon, [&](const Weights& w) { return along(at(corners, w), axis) - high; });
    }
    Piece piece;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Weights &p = polygon[0], &q = polygon[i], &r = polygon[i + 1];
        // a triangle of weights has this share of the whole one
        const double share = (q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1]);
        piece.share += share;
        for (int k = 0; k < 3; ++k)
            piece.middle[k] += share / 3.0 * (p[k] + q[k] + r[k]);
    }
    if (piece.share > no_share)
        for (double& weight : piece.middle)
            weight /= piece.share;
    return piece;
}

void check(const SolidState& s, const PartGeometry& parts)
{
    check_positive("area of a test's load", parts.area, "m^2");
    check_positive("length of a test's displacement", parts.length, "m");
    if (parts.driven.empty() && parts.driven_sets.empty())
        refuse("driven parts", 0.0, "", "must be at least 1");
    for (const auto& sets : { parts.driven_sets, parts.back_sets, parts.holding_sets }) {
        for (int n : sets) {
            if (n >= 0 && n < static_cast<int>(s.node_sets.size())) continue;
            refuse("part", n, "", "must be the number of a node set; add one first");
        }
    }
    for (const auto& plates : { parts.driven, parts.holding }) {
        for (int p : plates) {
            if (p >= 0 && p < static_cast<int>(s.plates.size())) continue;
            refuse("part", p, "", "must be the number of a plate; lay one first");
        }
    }
}

double push(const SolidState& s, const std::vector<int>& plates, const std::vector<int>& sets,
    Vector direction)
{
    double sum = 0.0;
    for (int p : plates)
        sum += dot(s.plates[p].force, direction);
    for (int n : sets)
        sum += dot(s.node_sets[n].force, direction);
    return sum;
}

/// Sum of the moments of what turns.
double moment_of(const SolidState& s, const PartGeometry& parts)
{
    double sum = 0.0;
    drive_of(parts).for_each_set([&](int set, double sense) {
        sum += sense * dot(s.node_sets[set].moment, parts.direction);
    });
    return sum;
}

/// Way of what is driven first, or its angle.
double way_of(const SolidState& s, const PartGeometry& parts)
{
    if (!parts.driven.empty())
        return dot(s.plates[parts.driven.front()].displacement, parts.direction);
    const NodeSet& first = s.node_sets[parts.driven_sets.front()];
    return dot(parts.turn ? first.angle : first.displacement, parts.direction);
}

/// Forces along the loading: of the holding plates and of the driven ones; of what turns moments.
EndForces ends_of(const SolidState& s, const PartGeometry& parts)
{
    const double top = parts.turn ? moment_of(s, parts)
                                  : push(s, parts.driven, parts.driven_sets, parts.direction);
    if (parts.holding.empty() && parts.holding_sets.empty()) return { -top, top };
    return { push(s, parts.holding, parts.holding_sets, parts.direction), top };
}

Plate plate_before(const SolidState& s, const SolidPatch& patch)
{
    check_not_negative("friction of a plate", patch.friction, "");
    if (patch.bonded && patch.friction > 0.0)
        refuse("friction of a plate", patch.friction, "", "must be 0 of one that is bonded");
    if (!(std::fabs(norm(patch.normal) - 1.0) < no_gap))
        refuse("normal of a plate", norm(patch.normal), "", "must be a unit vector");
    Plate p = plain_plate(s, SolidSide::bottom);
    p.side = -1;
    p.normal = patch.normal;
    p.bonded = patch.bonded;
    double nearest = std::numeric_limits<double>::infinity();
    for (int t = 0; t < static_cast<int>(s.surface.grain.size()); ++t) {
        const Vector outwards = area_vector(s, t);
        if (!(-dot(p.normal, outwards) > facing * norm(outwards))) continue;
        std::array<Vector, 3> corners;
        for (int k = 0; k < 3; ++k)
            corners[k] = space_vector(s.grains.reference, s.surface.nodes[t][k]);
        const Piece piece = piece_in(corners, patch);
        if (!(piece.share > no_share)) continue;
        p.facets.push_back(t);
        p.shares.insert(p.shares.end(), piece.middle.begin(), piece.middle.end());
        p.area.push_back(piece.share * norm(outwards));
        p.width += p.area.back();
        const Vector place = at(corners, piece.middle);
        p.position = p.position + p.area.back() * place;
        p.gap.push_back(dot(p.normal, place));
        nearest = std::min(nearest, p.gap.back());
    }
    if (p.facets.empty()) {
        refuse("triangles before a plate", 0.0, "", "must be above 0; lay it on the specimen");
    }
    p.position = (1.0 / p.width) * p.position;
    const double none = no_gap * norm(patch.high - patch.low);
    for (double& gap : p.gap)
        gap = p.bonded || gap - nearest < none ? 0.0 : gap - nearest;
    p.opening = p.gap;
    if (patch.friction > 0.0) roughen(p, patch.friction);
    return p;
}

}  // namespace

int add_patch_plate(SolidState& s, const SolidPatch& patch)
{
    const Plate plate = plate_before(s, patch);
    require_apart(s, plate);
    return add_plate(s, plate);
}

int find_patch_plate(const SolidState& s, const SolidPatch& patch)
{
    return find_alike(s, plate_before(s, patch));
}

SolidFrame solid_part_frame(const SolidState& s, const PartGeometry& parts)
{
    check(s, parts);
    SolidFrame frame;
    frame.area = parts.area;
    frame.height = parts.length;
    frame.sense = Sense::tension;
    frame.ends = [parts](const SolidState& now) { return ends_of(now, parts); };
    frame.strains = [parts](const SolidState& now) {
        return TestStrains { way_of(now, parts) / parts.length,
            std::numeric_limits<double>::quiet_NaN() };
    };
    return frame;
}

SolidDrive drive_of(const PartGeometry& parts)
{
    return { parts.driven, parts.direction, 1.0, parts.driven_sets, parts.back_sets,
        parts.turn != 0.0 };
}

SolidPartState elastic_part_state(const SolidState& s, const PartGeometry& parts, double dt)
{
    check(s, parts);
    const SolidField field = elastic_field(s, drive_of(parts));
    SolidPartState found { s };
    found.softening = elastic_strain(s, field, 1.0);  // a way: the field is that of 1 m
    found.way = std::min(small_strain * parts.length, small_part * found.softening);
    start(found.state, drive_of(parts), field, found.way, 1.0, true, dt);
    sum_node_sets(found.state, 0.0);
    const EndForces ends = ends_of(found.state, parts);
    found.load = 0.5 * (ends.top - ends.bottom);
    return found;
}

TestScales solid_part_scales(
    const SolidState& s, const PartGeometry& parts, double strength, double dt)
{
    check_not_negative("strength", strength, "Pa");
    const SolidPartState moved = elastic_part_state(s, parts, dt);
    const double stiffness = moved.load / moved.way, softening = moved.softening;
    check_positive("stiffness that the driven plates feel", stiffness, "N/m");
    const double mass = 2.0 * kinetic_of_velocities(moved.state);
    const double width = std::sqrt(parts.area), modulus = stiffness * parts.length / parts.area;
    if (strength == 0.0) strength = strength_over_softening * softening / parts.length * modulus;
    return { std::sqrt(3.0 * mass / stiffness) / dt, modulus, strength, parts.length, width,
        scale_inputs(s, Sense::tension, width, dt).damage_share };
}

}  // namespace flexpm
