// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Material of deformable grains and of the contacts between them, paper Sec. 3.2. SI units.
#pragma once

#include <flexpm/kernel/law/bilinear.hpp>
#include <flexpm/kernel/law/elastic.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class GrainMat : public ElastMat {
public:
	~GrainMat() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(GrainMat, ElastMat,
		"Elastic grain with bilinear, frictional contacts [Azevedo2022]_. :yref:`young<ElastMat.young>` and "
		":yref:`poisson<ElastMat.poisson>` are properties of the grain [Pa], [-].",
		((Real, normalStiffness, 1.8e14,, "Normal stiffness of a contact per area K_n, Eq. 22 [Pa/m]."))
		((Real, shearRatio, 0.28,, "Ratio eta of shear to normal stiffness, Eq. 23 [-]."))
		((Real, tensileStrength, 8.5e6,, "Tensile strength of a contact point, Eq. 24 [Pa]."))
		((Real, cohesion, 29.75e6,, "Cohesion of a contact point, Eq. 25 [Pa]."))
		((Real, friction, 0.4,, "Coefficient of friction mu_c, Eq. 25, which also acts when a point has cracked [-]."))
		((Real, tensileFractureEnergy, 20.,, "Area under the tensile softening curve, Fig. 3a [N/m]."))
		((Real, shearFractureEnergy, 800.,, "Area under the shear softening curve, Fig. 3b [N/m]."))
		((Real, dilation, 0.,, "Tangent of the dilation angle of a joint, at most its friction: opening per plastic slip [-]."))
		((Real, dilationSlip, 0.,, "Plastic slip at which the dilation ends [m]."))
		((Real, residualFriction, 0.,, "Coefficient of friction after a slip of slipLength since the crack [-]."))
		((Real, slipLength, 0.,, "Plastic slip since the crack at which friction has fallen to residualFriction [m]; 0: friction stays."))
		((bool, planeStrain, false,, "Plane strain instead of plane stress."))
		, createIndex(); density = 2650;
	);
	// clang-format on
	REGISTER_CLASS_INDEX(GrainMat, ElastMat);
};
REGISTER_SAVED(GrainMat);

/// What the kernel takes from it: of a grain, and of a contact.
flexpm::ElasticMaterial elasticOf(const GrainMat& material);
flexpm::ContactMaterial contactOf(const GrainMat& material);

/// All that grains and contacts take from a material when they are assembled, in the order of the messages.
vector<Real> valuesOf(const GrainMat& material);

/// @throws std::runtime_error  if the material has not these values any more: nothing would follow them
void requireValues(const GrainMat& material, const vector<Real>& values);

} // namespace yade
