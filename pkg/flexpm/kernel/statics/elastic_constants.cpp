// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Solve with a strain prescribed at the ends; the constants follow from forces and widths.
#include <flexpm/kernel/statics/elastic_constants.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/specimen_strain.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include <string>
#include <vector>

namespace flexpm {

namespace {

/// Force on the specimen of a plate at its place, all contacts bonded.
Vector static_force(const Assembly& a, const Plate& plate)
{
    Vector sum;
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const StiffnessBlock k = plate_springs(plate, i);
        const auto n = a.facets.nodes(p.facet);
        const Vector u =
            plate.displacement - a.grains.vector_on_edge(a.grains.displacement, n, p.weight);
        sum.x += k.xx * u.x + k.xy * u.y;
        sum.y += k.yx * u.x + k.yy * u.y;
    }
    return sum;
}

constexpr double test_strain = 1e-3;  // any value: the solve is linear

/// Prescribe the test: the ends move axially, one point stays laterally.
std::vector<Prescribed> hold_ends(Assembly& a, double height)
{
    const std::vector<int> bottom = side_nodes(a, bottom_side), top = side_nodes(a, top_side);
    if (a.grains.is_rigid(0)) {
        const PlateContact smooth = { 0.0, 0.0, true };
        add_side_plates(a, bottom_side, 1, smooth);
        const int upper = add_side_plates(a, top_side, 1, smooth).front();
        a.plates[upper].displacement = { 0.0, test_strain * height };
        int held = 0;
        while (!is_on_side(a, held, bottom_side))
            ++held;
        return { { a.grains.centre(a.facets.grain[held]), 0.0 } };
    }
    std::vector<Prescribed> prescribed { { bottom.front(), 0.0 } };
    for (int n : bottom)
        prescribed.push_back({ a.grains.component(n, 1), 0.0 });
    for (int n : top)
        prescribed.push_back({ a.grains.component(n, 1), test_strain * height });
    return prescribed;
}

}  // namespace

ElasticConstants elastic_constants(const Assembly& a)
{
    for (int side = 0; side < 4; ++side) {
        check_positive("elastic_constants: length of side " + std::to_string(side),
            has_facets(a, side) ? side_length(a, side) : 0.0, "m");
    }
    const double width = side_length(a, bottom_side), height = side_length(a, left_side);
    Assembly solved = a;
    solved.plates.clear();
    solved.node_sets.clear();
    const std::vector<Prescribed> prescribed = hold_ends(solved, height);
    StaticSolution s = solve_static(solved, prescribed);
    solved.grains.displacement = std::move(s.displacement);
    solved.grains.force = std::move(s.force);

    double top = 0.0;
    for (const Plate& p : solved.plates) {
        if (p.side == top_side) top = static_force(solved, p).y;
    }
    if (solved.plates.empty()) top = reaction(solved, side_nodes(a, top_side), 1);
    const SpecimenStrain strain = specimen_strain(solved);
    return { top / (a.area_of(width) * strain.axial), -strain.lateral / strain.axial };
}

}  // namespace flexpm
