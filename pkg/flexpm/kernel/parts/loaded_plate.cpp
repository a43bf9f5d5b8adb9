// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/loaded_plate.hpp>

#include <flexpm/kernel/core/central_difference.hpp>

namespace flexpm {

void integrate_loaded(Plate& plate, double undamped, bool bears, double dt, double damping)
{
    const double load = bears ? plate.load : 0.0;
    const double net = load - dot(plate.normal, plate.force);
    double speed = dot(plate.normal, plate.velocity);
    const double old = speed;
    StepSums sums;
    integrate_one<true>({ net, 1.0 / plate.mass, 0.0, undamped }, dt, damping, speed, sums, 0);
    plate.velocity = speed * plate.normal;
    plate.damping_work += plate.damping_work_next + sums.damped[0];
    plate.damping_work_next = sums.damped_next[0];
    plate.drag_work += plate.drag_work_next + sums.dragged[0];
    plate.drag_work_next = sums.dragged[0];
    plate.boundary_work += plate.boundary_work_next + 0.5 * dt * load * old;
    plate.boundary_work_next = 0.5 * dt * load * speed;
    plate.kinetic = sums.kinetic[0];
    plate.unbalanced = bears ? sums.largest[0] : plate.load;
}

void let_go(Plate& plate)
{
    if (!plate.loaded) return;
    plate.boundary_work_next = plate.damping_work_next = plate.drag_work_next = 0.0;
    plate.kinetic = plate.unbalanced = 0.0;
    plate.loaded = false;
}

}  // namespace flexpm
