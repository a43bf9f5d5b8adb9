// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Stresses of the elements of a grain and of the whole grain, in 2D and in 3D. Tension
/// positive, SI units.
#pragma once

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/fem/triangle.hpp>
#include <flexpm/kernel/law/solid_elastic.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <array>
#include <type_traits>

namespace flexpm {

/// A triangle or a tetrahedron.
template <int Corners> struct Element {
    double volume = 0.0;                ///< when bonded [m^3]
    double present_volume = 0.0;        ///< as deformed [m^3]
    std::array<int, Corners> nodes {};  ///< offsets
    SpaceTensor stress {};              ///< Cauchy; zz, yz and xz are left out in 2D [Pa]
};

/// Call visit(element) for each triangle of a grain; a rigid one has none.
template <class Visit> void for_each_element(const Assembly& a, int grain, Visit visit)
{
    const Grains& grains = a.grains;
    const PlaneStiffness c = stiffness_of(grains, grain);
    for (int t = 0; t < triangles_of(grains, grain); ++t) {
        const TriangleShape shape = shape_of(grains, grain, t);
        const std::array<int, 3> numbers = triangle_nodes(grains, grain, t);
        Element<3> e;
        for (std::size_t k = 0; k < numbers.size(); ++k)
            e.nodes[k] = grains.node(grain, numbers[k]);
        const auto u = [&](int k) { return grains.displacement_at(e.nodes[k]); };
        const Gradient h = displacement_gradient(shape, u(0), u(1), u(2));
        const Tensor stress = cauchy_stress(shape, c, u(0), u(1), u(2));
        e.volume = shape.volume;
        e.present_volume = ((1.0 + h.xx) * (1.0 + h.yy) - h.xy * h.yx) * shape.volume;
        e.stress = { stress.xx, stress.yy, 0.0, 0.0, 0.0, stress.xy };
        visit(e);
    }
}

/// Call visit(element) for each tetrahedron of a grain; those of a rigid one have no stress.
template <class Visit> void for_each_element(const SolidState& s, int grain, Visit visit)
{
    const Grains& grains = s.grains;
    const int block = grains.block_of(grain);
    const PlaneStiffness c = stiffness_of(grains, grain);
    const auto add = [&](const TetrahedronShape& shape, std::array<int, 4> n) {
        Element<4> e { shape.volume, shape.volume, n, {} };
        if (!grains.is_rigid(grain)) {
            const auto place = [&](int k) { return grains.position(n[k]); };
            const auto u = [&](int k) { return grains.vector(grains.displacement, n[k]); };
            const Vector first = place(0);
            e.present_volume = triple(place(1) - first, place(2) - first, place(3) - first) / 6.0;
            e.stress = cauchy_stress(shape, c, u(0), u(1), u(2), u(3));
        }
        visit(e);
    };
    for_each_tetrahedron(s, block, add);
}

/// Call visit(force, arm) for each corner of a grain: the force on it [N], and its place from the
/// centre [m].
///
/// @param forces  of the state, see node_forces()
template <class Visit>
void for_each_corner_force(
    const Grains& grains, const Array<double>& forces, int grain, Visit visit)
{
    const Vector centre = grains.position(grains.centre(grain));
    for (int n = 0; n < grains.vertices_of(grain); ++n) {
        const int node = grains.node(grain, n);
        visit(grains.vector(forces, node), grains.position(node) - centre);
    }
}

/// Sum of two tensors, the second times a factor.
SpaceTensor sum_of(const SpaceTensor& a, double factor, const SpaceTensor& b);

/// Symmetric part of the product of a force and a place.
SpaceTensor product_of(Vector force, Vector place);

/// Area of a grain when bonded, in 2D [m^2].
double cell_area(const Grains& grains, int grain);

/// Volume of a grain when bonded, and its mean Cauchy stress.
struct GrainStress {
    double volume = 0.0;    ///< [m^3]
    SpaceTensor stress {};  ///< of a rigid grain by the forces on it, in balance [Pa]
};

/// The mean over the volume of a sum of stresses times volumes, or of the forces on a rigid grain.
SpaceTensor mean_stress(const Grains& grains, const Array<double>& forces, int grain,
    const SpaceTensor& sum, double volume);

/// The same, with visit(element) for each element.
template <class State, class Visit> GrainStress grain_stress(const State& s, int grain, Visit visit)
{
    GrainStress mean;
    for_each_element(s, grain, [&](const auto& element) {
        mean.stress = sum_of(mean.stress, element.volume, element.stress);
        mean.volume += element.volume;
        visit(element);
    });
    if constexpr (std::is_same_v<State, Assembly>)
        if (s.grains.is_rigid(grain)) mean.volume = s.volume_of(cell_area(s.grains, grain));
    mean.stress = mean_stress(s.grains, node_forces(s), grain, mean.stress, mean.volume);
    return mean;
}

template <class State> GrainStress grain_stress(const State& s, int grain)
{
    return grain_stress(s, grain, [](auto&&) {});
}

}  // namespace flexpm
