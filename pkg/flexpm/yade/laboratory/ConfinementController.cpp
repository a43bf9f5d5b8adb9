// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/ConfinementController.hpp>

#include <flexpm/kernel/forces/sides.hpp>

namespace yade {

YADE_PLUGIN((ConfinementController));

ConfinementController::~ConfinementController() = default;

void ConfinementController::press(flexpm::Assembly& assembly, Real now) const
{
	for (int side : sides)
		flexpm::set_pressure(assembly, side, now);
	PressureController::press(assembly, now);
}

} // namespace yade
