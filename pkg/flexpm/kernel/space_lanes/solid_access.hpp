// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Reading the state of a solid: access.hpp in space, with geometry and forces of its
/// contacts, and what acts on its grains. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>
#include <flexpm/kernel/space/face_frame.hpp>

#include <vector>

namespace flexpm {

/// Law of a contact between two grains of the material of `grain`.
inline const LawParameters& own_law(const SolidState& s, int grain)
{
    return s.contacts.laws[s.grains.law_index(grain, grain)];
}

/// Corners of a contact's middle face, with displacements that are `factor` times larger [m].
std::vector<Vector> middle_face(const SolidState& s, int contact, double factor = 1.0);

/// Unit normal of a polygon, from the side of which it is counter-clockwise; 0 if it has no area.
Vector normal_of(const std::vector<Vector>& corners);

/// Normal of a contact, from the first grain to the second; 0 if grains have flown so far that
/// their faces have no area any more.
Vector contact_normal(const SolidState& s, int contact);

/// Normal of a contact, from the first grain to the second, and its tangents.
/// @throws std::invalid_argument  if the face has no area
FaceFrame contact_frame(const SolidState& s, int contact);

/// Where a point of a contact is on its middle face [m].
Vector point_place(
    const FaceContacts& contacts, int contact, int point, const std::vector<Vector>& middle);

/// Mean place of its points, by their areas [m].
Vector contact_middle(const SolidState& s, int contact);

/// Area of a surface triangle at the reference along its normal, outwards [m^2].
Vector area_vector(const SolidState& s, int triangle);

/// Area of a contact when bonded [m^2].
double contact_area(const FaceContacts& contacts, int contact);

/// Where the points of a contact are, along its frame; of a face without area 0.
std::vector<FacePlace> places_of(const SolidState& s, int contact);

/// What a point bears at a place, by its state, or where it is.
FaceTraction traction_of(const FaceContacts& contacts, int contact, int point, FacePlace place);
FaceTraction traction_of(const SolidState& s, int contact, int point);

/// Mean opening of its points, by their areas [m].
double mean_opening(const SolidState& s, int contact);

/// Stiffnesses of a bond as a whole while it is intact [N/m].
BondStiffness bond_stiffness(const FaceContacts& contacts, int contact);

/// Forces of the points of a contact on its second grain: areas times tractions [N]; 0 if its face
/// has no area.
std::vector<Vector> point_forces(const SolidState& s, int contact);

/// Force of a contact on its second grain; that on the first is the opposite [N].
Vector contact_force(const SolidState& s, int contact);

/// Velocity of a node, of a rigid grain by its motion [m/s].
Vector node_velocity(const SolidState& s, int grain, int node);

/// Volume of a grain when bonded, and its mean Cauchy stress.
struct GrainStress {
    double volume = 0.0;    ///< [m^3]
    SpaceTensor stress {};  ///< of a rigid grain by the forces on it, in balance [Pa]
};

/// The same, with visit(shape, nodes, stress) for each tetrahedron, of a rigid grain without
/// stress.
template <class Visit> GrainStress grain_stress(const SolidState& s, int grain, Visit visit);

inline GrainStress grain_stress(const SolidState& s, int grain)
{
    return grain_stress(s, grain, [](auto&&...) {});
}

/// Sum of two tensors, the second times a factor.
SpaceTensor sum_of(const SpaceTensor& a, double factor, const SpaceTensor& b);

/// Mean stress of a rigid grain in balance, by the forces on its corners [Pa].
SpaceTensor stress_by_forces(const SolidState& s, int grain, double volume);

template <class Visit> GrainStress grain_stress(const SolidState& s, int grain, Visit visit)
{
    const Grains& grains = s.grains;
    const int block = grains.block_of(grain);
    const auto c =
        load_rows<PlaneStiffness>(&grains.stiffness[block * row_count<PlaneStiffness> * lanes], 0);
    GrainStress mean;
    for_each_tetrahedron(s, block, [&](const TetrahedronShape& t, std::array<int, 4> nodes) {
        SpaceTensor own {};
        if (!grains.is_rigid(grain)) {
            const auto way = [&](int k) { return space_vector(grains.displacement, nodes[k]); };
            own = cauchy_stress(t, c, way(0), way(1), way(2), way(3));
            mean.stress = sum_of(mean.stress, t.volume, own);
        }
        mean.volume += t.volume;
        visit(t, nodes, own);
    });
    mean.stress = grains.is_rigid(grain) ? stress_by_forces(s, grain, mean.volume)
                                         : sum_of({}, 1.0 / mean.volume, mean.stress);
    return mean;
}

}  // namespace flexpm
