// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A reading of a specimen by its name: how far two points open, a strain, the way of a plate or a section.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class Gauge : public Serializable {
public:
	~Gauge() override;
	/// @throws std::runtime_error  if it names no node or plate of the assembly
	/// Count from here on.
	/// @throws std::runtime_error  as reading()
	void setZero(const flexpm::BondedState& state);
	/// Opening or way, less that at its zero [m], or a strain [-], or what `reads` names.
	template <class State> Real reading(const State& state) const;
	/// Increase of the reading in a second where nodes move at such velocities, and plates as the loading moves them.
	template <class State> Real rate(const State& state, const flexpm::Array<double>& velocity) const;
	/// Whether a grain that it reads has been erased.
	bool lost(const flexpm::Grains& grains) const;

private:
	flexpm::Vector along() const { return { direction[0], direction[1], direction[2] }; }
	Real           moved(const flexpm::BondedState& state) const;
	/// Whether it reads what the plate has now, not how far something has gone.
	bool isState() const;
	/// Way of its nodes where nodes move so.
	Real way(const flexpm::Grains& grains, const flexpm::Array<double>& moved) const;
	Real perLength(Real moved) const;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Gauge, Serializable,
		"Reads the opening or strain between two nodes of grains, the displacement of a plate, or the mean displacement of nodes; :yref:`AxialRecorder` records it as a column. GrainSolver.gaugePoints and GrainSolver.sectionNodes find the nodes.",
		((string, name,,, "Name of the column."))
		((int, first, -1,, "Node at the first position, from GrainSolver.gaugePoints [-]."))
		((int, second, -1,, "Node at the second position [-]."))
		((int, plate, -1,, "Index of a plate whose displacement is read instead [-]."))
		((string, reads,,, "Other quantity of that plate that is read instead of its displacement: crosshead, displacement of its crosshead [m]; machine_energy, energy of the spring between crosshead and plate [J]; contact_angle, angle over which a disc touches a jaw [rad]; angle, rotation of a seated plate, in 3D its magnitude [rad]."))
		((vector<int>, nodes,,, "Nodes whose mean displacement is read instead, from GrainSolver.sectionNodes [-]."))
		((Vector3r, direction, Vector3r::UnitX(),, "Direction of the opening or displacement, a unit vector [-]."))
		((Real, zero, 0.,, "Opening or displacement that counts as zero [m]."))
		((Real, length, 0.,, "Gauge length of a strain; 0: the opening itself is read [m]."))
	);
	// clang-format on
};
REGISTER_SAVED(Gauge);

} // namespace yade
