// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts that come and go while grains move far, paper Sec. 2.3 and Eqs. 5-8.
///
/// A bonded pair keeps its contact until all its points are cracked, none of them presses and its
/// centres are further apart than when bonded and than the two disc radii; where its faces still
/// lie as they did it is kept or taken up again, crack_faces.hpp (D59). A new contact starts when
/// the discs touch, without cohesion, at the nearest edges of the two grains; so no energy appears.
/// Contacts of joints follow their faces.
/// Deviation D23: all points of a new contact lie in one place, between the two discs: it carries
/// no moment. The corners of cells may overlap once grains have come loose.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// From the centre of the first grain of a pair to that of the second, now [m].
Point between_centres(const Grains& grains, GrainPair pair);

/// Current distance of the centres of two grains [m].
double centre_distance(const Grains& grains, GrainPair pair);

/// Its square, at less cost [m^2].
double square_distance(const Grains& grains, GrainPair pair);

/// Whether a contact has not been removed.
bool is_active(const Contacts& contacts, int contact);

/// Distance at which two grains without a contact touch [m]: the sum of the radii, or what it was
/// when the specimen was bonded if their discs overlapped then without sharing an edge.
double touching_distance(const Assembly& a, GrainPair pair);

/// Whether the discs of two grains without a contact touch.
bool is_touching(const Assembly& a, GrainPair pair);

/// Whether neither the points of a cracked contact nor the distance of its centres hold its grains
/// together: none of them presses, and the centres are further apart than when bonded and than
/// where the discs touch.
bool is_apart(const Assembly& a, int contact);

/// Whether a contact joins its grains: it is bonded or touches. Faces that are kept because they
/// are near do not (D57).
bool joins(const Assembly& a, int contact);

/// Whether only a new touch can bring the pair of a contact together again. No contact of a joint
/// ends so: follow_faces() ends it.
bool has_ended(const Assembly& a, int contact);

/// Contacts that have ended, ascending. A pair that shares several edges keeps all of its contacts
/// until the last has.
std::vector<int> ended_contacts(const Assembly& a);

/// Prepare the next step after rows of contacts have changed. Masses rise where these need it.
/// Arguments as of change_contacts().
void renew_step(Assembly& a, double damping, double dt);

/// Let new contacts follow the places where their discs touch now (Eq. 7) as grains roll; traction
/// and area stay, so no energy appears. Otherwise a grain would turn about a point of its outline
/// into the other. Arguments as of change_contacts(). Returns whether any contact has moved.
bool follow_touches(Assembly& a, double damping, double dt);

/// Let contacts of joints act between the parts of faces that lie opposite to each other now,
/// pair_faces(). What that changes in stored energy is booked as friction. Arguments as of
/// change_contacts().
/// @return pairs of grains whose contacts have moved, come or gone, ascending
std::vector<GrainPair> follow_faces(Assembly& a, double damping, double dt);

/// Take contacts out and put frictional ones in, in the order of pairs, and prepare the next step.
/// New ones get numbers (Contacts::id) that no contact has had. Bonded contacts keep their rows,
/// removed, for the record of cracks. Masses rise where the new contacts need it; the kinetic
/// energy that this adds counts as initial energy.
///
/// @param ended     contacts to end, ascending
/// @param touching  pairs without an active contact, ascending
/// @param damping, dt  as in scale_masses(); dt = 0 leaves the masses alone (real masses)
void change_contacts(Assembly& a, const std::vector<int>& ended,
    const std::vector<GrainPair>& touching, double damping, double dt);

}  // namespace flexpm
