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
		((Real, slowest, .01,, "Smallest velocity factor over the largest [-]."))
		((Real, sweep, 0.,, "Volume that the loaded area sweeps at this factor: area times velocity [m3/s, or m3 per step with scaled masses]."))
		((Real, runningShare, .002,, "Cracks propagate if damage, friction and damping dissipate more than this share of the power of the fastest loading [-]."))
		((Real, shareAfterPeak, .01,, "The same once the stress has fallen from its peak [-]."))
		((bool, ofFriction, true,, "Friction is taken for a sign of cracks that run; not where faces are to slide."))
		((Real, crossingSteps, 1.,, "Steps in which a wave crosses the specimen: the velocity at most doubles in them and at most halves in a quarter of them [-]."))
		((bool, undampedDescent, false,, "After the stress has dropped from its peak, damping acts only on the deviation of grains from their mean motion since the last check, deviation D55."))
		((Real, fastestDescent, 0.,, "Largest speed of the mean motion that it then leaves alone [m/s, or m per step with scaled masses]."))
		((Real, softeningGrowth, 0.,, "Largest growth of the traction on a plane during one wave transit, relative to the traction, when the plane begins to soften, deviation D58; 0: no prediction [-]."))
		((Real, seen, -1., Attr::hidden, "Damage energy, with that of friction if it counts, at the last check, negative before the first [J]."))
		, /* ctor */
		, .def("release", &CrackWaitController::release, "Let damping act on all but the motion that the loading gives again; call it before another loading.")
	);
	// clang-format on
};
REGISTER_SAVED(CrackWaitController);

} // namespace yade
