// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/Gauge.hpp>

#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <algorithm>

namespace yade {

YADE_PLUGIN((Gauge));

Gauge::~Gauge() = default;

Real Gauge::perLength(Real moved) const { return length > 0 ? moved / length : moved; }

Real Gauge::way(const flexpm::Grains& grains, const flexpm::Array<double>& moved) const
{
	return nodes.empty() ? flexpm::gauge_opening(grains, moved, { first, second }, along()) : flexpm::mean_way(grains, moved, nodes, along());
}

Real Gauge::moved(const flexpm::BondedState& state) const
{
	if (reads == "crosshead") return flexpm::crosshead_way(state, plate, along());
	return plate >= 0 ? flexpm::plate_way(state, plate, along()) : way(state.grains, state.grains.displacement);
}

bool Gauge::isState() const { return reads == "machine_energy" || reads == "contact_angle" || reads == "angle"; }

void Gauge::setZero(const flexpm::BondedState& state)
{
	if (!isState()) zero = moved(state);
}

template <class State> Real Gauge::reading(const State& state) const
{
	if (!isState()) return perLength(moved(state) - zero);
	if (reads == "angle") return flexpm::plate_angle(state, plate);
	return reads == "machine_energy" ? flexpm::machine_energy(state, plate) : flexpm::contact_angle(state, plate);
}

template <class State> Real Gauge::rate(const State& state, const flexpm::Array<double>& velocity) const
{
	if (isState()) return 0;
	if (reads == "crosshead") return flexpm::crosshead_rate(state, plate, along());
	return perLength(plate >= 0 ? flexpm::plate_rate(state, plate, along(), velocity) : way(state.grains, velocity));
}

bool Gauge::lost(const flexpm::Grains& grains) const
{
	if (plate >= 0) return false;
	const auto erased = [&](int node) { return flexpm::is_erased(grains, node); };
	return nodes.empty() ? erased(first) || erased(second) : std::any_of(nodes.begin(), nodes.end(), erased);
}

template Real Gauge::reading(const flexpm::Assembly&) const;
template Real Gauge::reading(const flexpm::SolidState&) const;
template Real Gauge::rate(const flexpm::Assembly&, const flexpm::Array<double>&) const;
template Real Gauge::rate(const flexpm::SolidState&, const flexpm::Array<double>&) const;

} // namespace yade
