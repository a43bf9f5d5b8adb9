// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/TestFrame.hpp>

namespace yade {

YADE_PLUGIN((TestFrame)(RectangleFrame)(DiscFrame)(PartFrame));

TestFrame::~TestFrame()           = default;
RectangleFrame::~RectangleFrame() = default;
DiscFrame::~DiscFrame()           = default;
PartFrame::~PartFrame()           = default;

flexpm::TestFrame TestFrame::frame(const flexpm::Assembly&) const
{
	throw std::invalid_argument("AxialRecorder.frame = TestFrame, must be a RectangleFrame, DiscFrame or PartFrame");
}

flexpm::TestScales TestFrame::scales(const flexpm::Assembly& assembly, Real) const
{
	frame(assembly);
	return {};
}

flexpm::TestFrame RectangleFrame::frame(const flexpm::Assembly& assembly) const { return flexpm::rectangle_frame(assembly, sense()); }

flexpm::TestScales RectangleFrame::scales(const flexpm::Assembly& assembly, Real dt) const { return flexpm::rectangle_scales(assembly, sense(), dt); }

std::optional<TestFrame::Measure> RectangleFrame::measure(const string& column, const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const
{
	if (column != "lateral_strain") return {};
	return Measure { flexpm::lateral_strain(assembly, sense(), assembly.grains.displacement), flexpm::lateral_strain(assembly, sense(), velocity) };
}

flexpm::TestFrame DiscFrame::frame(const flexpm::Assembly& assembly) const { return flexpm::disc_frame(assembly, diameter); }

flexpm::TestScales DiscFrame::scales(const flexpm::Assembly& assembly, Real dt) const { return flexpm::disc_scales(assembly, diameter, dt); }

flexpm::PartGeometry PartFrame::parts() const
{
	return { driven, holding, { direction[0], direction[1] }, area, length, drivenSets, backSets, holdingSets, direction[2] };
}

flexpm::TestFrame PartFrame::frame(const flexpm::Assembly& assembly) const { return flexpm::part_frame(assembly, parts()); }

flexpm::TestScales PartFrame::scales(const flexpm::Assembly& assembly, Real dt) const { return flexpm::part_scales(assembly, parts(), strength, dt); }

std::optional<TestFrame::Measure> PartFrame::measure(const string& column, const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const
{
	if (column != "load") return {};
	return Measure { flexpm::part_load(assembly, parts()), flexpm::part_load_rate(assembly, parts(), velocity) };
}

} // namespace yade
