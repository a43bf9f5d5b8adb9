// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rules of a test as functions on plain numbers, for models that the kernel does not step.
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/bindings.hpp>
#include <flexpm/yade/bindings/scales_dict.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/bond_strengths.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/end_rule.hpp>
#include <flexpm/kernel/measure/centre_strain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include <boost/python/stl_iterator.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	using flexpm::StrainGauge;

	flexpm::Sense senseOf(bool tension) { return tension ? flexpm::Sense::tension : flexpm::Sense::compression; }

	double referenceStrength(bool tension, double tensile, double cohesion, double friction)
	{
		return flexpm::reference_strength(senseOf(tension), { tensile, cohesion, friction });
	}

	/// Strengths of the bonds of spheres: the lowest that counts, and that of the bonds that connect them.
	py::tuple bondStrengths(py::object strengths, py::object areas, py::object pairs, int spheres)
	{
		const InputArray<double>       values(strengths, 1, "strengths"), sizes(areas, 1, "areas");
		const InputArray<int>          ends(pairs, 2, "pairs");
		std::vector<flexpm::BondValue> bonds;
		if (sizes.size(0) != values.size(0) || ends.size(0) != values.size(0) || ends.size(1) != 2)
			flexpm::refuse(
			        "areas, pairs",
			        std::to_string(sizes.size(0)) + ", " + std::to_string(ends.size(0)),
			        "must be one for each of " + std::to_string(values.size(0)) + " strengths; give two spheres for each bond");
		for (int b = 0; b < static_cast<int>(values.size(0)); ++b)
			bonds.push_back({ values.data()[b], sizes.data()[b], { ends.data()[2 * b], ends.data()[2 * b + 1] } });
		if (bonds.empty()) flexpm::refuse("strengths", 0.0, "", "must be >= 1; give the strengths of the bonds");
		return py::make_tuple(flexpm::lowest_value(bonds), flexpm::connecting_value(bonds, spheres));
	}

	/// Inputs of bonds that break at once, with their lowest strength and that of those that connect the spheres.
	flexpm::ScaleInputs scaleInputs(double modulus, const py::tuple& strengths, double mass, double thickness, double dt)
	{
		const double lowest = py::extract<double>(strengths[0]), connecting = py::extract<double>(strengths[1]);
		return { modulus, connecting, mass, thickness, dt, 0, lowest };
	}

	py::dict rectangleScales(double modulus, py::tuple strengths, double mass, double thickness, double dt, double width, double height)
	{
		return scales_dict(flexpm::rectangle_scales(scaleInputs(modulus, strengths, mass, thickness, dt), width, height));
	}

	py::dict discScales(double modulus, py::tuple strengths, double mass, double thickness, double dt, double diameter)
	{
		return scales_dict(flexpm::disc_scales(scaleInputs(modulus, strengths, mass, thickness, dt), diameter));
	}

	double axialStress(double bottom, double top, double area, bool tension) { return flexpm::axial_stress({ bottom, top }, senseOf(tension), area); }

	double endMismatch(double bottom, double top) { return flexpm::end_mismatch({ bottom, top }); }

	/// @param rule  stop ratio, least peak, least and largest strain, as in flexpm::TestEnd
	flexpm::TestState testState(double stress, double peak, double strain, const py::object& rule, bool plateau)
	{
		const auto of = [&](int i) { return double(py::extract<double>(rule[i])); };
		return flexpm::test_state(stress, peak, strain, { of(0), of(1), of(2), of(3) }, plateau);
	}

	bool isPlateau(py::object strains, py::object stresses, double plateauStrain)
	{
		const InputArray<double> strain(strains, 1, "strains"), stress(stresses, 1, "stresses");
		flexpm::TestEnd          rule;
		rule.plateau_strain = plateauStrain;
		const auto row      = [&](std::size_t i) { return flexpm::StrainStress { strain.data()[i], stress.data()[i] }; };
		return flexpm::is_plateau(row, 0, std::min(strain.size(0), stress.size(0)), rule);
	}

	std::vector<flexpm::SideShare> shares(const py::object& pairs)
	{
		std::vector<flexpm::SideShare> found;
		for (auto pair = py::stl_input_iterator<py::object>(pairs); pair != py::stl_input_iterator<py::object>(); ++pair)
			found.push_back({ py::extract<int>((*pair)[0]), py::extract<double>((*pair)[1]) });
		return found;
	}

	std::shared_ptr<StrainGauge> strainGauge(double bottom, double height, double meanDiameter, py::object left, py::object right)
	{
		return std::make_shared<StrainGauge>(StrainGauge { bottom, height, meanDiameter, shares(left), shares(right), {} });
	}

	py::tuple strains(const StrainGauge& gauge, py::object centres, py::object displacements)
	{
		const InputArray<double> places(centres, 2, "centres"), moved(displacements, 2, "displacements");
		const int                grains = static_cast<int>(places.size(0));
		if (places.size(1) != 2) flexpm::refuse("columns of centres", static_cast<double>(places.size(1)), "", "must be 2; give x and y");
		if (moved.size(0) != places.size(0) || moved.size(1) != 2) {
			const auto size = std::to_string(moved.size(0)) + " x " + std::to_string(moved.size(1));
			flexpm::refuse("displacements", size, "must be " + std::to_string(grains) + " x 2 as the centres; give one for each");
		}
		for (const auto* side : { &gauge.left, &gauge.right }) {
			for (const flexpm::SideShare& share : *side) {
				if (share.grain < 0 || share.grain >= grains)
					flexpm::refuse("grain of a strain gauge", share.grain, "", "must be the row of a centre, from 0");
			}
		}
		const auto at = [](const InputArray<double>& array) {
			return [rows = array.data()](int grain, int component) { return rows[2 * grain + component]; };
		};
		const flexpm::SpecimenStrain found = flexpm::centre_strain(gauge, grains, at(places), at(moved));
		return py::make_tuple(found.axial, found.lateral);
	}

} // namespace

void register_laboratory_bindings()
{
	py::scope().attr("mass_margin") = flexpm::mass_margin;
	py::def("contact_modulus",
	        flexpm::contact_modulus,
	        (py::arg("normal_stiffness"), py::arg("mean_diameter")),
	        "Stress over strain of a row of grains that are stiff against their contacts [Pa].");
	py::def("reference_strength",
	        referenceStrength,
	        (py::arg("tension"), py::arg("tensile_strength"), py::arg("cohesion"), py::arg("friction")),
	        "Strength of a specimen from its contacts alone [Pa].");
	py::def("bond_strengths",
	        bondStrengths,
	        (py::arg("strengths"), py::arg("areas"), py::arg("pairs"), py::arg("spheres")),
	        "Return two strengths [Pa] of bonds with these areas [m2] between pairs of spheres: the smallest that the bonds on 1 % of the area do not "
	        "exceed, and the largest whose bonds still connect all spheres.");
	py::def("rectangle_scales",
	        rectangleScales,
	        (py::arg("modulus"), py::arg("strengths"), py::arg("mass"), py::arg("thickness"), py::arg("dt"), py::arg("width"), py::arg("height")),
	        "Scales of a test of a rectangle by name, as AxialRecorder.scales; strengths as bond_strengths returns them.");
	py::def("disc_scales",
	        discScales,
	        (py::arg("modulus"), py::arg("strengths"), py::arg("mass"), py::arg("thickness"), py::arg("dt"), py::arg("diameter")),
	        "Scales of a test of a disc between two plates by name.");
	py::def("axial_stress",
	        axialStress,
	        (py::arg("bottom"), py::arg("top"), py::arg("area"), py::arg("tension")),
	        "Mean of the reactions of both ends [N] over an area [m2], positive in the sense of the loading [Pa].");
	py::def("end_mismatch",
	        endMismatch,
	        (py::arg("bottom"), py::arg("top")),
	        "Ratio of the sum of both ends' forces to the larger force, in absolute values [-].");
	py::def("splitting_area",
	        flexpm::splitting_area,
	        (py::arg("diameter"), py::arg("thickness")),
	        "Area by which the force of a Brazilian test is divided for its stress 2 P / (pi D t) [m2].");
	py::def("ramp_factor",
	        flexpm::ramp_factor,
	        (py::arg("step"), py::arg("ramp_steps")),
	        "Ratio of the load in the coming step of a ramp to the full load [-].");
	py::def("test_state",
	        testState,
	        (py::arg("stress"), py::arg("peak"), py::arg("strain"), py::arg("rule"), py::arg("plateau")),
	        "Return whether a test is over, and why. Stresses are above the confining pressure [Pa]. The rule has the stop ratio, the smallest peak, and "
	        "the smallest and the largest strain.");
	py::def("is_plateau",
	        isPlateau,
	        (py::arg("strains"), py::arg("stresses"), py::arg("plateau_strain")),
	        "Return whether the stresses above the confining pressure [Pa] have been constant, within 2 %, over the last plateau_strain; never if it is 0 "
	        "[-].");
	py::class_<StrainGauge, std::shared_ptr<StrainGauge>>(
	        "StrainGauge", "Bands and sides of a rectangle between which the strains of its grains are measured.", py::no_init)
	        .def("__init__",
	             py::make_constructor(
	                     strainGauge,
	                     py::default_call_policies(),
	                     (py::arg("bottom"), py::arg("height"), py::arg("mean_diameter"), py::arg("left"), py::arg("right"))),
	             "Left and right are pairs of a grain and the length of that side that belongs to it [m].")
	        .def("strains",
	             strains,
	             (py::arg("centres"), py::arg("displacements")),
	             "Axial and lateral strain [-] of grains from their centres, (n, 2) [m]; extension positive.");
}

} // namespace flexpm_bindings
