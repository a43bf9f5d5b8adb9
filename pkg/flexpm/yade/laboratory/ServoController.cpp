// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/ServoController.hpp>

#include <flexpm/kernel/laboratory/servo.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((ServoController));

ServoController::~ServoController() = default;

void ServoController::action()
{
	if (!recorder || !ends)
		throw std::runtime_error("ServoController.recorder or ends = None, must be engines; assign the recorder and the loading engine of the test");
	auto&      solver = *GrainSolver::ofScene(*scene);
	const long step   = solver.stepsDone();
	const Real steps  = step - seenAt;
	if (rate > 0 && steps < period) return;
	const auto [reading, growing] = recorder->measure(recorder->controlled, solver);
	const Real growth             = growing * scene->dt;
	seenAt                        = step;
	if (!(rate > 0)) return begin(reading, growth);
	const auto now = flexpm::servo_after(
	        { recorder->setPoint, seen, ends->velocityFactor, slope }, { reading, growth, velocityFactor, steps }, { rate, fastest, crossingSteps });
	recorder->setPoint   = now.set_point;
	ends->velocityFactor = now.factor;
	slope                = now.slope;
	seen                 = now.measure;
}

void ServoController::begin(Real reading, Real growth)
{
	if (!(growth > 0))
		throw std::invalid_argument(
		        "control = " + recorder->controlled + ", must be a measure that increases along the loading; reverse its direction or the load");
	rate               = flexpm::growth_at_unit_factor(growth, ends->velocityFactor);
	recorder->setPoint = seen = reading;
}

} // namespace yade
