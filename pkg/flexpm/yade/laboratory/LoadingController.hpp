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
		((Real, velocityFactor, 1.,, "Present velocity over the velocity that is set, which is the slowest; :yref:`LoadingRateController` and :yref:`ServoController` write it, the latter below 0 where the ends go back [-] |yupdate|."))
		((bool, undampedLoading, false,, "Start all grains with the velocities of the elastic solution, let these follow the velocity of the loading, and let damping act only on the deviation from them."))
		((int, renewPeriod, 1000,, "Steps after which these velocities are recomputed, if joints have begun or ceased to slide or, under loading by parts, points have cracked [-]."))
		((long, renewedAt, 0, Attr::hidden, "Step at which that was last looked for [-]."))
		((int, seenSoftened, 0, Attr::hidden, "Points that had softened then [-]."))
		((int, seenSliding, 0, Attr::hidden, "Contacts of joints that slid then [-]."))
		((Real, seenFactor, 0., Attr::hidden, "The factor at the last step; 0 before the first [-]."))
		((vector<int>, heldBefore,, Attr::hidden, "Components that were fixed before preload() fixed all [-]."))
		, /* ctor */
		, .def("preload", &LoadingController::preload, (boost::python::arg("share"), boost::python::arg("steps")),
			"Prescribe all nodes between driven ends: within this number of steps the specimen follows its elastic solution to this share of the load at which the first contact point leaves its elastic branch.")
		.def("release", &LoadingController::release, "Release the nodes after these steps; the top continues at the velocity.")
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
