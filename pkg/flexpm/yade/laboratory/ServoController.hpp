// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Servo of a loading on a measure of the specimen, deviation D51.
#pragma once

#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/laboratory/AxialRecorder.hpp>

namespace yade {

class ServoController : public LoadingController {
public:
	~ServoController() override;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ServoController, LoadingController,
		"Moves the ends of a specimen in both directions, so that a measured quantity follows a set point. The rate of the set point is the rate of the measure "
		"along the elastic solution at the velocity of the ends, times velocityFactor, which :yref:`CrackWaitController` may set. "
		"Place it last. It is the loading of the :yref:`AxialRecorder`, whose column *controlled* is the measure. The ends must have an undampedLoading.",
		((shared_ptr<AxialRecorder>, recorder,,, "Record of the test, which names the measure."))
		((shared_ptr<LoadingController>, ends,,, "Loading engine of the ends, whose velocityFactor is set."))
		((Real, fastest, 1.,, "Largest velocity factor of the ends, in both directions [-]."))
		((Real, crossingSteps, 1.,, "Steps of one wave transit of the specimen [-]."))
		((int, period, 1,, "Steps between two evaluations [-]."))
		((Real, rate, 0., Attr::readonly, "Growth of the measure in a step along the elastic solution, at factor 1 [SI unit of the measure]; 0 before the first step |yupdate|."))
		((Real, slope, 1., Attr::hidden, "Ratio of the velocity factors of the ends and the set point along the path of the specimen [-]."))
		((Real, seen, 0., Attr::hidden, "The measure at the last evaluation [SI unit of the measure]."))
		((long, seenAt, 0, Attr::hidden, "Step of the last evaluation [-]."))
	);
	// clang-format on

private:
	void begin(Real reading, Real growth);
};
REGISTER_SAVED(ServoController);

} // namespace yade
