// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Reading the state of a 3D specimen: geometry, tractions and forces of the faces between
/// its grains, and velocities of nodes. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/space/face_frame.hpp>

#include <vector>

namespace flexpm {

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

/// Where the points of a contact are, along its frame; of a face without area 0.
std::vector<FacePlace> places_of(const SolidState& s, int contact);

/// Whether all bonds of a contact have gone, those of a joint without strength from the start.
bool is_cracked_through(const FaceContacts& contacts, int contact);

/// Leave no strength to a point that a load could take: it never counts as a crack.
inline void take_strength(FaceContacts& contacts, int contact, int point)
{
    contacts.set_state(contact, point, FaceRow::shear_damage, 1.0);
}

/// Friction of a point, which falls after a crack [-].
inline double friction_of(const FaceContacts& contacts, int contact, int point)
{
    return law::friction_after(
        contacts.law_of(contact), contacts.state(contact, point, FaceRow::crack_slip));
}

/// Pairs of grains whose faces lie on each other, ascending.
std::vector<GrainPair> mated_pairs(const SolidState& s);

/// Index of a pair of near grains without a common face; -1: there is none.
int pair_number(const SolidState& s, const GrainPair& grains);

/// What a point bears at a place, by its state, or where it is.
FaceTraction traction_of(const FaceContacts& contacts, int contact, int point, FacePlace place);
FaceTraction traction_of(const SolidState& s, int contact, int point);

/// Mean opening of its points, by their areas [m].
double mean_opening(const SolidState& s, int contact);

/// Forces of the points of a contact on its second grain: areas times tractions [N]; 0 if its face
/// has no area.
std::vector<Vector> point_forces(const SolidState& s, int contact);

/// Force of a contact on its second grain; that on the first is the opposite [N].
Vector contact_force(const SolidState& s, int contact);

/// Velocity of a node, of a rigid grain by its motion [m/s].
Vector node_velocity(const SolidState& s, int grain, int node);

}  // namespace flexpm
