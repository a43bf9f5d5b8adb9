// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Ends of a specimen in space that move along z, and the motion that they give to it. Ends
/// are free laterally. Nodes of deformable grains are driven, rigid ones, and discs of any, lie
/// between plates. SI units, tension positive.
#pragma once

#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>

namespace flexpm {

/// How ends are held.
struct EndHold {
    bool pulled = false;  ///< plates are bonded
    bool plates = false;  ///< those of grains that deform lie between plates, too
};

/// Take hold of both ends at rest. Masses must be scaled afterwards.
/// @throws std::invalid_argument  if the ends are held already, or there are none
void hold_ends(SolidState& s, const EndHold& how);

/// Take hold of one of them, if it is not held yet. Grains under a pressure go on to bear it: a
/// plate that is laid on them presses as much (deviation D93).
/// @throws std::invalid_argument  if it has no nodes
void hold_end(SolidState& s, SolidSide side, const EndHold& how);

/// Keep a specimen under pressures from sliding and turning between smooth ends, which nothing else
/// does once it is cracked: a node next to the middle of the bottom stays along x and y, another
/// one along y; of rigid grains their centres (deviation D93).
void hold_against_sliding(SolidState& s);

/// Hold the nodes of a side along an axis (0: x), as a smooth plane that they may not leave does
/// along its normal. Front and back held along y make plane strain of a box. Of rigid grains the
/// centre is held where the side lies across the axis, the middle of their faces where it runs
/// along it.
/// @throws std::invalid_argument  if there is no such side or axis
void hold_side(SolidState& s, int side, int axis);

/// Begin from a linear solution at a strain, positive in tension, with the top at a velocity, by
/// which all grains move as that solution does (deviation D30). Kinetic and elastic energy of this
/// start are the initial ones of the balance. Ends must be held.
///
/// @param strain    of the solution, over that of the field, which is 1 [-]
/// @param velocity  of the top [m/s], positive away from the bottom
/// @param undamped  damping acts only on what grains move beyond that
/// @param dt        time step [s]
/// @throws std::invalid_argument  as begin_from(), or if ends are not held
void start_ends(SolidState& s, const SolidField& field, double strain, double velocity,
    bool undamped, double dt);

/// Young's modulus and Poisson's ratio of grains between smooth ends that they are bonded to, by
/// their linear solution and as a record has them: grains that deform or are rigid.
/// @param s  an unloaded specimen whose ends are not held
/// @throws std::invalid_argument  if they are held, or there are none
/// @throws std::runtime_error  as elastic_field()
ElasticConstants constants_between_ends(SolidState s);

}  // namespace flexpm
