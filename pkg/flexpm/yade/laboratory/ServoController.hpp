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
		"Moves the ends of a specimen, back too, so that a measure of it follows a set point. The set point grows as the measure "
		"does along the elastic solution at the ends' velocity, times velocityFactor, which :yref:`CrackWaitController` may write. "
		"Place it last; it is the loading of the :yref:`AxialRecorder`, whose column *controlled* is the measure. The ends must have an undampedLoading.",
		((shared_ptr<AxialRecorder>, recorder,,, "Record of the test, which names the measure."))
		((shared_ptr<LoadingController>, ends,,, "What drives the specimen; its velocityFactor is set."))
		((Real, fastest, 1.,, "Largest velocity factor of the ends, in both directions [-]."))
		((Real, crossingSteps, 1.,, "Steps in which a wave crosses the specimen [-]."))
		((int, period, 1,, "Steps between two looks [-]."))
		((Real, rate, 0., Attr::readonly, "Growth of the measure in a step along the elastic solution, at factor 1 [SI unit of the measure]; 0 before the first step |yupdate|."))
		((Real, slope, 1., Attr::hidden, "Ratio of the velocity factors of the ends and the set point along the path of the specimen [-]."))
		((Real, seen, 0., Attr::hidden, "The measure at the last look [SI unit of the measure]."))
		((long, seenAt, 0, Attr::hidden, "Step of the last look [-]."))
	);
	// clang-format on

private:
	void begin(Real reading, Real growth);
};
REGISTER_SAVED(ServoController);

} // namespace yade
