// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts that come and go while grains move far, paper Sec. 2.3 and Eqs. 5-8.
///
/// A bonded pair keeps its contact until all its points are cracked and its centres are further apart
/// than when bonded and than the two disc radii. A new contact starts when the discs touch, without
/// cohesion, at the nearest edges of the two grains; so no energy appears.
/// Deviation D23: all points of a new contact lie in one place, between the two discs: it carries no
/// moment. The corners of cells may overlap once grains have come loose.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <array>
#include <vector>

namespace flexpm {

using GrainPair = std::array<int, 2>;  ///< the smaller first

/// Current distance of the centres of two grains [m].
double centre_distance(const Assembly& a, int grain_a, int grain_b);
double square_distance(const Assembly& a, GrainPair pair);

/// The contact has not been retired.
bool carries(const Assembly& a, int contact);

/// Distance at which two grains without a contact touch [m]: the sum of the radii, or what it was when
/// the specimen was bonded if their discs overlapped then without sharing an edge.
double touching_distance(const Assembly& a, GrainPair pair);

/// The discs of two grains without a contact touch.
bool is_touching(const Assembly& a, GrainPair pair);

/// The contact is over: only a new touch can bring the pair together again.
bool is_over(const Assembly& a, int contact);

/// Let new contacts follow the places where their discs touch now (Eq. 7) as grains roll; traction and
/// area stay, so no energy appears. Otherwise a grain would turn about a point of its outline into the
/// other. Arguments as of change_contacts(). Returns whether any contact has moved.
bool follow_touches(Assembly& a, double damping, double dt);

/// Take contacts out and put frictional ones in, in the order of pairs. Bonded contacts keep their
/// rows, retired, for the record of cracks. Masses rise where the new contacts need it; the kinetic
/// energy that this adds is booked as initial energy.
///
/// @param over     contacts to end, ascending
/// @param touching pairs without a contact that acts, ascending
/// @param damping, dt  as in scale_masses(); dt = 0 leaves the masses alone (real masses)
void change_contacts(Assembly& a, const std::vector<int>& over,
    const std::vector<GrainPair>& touching, double damping, double dt);

}  // namespace flexpm
