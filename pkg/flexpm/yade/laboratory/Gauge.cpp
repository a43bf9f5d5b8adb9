// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/Gauge.hpp>

#include <flexpm/kernel/laboratory/gauge.hpp>

namespace yade {

YADE_PLUGIN((Gauge));

Gauge::~Gauge() = default;

Real Gauge::moved(const flexpm::Assembly& assembly) const
{
	const flexpm::Point along = { direction[0], direction[1] };
	if (!nodes.empty()) return flexpm::mean_way(assembly, nodes, along);
	return plate >= 0 ? flexpm::plate_way(assembly, plate, along) : flexpm::gauge_opening(assembly, { first, second }, along);
}

void Gauge::setZero(const flexpm::Assembly& assembly) { zero = moved(assembly); }

Real Gauge::reading(const flexpm::Assembly& assembly) const
{
	const Real way = moved(assembly) - zero;
	return length > 0 ? way / length : way;
}

} // namespace yade
