// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear solution of a specimen in space between its ends, by conjugate gradients, for
/// grains that deform or are rigid. SI units.
#pragma once

#include <flexpm/kernel/space/face_frame.hpp>
#include <flexpm/kernel/statics/linear_solid.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>

namespace flexpm {

/// Displacements of the intact, unloaded specimen at an axial strain of 1, with held ends
/// (hold_ends()): of deformable grains as solid_extension() has it, of rigid ones between their
/// plates, and of a disc between those that touch it (add_disc_plates()). The bottom stays.
///
/// @param threads  that share the solution, without a change to its bits
/// @throws std::invalid_argument  unless ends are held, or if faces of rigid grains are
/// @throws std::runtime_error  if the forces do not come to balance
SolidField elastic_field(const SolidState& s, int threads = 1);

/// Load on a plate that is free to move along its normal.
struct PlateLoad {
    int plate;
    double force;  ///< into the specimen [N]
};

/// What loads a specimen: plates and node sets that go a way, node sets that turn, or the nodes of
/// its top along z.
struct SolidDrive {
    std::vector<int> plates = {};          ///< their numbers
    Vector direction = { 0.0, 0.0, 1.0 };  ///< of the way, or the axis, a unit vector
    double length = 1.0;                   ///< way [m] or angle [rad] for which a field is
    std::vector<int> sets = {};            ///< their numbers
    std::vector<int> back_sets = {};       ///< those that turn the other way
    bool turns = false;                    ///< sets turn about their pivots
    std::vector<PlateLoad> loads = {};     ///< of a static solution alone

    bool moves_top() const { return plates.empty() && sets.empty(); }

    /// Calls visit(set, sense) for each set that moves, sense -1 of those that turn back.
    template <class Visit> void for_each_set(Visit visit) const
    {
        for (int set : sets)
            visit(set, 1.0);
        for (int set : back_sets)
            visit(set, -1.0);
    }
};

/// The same where plates and node sets hold and load a specimen by themselves, at that way of the
/// driven ones, under loads. Plates that a load moves follow.
SolidField elastic_field(const SolidState& s, const SolidDrive& drive, int threads = 1);

/// Forces of an intact specimen; nodes grain after grain, the centre last.
LinearSolid linear_solid(const SolidState& s, int threads = 1);

/// Forces of an intact specimen of rigid grains on their centres and turns.
/// @param solid  its linear_solid(), which must outlive it
RigidSolid rigid_solid(const SolidState& s, const LinearSolid& solid);

/// Frame of a contact when it was bonded.
FaceFrame bonded_frame(const SolidState& s, int contact);

}  // namespace flexpm
