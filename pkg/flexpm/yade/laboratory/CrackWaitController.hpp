// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Loading that waits for the cracks of a test.
#pragma once

#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/laboratory/AxialRecorder.hpp>

namespace yade {

class CrackWaitController : public BoundaryController {
public:
	~CrackWaitController() override;
	void action() override;
	void release();

private:
	/// Largest velocity factor with which the loading may come to points that will soften.
	Real mostAhead(GrainSolver& solver) const;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(CrackWaitController, BoundaryController,
		"Slows a loading while cracks propagate: it is fast while the specimen is elastic and nearly stops while the power of damage, "
		"friction and damping shows a running crack. It is evaluated at each measured step of :yref:`GrainSolver`. Place it last, after :yref:`AxialRecorder`.",
		((shared_ptr<AxialRecorder>, recorder,,, "Record of the test; the velocityFactor of its loading is set."))
		((Real, fastest, 1.,, "Largest velocity factor [-]."))
		((Real, slowest, .01,, "Ratio of the smallest to the largest velocity factor [-]."))
		((Real, sweep, 0.,, "Loaded area times its velocity at the largest factor [m3/s, or m3 per step with scaled masses]."))
		((Real, runningShare, .002,, "Cracks propagate if damage, friction and damping dissipate more than this share of the power of the fastest loading [-]."))
		((Real, shareAfterPeak, .01,, "Value of runningShare after the stress has dropped from its peak [-]."))
		((bool, ofFriction, true,, "Friction counts as a sign of propagating cracks; set it to false if faces are expected to slide."))
		((Real, crossingSteps, 1.,, "Steps of one wave transit of the specimen. During one transit the velocity at most doubles; during a quarter of it the velocity at most halves [-]."))
		((bool, undampedDescent, false,, "After the stress has dropped from its peak, damping acts only on the deviation of grains from their mean motion since the last check, deviation D55."))
		((Real, fastestDescent, 0.,, "Largest speed of the mean motion that damping does not act on then [m/s, or m per step with scaled masses]."))
		((Real, softeningGrowth, 0.,, "Largest growth of the traction on a plane during one wave transit, relative to the traction, when the plane begins to soften, deviation D58; 0: no prediction [-]."))
		((Real, seen, -1., Attr::hidden, "Damage energy at the last check, plus friction energy if ofFriction is set; negative before the first check [J]."))
		, /* ctor */
		, .def("release", &CrackWaitController::release, "Make damping act again on all motion except the prescribed loading motion; call it before another loading.")
	);
	// clang-format on
};
REGISTER_SAVED(CrackWaitController);

} // namespace yade
