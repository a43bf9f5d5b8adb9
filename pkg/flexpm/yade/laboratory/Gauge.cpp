// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/Gauge.hpp>

#include <flexpm/kernel/laboratory/gauge.hpp>

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
	return plate >= 0 ? flexpm::plate_way(assembly, plate, along) : way(assembly.grains.displacement);
}

void Gauge::setZero(const flexpm::Assembly& assembly) { zero = moved(assembly); }

Real Gauge::reading(const flexpm::Assembly& assembly) const { return perLength(moved(assembly) - zero); }

Real Gauge::rate(const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const
{
	const flexpm::Point along = { direction[0], direction[1] };
	return perLength(plate >= 0 ? flexpm::plate_rate(assembly, plate, along) : way(velocity));
}

bool Gauge::lost(const flexpm::Assembly& assembly) const
{
	if (plate >= 0) return false;
	const auto erased = [&](int node) { return flexpm::is_erased(assembly, node); };
	return nodes.empty() ? erased(first) || erased(second) : std::any_of(nodes.begin(), nodes.end(), erased);
}

} // namespace yade
