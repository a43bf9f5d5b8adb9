// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bonds that have cracked through: their grains meet at the faces that the bond has left.
///
/// Deviation D59: as long as the two faces of a bond lie as they did, is_facing(), the opening of
/// its points is that between the faces, and its normal is across them: the pair meets again where
/// it was bonded, whether its discs touched there or not, and slides along its faces. The further
/// they part beyond that, parting(), the more its normal turns to the line of the centres, as discs
/// have it; once it bears nothing and they have parted for good it ends, also where the discs
/// touch, and the touch goes on. A normal turns slowly while it bears something, so that the force
/// goes over. Joints have rules of their own, joint_faces.hpp.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// Whether a contact is a bond between grains of the rock or particles that has no strength left.
bool is_crack(const Contacts& contacts, int contact);

/// Whether the normal of a bond that has cracked is across its faces, and not along the centres.
bool is_between_faces(const Contacts& contacts, int contact);

/// Distance of the centres of two grains when bonded [m].
double bonded_distance(const Grains& grains, GrainPair pair);

/// Whether a point of a contact bears compression.
bool presses(const Contacts& contacts, int contact);

/// Whether the faces of a crack are so near that it is kept though it is open.
bool is_watched(const Assembly& a, int contact);

/// Whether a crack bears nothing and its faces have parted for good. Its points would go on at
/// places that lie elsewhere now: the pair counts as discs.
bool has_parted(const Assembly& a, int contact);

/// What follow_cracks() has changed.
struct CrackChanges {
    bool any = false;              ///< contacts have other normals, or have come or gone
    std::vector<GrainPair> pairs;  ///< of those that have come or gone, ascending
};

/// Let bonds that have cracked through follow their faces or discs, and let those that have ended
/// act again where their faces come near; a touch of that pair which bears nothing ends. No force
/// begins or ends with that, up to what would raise energy; what stored energy loses is booked as
/// friction. Arguments as of change_contacts().
CrackChanges follow_cracks(Assembly& a, double damping, double dt);

}  // namespace flexpm
