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
		"Lets a loading wait for cracks: it goes fast while the specimen is elastic and nearly stands still while what damage, "
		"friction and damping take says that a crack runs. It looks at each measured step of :yref:`GrainSolver`. Place it last, after :yref:`AxialRecorder`.",
		((shared_ptr<AxialRecorder>, recorder,,, "Record of the test; the velocityFactor of its loading is set."))
		((Real, fastest, 1.,, "Largest velocity factor [-]."))
		((Real, slowest, .01,, "Smallest velocity factor over the largest [-]."))
		((Real, sweep, 0.,, "Volume that the loaded area sweeps at this factor: area times velocity [m3/s, or m3 per step with scaled masses]."))
		((Real, runningShare, .002,, "Cracks run where damage, friction and damping take more than this share of what the loading would supply at its fastest [-]."))
		((Real, shareAfterPeak, .01,, "The same once the stress has fallen from its peak [-]."))
		((bool, ofFriction, true,, "Friction is taken for a sign of cracks that run; not where faces are to slide."))
		((Real, crossingSteps, 1.,, "Steps in which a wave crosses the specimen: the velocity at most doubles in them and at most halves in a quarter of them [-]."))
		((bool, undampedDescent, false,, "Once the stress has fallen from its peak, damping acts only on what grains move beyond their mean motion since the last look, deviation D55."))
		((Real, fastestDescent, 0.,, "Largest speed of the mean motion that it then leaves alone [m/s, or m per step with scaled masses]."))
		((Real, softeningGrowth, 0.,, "Largest growth of a plane's traction while a wave crosses the specimen, over what it bears, as the plane begins to soften, deviation D58; 0: the loading does not look ahead [-]."))
		((Real, seen, -1., Attr::hidden, "Damage energy, with that of friction if it counts, at the last look, negative before the first [J]."))
		, /* ctor */
		, .def("release", &CrackWaitController::release, "Let damping act on all but the motion that the loading gives again; call it before another loading.")
	);
	// clang-format on
};
REGISTER_SAVED(CrackWaitController);

} // namespace yade
