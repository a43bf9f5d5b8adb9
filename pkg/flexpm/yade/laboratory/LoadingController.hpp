// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Base of the engines that move ends or plates of a specimen at a velocity that may change, paper Sec. 4.1.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class LoadingController : public BoundaryController {
public:
	~LoadingController() override;
	/// @throws std::runtime_error  unless it moves the ends of a specimen
	virtual void preload(Real share, int steps);
	virtual void release();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(LoadingController, BoundaryController,
		"Base of engines that load a specimen at a velocity. Not to be used directly.",
		((Real, velocityFactor, 1.,, "Ratio of the present velocity to the velocity that is set. :yref:`LoadingRateController` and :yref:`ServoController` set it; a ServoController sets it below 0 to move the ends back [-] |yupdate|."))
		((bool, undampedLoading, false,, "Start all grains with the velocities of the elastic solution, scale these with the velocity of the loading, and damp only the deviation from them."))
		((int, renewPeriod, 1000,, "Steps between recomputations of these velocities, which happen if joints have started or stopped sliding or, in a loading by parts, if points have cracked [-]."))
		((long, renewedAt, 0, Attr::hidden, "Step of the last check for such changes [-]."))
		((int, seenSoftened, 0, Attr::hidden, "Softened points at that step [-]."))
		((int, seenSliding, 0, Attr::hidden, "Sliding contacts of joints at that step [-]."))
		((Real, seenFactor, 0., Attr::hidden, "The factor at the last step; 0 before the first [-]."))
		((vector<int>, heldBefore,, Attr::hidden, "Components that were fixed before preload() fixed all [-]."))
		, /* ctor */
		, .def("preload", &LoadingController::preload, (boost::python::arg("share"), boost::python::arg("steps")),
			"Prescribe all nodes between driven ends: within this number of steps the specimen follows its elastic solution to this share of the load at which the first contact point leaves its elastic branch.")
		.def("release", &LoadingController::release, "Release the nodes after these steps; the top continues at its velocity.")
	);
	// clang-format on

protected:
	[[noreturn]] void refusePreload() const;

	/// Find the motion that the loading gives anew, at the velocity that ends or plates have, where joints slide and, if they
	/// count, points have cracked.
	void renew(flexpm::Assembly& assembly, bool cracksCount);

	/// Bring the present velocity to the coming step: what is set times the factor. Returns its ratio to that before.
	///
	/// A change of the factor alone acts by its ratio, so that the velocity keeps its bits while the factor does.
	template <class Velocity> Real follow(const Velocity& set, Velocity& seen, Velocity& present)
	{
		Real ratio = seenFactor == 0 ? 1 : velocityFactor / seenFactor;
		if (seenFactor == 0 || set != seen) {
			ratio *= over(set, seen);
			present = set * velocityFactor;
		} else {
			present *= ratio;
		}
		seen       = set;
		seenFactor = velocityFactor;
		return ratio;
	}

private:
	static Real over(Real set, Real seen) { return seen == 0 ? 0 : set / seen; }
	static Real over(const Vector3r& set, const Vector3r& seen) { return seen == Vector3r::Zero() ? 0 : set.dot(seen) / seen.squaredNorm(); }
};
REGISTER_SAVED(LoadingController);

} // namespace yade
