// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plane stiffness from Young's modulus and Poisson's ratio.
#include <flexpm/kernel/law/elastic.hpp>

#include <flexpm/kernel/core/require.hpp>

namespace flexpm {

PlaneStiffness plane_stiffness(const ElasticMaterial& m)
{
    check_positive("young", m.young, "Pa");
    if (!(m.poisson > 0.0 && m.poisson < 0.5)) {
        refuse("poisson", m.poisson, "", "must lie between 0 and 0.5; correct it");
    }
    check_positive("density", m.density, "kg/m^3");
    const double shear = 0.5 * m.young / (1.0 + m.poisson);
    if (m.plane == Plane::stress) {
        const double normal = m.young / (1.0 - m.poisson * m.poisson);
        return { normal, m.poisson * normal, shear };
    }
    const double scale = m.young / ((1.0 + m.poisson) * (1.0 - 2.0 * m.poisson));
    return { (1.0 - m.poisson) * scale, m.poisson * scale, shear };
}

}  // namespace flexpm
