// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Elastic constants of a specimen: closed-form moduli and limits. SI units.
#include "support/specimens.hpp"

#include <flexpm/kernel/statics/elastic_constants.hpp>

#include "support/catch.hpp"

using namespace flexpm;

namespace {

Assembly random_assembly(double normal_stiffness)
{
    return specimens::assemble(specimens::random_grains(0.02, 0.04, 3e-3, 11),
        specimens::options(specimens::strong_contact(normal_stiffness)));
}

}  // namespace

TEST_CASE("a column of square grains has the modulus of grains and contacts in series", "[elastic]")
{
    const double young = 25.8e9, nu = 0.23, size = 2e-3, kn = 1.80e14;
    for (const Plane plane : { Plane::stress, Plane::strain }) {
        for (const int rows : { 1, 2, 8 }) {
            const Assembly a = specimens::assemble(specimens::grid(3, rows, size),
                specimens::options(specimens::strong_contact(kn), specimens::granite(plane)));
            const bool thin = plane == Plane::stress;
            const double modulus = thin ? young : young / (1.0 - nu * nu);
            const double ratio = thin ? nu : nu / (1.0 - nu);
            // rows - 1 contacts over the height rows * size; 1/E + 1/(K_n a) for many rows
            const double expected = 1.0 / (1.0 / modulus + (rows - 1.0) / (rows * kn * size));
            const ElasticConstants e = elastic_constants(a);
            CHECK(e.youngs_modulus == Approx(expected).epsilon(1e-9));
            CHECK(e.poissons_ratio == Approx(ratio * expected / modulus).epsilon(1e-9));
        }
    }
}

TEST_CASE("E and nu of a bonded assembly tend to the grains' as contacts stiffen", "[elastic]")
{
    const double young = 25.8e9, nu = 0.23;
    const ElasticConstants soft = elastic_constants(random_assembly(1.80e14));
    const ElasticConstants stiff = elastic_constants(random_assembly(1.80e16));
    const ElasticConstants stiffest = elastic_constants(random_assembly(1.80e17));
    CHECK(soft.youngs_modulus < 0.97 * young);
    CHECK(stiff.youngs_modulus == Approx(young).epsilon(0.01));
    CHECK(stiff.poissons_ratio == Approx(nu).epsilon(0.01));
    // first order in 1 / K_n
    CHECK((young - stiff.youngs_modulus) / (young - stiffest.youngs_modulus)
        == Approx(10.0).epsilon(0.02));
}

TEST_CASE("plane strain stiffens a bonded assembly as it does its grains", "[elastic]")
{
    const double young = 25.8e9, nu = 0.23;
    const Assembly a = specimens::assemble(specimens::random_grains(0.02, 0.04, 3e-3, 11),
        specimens::options(specimens::strong_contact(1.80e16), specimens::granite(Plane::strain)));
    const ElasticConstants e = elastic_constants(a);
    CHECK(e.youngs_modulus == Approx(young / (1.0 - nu * nu)).epsilon(0.01));
    CHECK(e.poissons_ratio == Approx(nu / (1.0 - nu)).epsilon(0.01));
}

TEST_CASE("an outline without four sides is refused", "[elastic]")
{
    const Assembly triangle = specimens::assemble(
        specimens::polygon({ { 0, 0 }, { 2e-3, 0 }, { 1e-3, 2e-3 } }), specimens::options());
    CHECK_THROWS_WITH(elastic_constants(triangle), Catch::Contains("side 3"));
}
