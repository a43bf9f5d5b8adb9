// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/Gauge.hpp>

#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/laboratory/solid_gauge.hpp>

#include <algorithm>

namespace yade {

YADE_PLUGIN((Gauge));

Gauge::~Gauge() = default;

Real Gauge::perLength(Real moved) const { return length > 0 ? moved / length : moved; }

Real Gauge::way(const flexpm::Array<double>& moved) const
{
	const flexpm::Point along = { direction[0], direction[1] };
	return nodes.empty() ? flexpm::gauge_opening(moved, { first, second }, along) : flexpm::mean_way(moved, nodes, along);
}

Real Gauge::moved(const flexpm::Assembly& assembly) const
{
	const flexpm::Point along = { direction[0], direction[1] };
	if (reads == "crosshead") return flexpm::crosshead_way(assembly, plate, along);
	return plate >= 0 ? flexpm::plate_way(assembly, plate, along) : way(assembly.grains.displacement);
}

Real Gauge::moved(const flexpm::SolidState& solid) const
{
	const flexpm::Vector along = { direction[0], direction[1], direction[2] };
	if (reads == "crosshead") return flexpm::crosshead_way(solid, plate, along);
	return plate >= 0 ? flexpm::plate_way(solid, plate, along) : wayInSpace(solid.grains.displacement);
}

Real Gauge::wayInSpace(const flexpm::Array<double>& moved) const
{
	const flexpm::Vector along = { direction[0], direction[1], direction[2] };
	return nodes.empty() ? flexpm::opening_in_space(moved, { first, second }, along) : flexpm::mean_way_in_space(moved, nodes, along);
}

Real Gauge::rate(const flexpm::SolidState& solid, const flexpm::Array<double>& velocity) const
{
	const flexpm::Vector along = { direction[0], direction[1], direction[2] };
	if (isState()) return 0;
	if (reads == "crosshead") return flexpm::crosshead_rate(solid, plate, along);
	return perLength(plate >= 0 ? flexpm::plate_rate(solid, plate, along, velocity) : wayInSpace(velocity));
}

void Gauge::setZero(const flexpm::SolidState& solid)
{
	if (!isState()) zero = moved(solid);
}

Real Gauge::reading(const flexpm::SolidState& solid) const
{
	if (!isState()) return perLength(moved(solid) - zero);
	if (reads == "angle") return flexpm::tilt(solid, plate);
	return reads == "machine_energy" ? flexpm::machine_energy(solid, plate) : flexpm::contact_angle(solid, plate);
}

bool Gauge::isState() const { return reads == "machine_energy" || reads == "contact_angle" || reads == "angle"; }

void Gauge::setZero(const flexpm::Assembly& assembly)
{
	if (!isState()) zero = moved(assembly);
}

Real Gauge::reading(const flexpm::Assembly& assembly) const
{
	if (!isState()) return perLength(moved(assembly) - zero);
	flexpm::require_plate(assembly, plate);
	const flexpm::Plate& read = assembly.plates[plate];
	if (reads == "angle") return read.turn.z;
	return reads == "contact_angle" ? flexpm::contact_angle(assembly, plate) : flexpm::machine_energy(read);
}

Real Gauge::rate(const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const
{
	const flexpm::Point along = { direction[0], direction[1] };
	if (isState()) return 0;
	if (reads == "crosshead") return flexpm::crosshead_rate(assembly, plate, along);
	return perLength(plate >= 0 ? flexpm::plate_rate(assembly, plate, along, velocity) : way(velocity));
}

bool Gauge::lost(const flexpm::Assembly& assembly) const
{
	if (plate >= 0) return false;
	const auto erased = [&](int node) { return flexpm::is_erased(assembly, node); };
	return nodes.empty() ? erased(first) || erased(second) : std::any_of(nodes.begin(), nodes.end(), erased);
}

} // namespace yade
