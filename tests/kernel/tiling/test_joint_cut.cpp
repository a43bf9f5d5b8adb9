// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells cut by lines, and the onset of slip on the contact of two driven blocks. SI units,
/// tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/tiling/joint_cut.hpp>

#include "support/driven.hpp"

using namespace driven;
using flexpm::ContactMaterial;
using flexpm::PointState;

namespace {

constexpr double size = 3e-3;  // [m]

flexpm::Tiling cut_grid(int columns, int rows, const std::vector<std::vector<Point>>& lines)
{
    const specimens::Specimen grid = specimens::grid(columns, rows, size);
    std::vector<flexpm::JointLine> all;
    for (const auto& points : lines)
        all.push_back({ points, static_cast<int>(all.size()) });
    return flexpm::cut_by_joints(grid.cells, grid.discs, {}, all).tiling;
}

double joint_length(const flexpm::Tiling& tiling, int joint)
{
    double length = 0.0;
    for (std::size_t e = 0; e < tiling.edge_joint.size(); ++e) {
        const flexpm::SharedEdge& edge = tiling.cells.shared_edges[e];
        if (tiling.edge_joint[e] == joint)
            length += flexpm::norm(
                tiling.cells.vertices[edge.vertex_1] - tiling.cells.vertices[edge.vertex_0]);
    }
    return length;
}

ContactMaterial joint(double cohesion, double tensile, double friction)
{
    ContactMaterial m = specimens::granite_contact();
    m.cohesion = cohesion;
    m.tensile_strength = tensile;
    m.friction = friction;
    m.tensile_fracture_energy = m.shear_fracture_energy = 0.0;
    return m;
}

/// Two square blocks side by side with a joint between them, all nodes held.
Assembly two_blocks(const ContactMaterial& law)
{
    flexpm::AssemblyOptions options = specimens::options();
    options.joints = { law };
    options.edge_joint = { 0 };
    Assembly a = specimens::assemble(specimens::grid(2, 1, size), options);
    hold_all(a);
    return a;
}

/// Largest shear traction of the blocks under a pressure [Pa].
double onset(const ContactMaterial& law, double pressure)
{
    Assembly a = two_blocks(law);
    const double area = size * specimens::thickness;
    set_velocity(a, 1, Point { -pressure / law.normal_stiffness / 100.0, 0.0 });
    run(a, 100);
    const double limit = law.cohesion + law.friction * pressure;
    const double way = 1.2 * limit / (law.shear_ratio * law.normal_stiffness);
    set_velocity(a, 1, Point { 0.0, way / 4000.0 });
    double largest = 0.0;
    for (int i = 0; i < 4000; ++i) {
        run(a, 1);
        largest = std::max(largest, std::fabs(resultant(a, 0).y) / area);
    }
    return largest;
}

}  // namespace

TEST_CASE("A line cuts squares into halves", "[tiling]")
{
    const double middle = 0.5 * size;
    const flexpm::Tiling tiling = cut_grid(3, 1, { { { -size, middle }, { 4 * size, middle } } });
    CHECK(tiling.cells.cells() == 6);
    CHECK(joint_length(tiling, 0) == Approx(3 * size));
    for (int c = 0; c < 6; ++c)
        CHECK(flexpm::cell_area(tiling.cells, c) == Approx(0.5 * size * size));
    CHECK(tiling.origin == std::vector<int> { 0, 1, 2, 0, 1, 2 });
}

TEST_CASE("The end of a line within a cell goes on or back by half of the cell", "[tiling]")
{
    const double middle = 0.5 * size;
    CHECK(joint_length(cut_grid(3, 1, { { { 0.0, middle }, { 1.4 * size, middle } } }), 0)
        == Approx(size));
    CHECK(joint_length(cut_grid(3, 1, { { { 0.0, middle }, { 1.6 * size, middle } } }), 0)
        == Approx(2 * size));
}

TEST_CASE("Vertices near a line are moved onto it", "[tiling]")
{
    const flexpm::Tiling tiling =
        cut_grid(3, 2, { { { 0.0, 1.05 * size }, { 3 * size, 0.97 * size } } });
    CHECK(tiling.cells.cells() == 6);
    CHECK(joint_length(tiling, 0) == Approx(size * std::hypot(3.0, 0.08)).epsilon(1e-12));
}

TEST_CASE("A cut that would leave a sliver is not made", "[tiling]")
{
    const auto corner_cut = [](double length) {
        return cut_grid(2, 1, { { { 0.0, length * size }, { length * size, 0.0 } } });
    };
    CHECK(corner_cut(0.18).cells.cells() == 2);  // 1.6 % of a cell
    CHECK(joint_length(corner_cut(0.18), 0) == 0.0);
    CHECK(corner_cut(0.22).cells.cells() == 3);  // 2.4 %
    const auto wedge = [](double degrees) {
        const double rise = size * std::tan(degrees * flexpm::pi / 180.0);
        return cut_grid(1, 1, { { { 0.0, 0.0 }, { size, rise } } }).cells.cells();
    };
    CHECK(wedge(4.0) == 1);
    CHECK(wedge(8.0) == 2);
}

TEST_CASE("Crossing lines cut four pieces", "[tiling]")
{
    const flexpm::Tiling tiling = cut_grid(1, 1,
        { { { -size, 0.5 * size }, { 2 * size, 0.5 * size } },
            { { 0.5 * size, -size }, { 0.5 * size, 2 * size } } });
    CHECK(tiling.cells.cells() == 4);
    CHECK(joint_length(tiling, 0) == Approx(size));
    CHECK(joint_length(tiling, 1) == Approx(size));
}

TEST_CASE("Two driven blocks slip at c + sigma tan(phi)", "[tiling]")
{
    for (double pressure : { 0.0, 5e6, 40e6 }) {
        const ContactMaterial strong = joint(12e6, 4e6, 0.6);
        CHECK(onset(strong, pressure)
            == Approx(strong.cohesion + strong.friction * pressure).epsilon(1e-3));
        if (pressure == 0.0) continue;
        const ContactMaterial cracked = joint(0.0, 0.0, 0.35);
        CHECK(onset(cracked, pressure) == Approx(cracked.friction * pressure).epsilon(1e-3));
    }
}

TEST_CASE("A joint without strength is cracked from the start and no crack", "[tiling]")
{
    Assembly a = two_blocks(joint(0.0, 0.0, 0.35));
    for (int p = 0; p < 3; ++p)
        CHECK(a.contacts.state(0, p, &PointState::shear_damage) == 1.0);
    set_velocity(a, 1, Point { 1e-9, 1e-9 });
    run(a, 100);
    CHECK(resultant(a, 0).x == 0.0);
    set_velocity(a, 1, Point { -3e-9, 0.0 });
    run(a, 100);
    CHECK(resultant(a, 0).x < 0.0);
    for (auto mode : a.contacts.crack_modes)
        CHECK(mode == flexpm::intact);
    CHECK(flexpm::energies(a).damage == 0.0);
}

TEST_CASE("Points of a line that are nearer than round-off count once", "[tiling]")
{
    const Point left { 0.0, 0.5 * size }, right { 3.0 * size, 0.5 * size };
    const Point below { 0.0, 0.5 * size - 5e-324 }, beside { 5e-324, 0.5 * size };
    const double straight = joint_length(cut_grid(3, 1, { { left, right } }), 0);
    CHECK(straight == Approx(3.0 * size));
    CHECK(joint_length(cut_grid(3, 1, { { left, left, beside, below, right } }), 0) == straight);
    const Point aside { left.x + 1e-14 * size, left.y };
    CHECK_THROWS_WITH(cut_grid(3, 1, { { left, aside } }), Catch::Contains("without length"));
}

TEST_CASE("Strengths of which one is zero", "[tiling]")
{
    const flexpm::LawParameters p = flexpm::joint_law(joint(10e6, 0.0, 0.5));
    CHECK(p.tensile_strength == Approx(10.0));
    CHECK(p.cohesion == 10e6);
    CHECK_FALSE(flexpm::is_cracked(joint(10e6, 0.0, 0.5)));
    CHECK_THROWS_WITH(
        flexpm::joint_law(joint(-1.0, 0.0, 0.5)), Catch::Contains("cohesion = -1 Pa"));
}
