// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Specimens between a held bottom and a driven top, for counting and timing steps. SI
/// units, lengths per unit step; tension positive.
#pragma once

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/specimens.hpp"

#include <stdexcept>
#include <string>

namespace loaded {

/// `kind`: refined, fan or rigid.
inline flexpm::AssemblyOptions options(const std::string& kind, int points = 3)
{
    flexpm::AssemblyOptions o = specimens::options();
    if (kind != "refined" && kind != "fan" && kind != "rigid") {
        throw std::invalid_argument("kind = " + kind + ", must be refined, fan or rigid");
    }
    o.mesh = kind == "fan" ? flexpm::MeshKind::fan : flexpm::MeshKind::refined;
    o.rigid = kind == "rigid";
    o.points = points;
    return o;
}

/// Scaled masses and a top that moves at `velocity`. Rigid grains are squeezed between plates.
inline void drive(flexpm::Assembly& a, double velocity)
{
    if (a.grains.is_rigid(0)) {
        for (int side : { flexpm::bottom_side, flexpm::top_side }) {
            const int plate = flexpm::add_side_plates(a, side, 1, {}).front();
            flexpm::set_velocity(a, plate, { 0.0, side == flexpm::top_side ? velocity : 0.0 });
        }
        flexpm::scale_masses(a, 0.7);
    } else {
        flexpm::scale_masses(a, 0.7);
        flexpm::grip_bottom(a);
        flexpm::move_top(a, velocity);
    }
}

/// The same with the elastic velocities to start with, which grains without contacts do not have.
inline void load(flexpm::Assembly& a, double velocity)
{
    drive(a, velocity);
    flexpm::start_elastically(a, false);
}

inline void run(flexpm::Assembly& a, int steps)
{
    for (int i = 0; i < steps; ++i)
        flexpm::step(a, flexpm::StepOptions());
}

}  // namespace loaded
