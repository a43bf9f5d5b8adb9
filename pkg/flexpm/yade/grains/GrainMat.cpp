// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Material of deformable grains.
#include <flexpm/yade/grains/GrainMat.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <array>

namespace yade {

YADE_PLUGIN((GrainMat));

GrainMat::~GrainMat() = default;

namespace {

	struct Property {
		const char* name;
		const char* unit;
		Real (*value)(const GrainMat&);
	};

	constexpr std::array<Property, 15> properties { {
		{ "young", " Pa", [](const auto& m) { return m.young; } },
		{ "poisson", "", [](const auto& m) { return m.poisson; } },
		{ "density", " kg/m^3", [](const auto& m) { return m.density; } },
		{ "normalStiffness", " Pa/m", [](const auto& m) { return m.normalStiffness; } },
		{ "shearRatio", "", [](const auto& m) { return m.shearRatio; } },
		{ "tensileStrength", " Pa", [](const auto& m) { return m.tensileStrength; } },
		{ "cohesion", " Pa", [](const auto& m) { return m.cohesion; } },
		{ "friction", "", [](const auto& m) { return m.friction; } },
		{ "tensileFractureEnergy", " N/m", [](const auto& m) { return m.tensileFractureEnergy; } },
		{ "shearFractureEnergy", " N/m", [](const auto& m) { return m.shearFractureEnergy; } },
		{ "dilation", "", [](const auto& m) { return m.dilation; } },
		{ "dilationSlip", " m", [](const auto& m) { return m.dilationSlip; } },
		{ "residualFriction", "", [](const auto& m) { return m.residualFriction; } },
		{ "slipLength", " m", [](const auto& m) { return m.slipLength; } },
		{ "planeStrain", "", [](const auto& m) { return Real(m.planeStrain); } },
	} };

} // namespace

flexpm::ElasticMaterial elasticOf(const GrainMat& m)
{
	return { m.young, m.poisson, m.density, m.planeStrain ? flexpm::Plane::strain : flexpm::Plane::stress };
}

flexpm::ContactMaterial contactOf(const GrainMat& m)
{
	flexpm::ContactMaterial c;
	c.normal_stiffness        = m.normalStiffness;
	c.shear_ratio             = m.shearRatio;
	c.tensile_strength        = m.tensileStrength;
	c.cohesion                = m.cohesion;
	c.friction                = m.friction;
	c.tensile_fracture_energy = m.tensileFractureEnergy;
	c.shear_fracture_energy   = m.shearFractureEnergy;
	c.dilation                = m.dilation;
	c.dilation_slip           = m.dilationSlip;
	c.residual_friction       = m.residualFriction;
	c.slip_length             = m.slipLength;
	return c;
}

vector<Real> valuesOf(const GrainMat& material)
{
	vector<Real> values;
	for (const Property& p : properties)
		values.push_back(p.value(material));
	return values;
}

void requireValues(const GrainMat& material, const vector<Real>& values)
{
	for (std::size_t i = 0; i < properties.size(); ++i) {
		const Property& p   = properties[i];
		const Real      now = p.value(material);
		if (now == values[i]) continue;
		const std::string unit = p.unit;
		flexpm::fail(
		        std::string("GrainMat.") + p.name,
		        flexpm::number(now) + unit,
		        "must stay " + flexpm::number(values[i]) + unit + " once the grains are assembled; build the specimen again");
	}
}

} // namespace yade
