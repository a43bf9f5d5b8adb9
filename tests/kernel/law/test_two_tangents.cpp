// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The law of sizes with two tangents put to it: what a face in space needs and a contact of
/// the plane does not show. Tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/law/face_point.hpp>

#include "support/law_path.hpp"

#include <cmath>

using namespace law_path;
using flexpm::Point;

namespace {

/// A point of a face led along a path.
struct FacePath {
    flexpm::FacePlace at;
    flexpm::FacePointState state;
    flexpm::FaceTraction traction {};
    double work = 0.0;  ///< by the trapezoidal rule [J/m^2]

    void advance(const LawParameters& p, double opening_step, Point slip_step)
    {
        const Point before = at.slip;
        const flexpm::FaceTraction old = traction;
        at.opening += opening_step;
        at.slip = at.slip + slip_step;
        traction = flexpm::advance_face_point(p, at, before, state);
        work += 0.5 * (old.normal + traction.normal) * opening_step
            + 0.5 * dot(old.shear + traction.shear, slip_step);
    }
};

/// A material that may dilate, and steps that crack it sooner or later.
struct Case {
    ContactMaterial material;
    double opening, slip;  ///< largest step [m]

    explicit Case(flexpm::Random& random) : material(random_material(random))
    {
        if (random.next() < 0.5) {
            material.dilation = 0.9 * material.friction * random.next();
            material.dilation_slip = critical_slip(material) * random.next();
        }
        opening = 0.3 * elastic_opening(material);
        slip = 0.3 * elastic_slip(material);
    }
};

double either_way(flexpm::Random& random) { return 2.0 * random.next() - 1.0; }

}  // namespace

TEST_CASE("With no slip along its second tangent a point of a face is one of the plane")
{
    flexpm::Random random(31);
    // round-off: one adds up increments, the other takes the whole slip; steep softening grows it
    const double close = 1e-8;
    int cracked = 0;
    for (int i = 0; i < 300; ++i) {
        const Case c(random);
        Path plane(c.material);
        FacePath face;
        const double energy = c.material.shear_fracture_energy + c.material.tensile_fracture_energy;
        for (int k = 0; k < 60; ++k) {
            const double opening = c.opening * either_way(random);
            const double slip = c.slip * (either_way(random) + 0.3);
            plane.advance(opening, slip);
            face.advance(plane.law, opening, { slip, 0.0 });
            const double tensile = close * c.material.tensile_strength;
            REQUIRE(face.traction.normal == Approx(plane.traction.normal).margin(tensile));
            REQUIRE(face.traction.shear.x
                == Approx(plane.traction.shear).margin(close * c.material.cohesion));
            REQUIRE(face.traction.shear.y == 0.0);
            REQUIRE(face.traction.damage == Approx(plane.traction.damage).margin(close));
            const flexpm::PointState& s = plane.state;
            REQUIRE(face.state.damage_energy == Approx(s.damage_energy).margin(close * energy));
            REQUIRE(face.state.friction_energy == Approx(s.friction_energy).margin(close * energy));
        }
        cracked += plane.cracked();
    }
    CHECK(cracked > 50);
    CHECK(cracked < 290);
}

TEST_CASE("Which tangents a face has makes no difference, and its work is stored or lost")
{
    flexpm::Random random(32);
    // round-off, which a law that softens almost as steeply as it is stiff multiplies
    const double close = 1e-8;
    int cracked = 0;
    for (int i = 0; i < 300; ++i) {
        const Case c(random);
        const LawParameters p = flexpm::make_law(c.material);
        const double angle = 2.0 * flexpm::pi * random.next();
        const auto turned = [&](Point q) {
            const double x = std::cos(angle), y = std::sin(angle);
            return Point { x * q.x - y * q.y, y * q.x + x * q.y };
        };
        FacePath face, other;
        const double energy = c.material.shear_fracture_energy + c.material.tensile_fracture_energy;
        for (int k = 0; k < 60; ++k) {
            const double opening = c.opening * either_way(random);
            // one after the other: compilers take arguments in orders of their own
            const double along = either_way(random) + 0.3, across = either_way(random);
            const Point slip { c.slip * along, c.slip * across };
            face.advance(p, opening, slip);
            other.advance(p, opening, turned(slip));
            // a crack falls into another step where round-off decides; it does not in these draws
            const double tensile = close * c.material.tensile_strength;
            REQUIRE(other.traction.normal == Approx(face.traction.normal).margin(tensile));
            REQUIRE(norm(other.traction.shear - turned(face.traction.shear))
                < close * c.material.cohesion);
            REQUIRE(other.traction.damage == Approx(face.traction.damage).margin(close));
            REQUIRE(other.state.damage_energy
                == Approx(face.state.damage_energy).margin(close * energy));
            REQUIRE(other.state.friction_energy
                == Approx(face.state.friction_energy).margin(close * energy));
            REQUIRE(face.state.damage_energy >= -1e-13 * energy);
        }
        cracked += face.state.shear_damage >= 1.0;
    }
    CHECK(cracked > 30);
}

TEST_CASE("The work on a point of a face that slides round a circle is stored or lost")
{
    ContactMaterial material = specimens::granite_contact();
    const LawParameters p = flexpm::make_law(material);
    const double radius = 0.4 * critical_slip(material), pressure = 40e6;
    FacePath face;
    const int steps = 1000;
    face.advance(p, -pressure / p.normal_stiffness, {});
    for (int k = 0; k < steps; ++k) {
        const double angle = 2.0 * flexpm::pi * (k + 1) / steps;
        const Point to { radius * (1.0 - std::cos(angle)), radius * std::sin(angle) };
        face.advance(p, 0.0, to - face.at.slip);
    }
    CHECK(face.traction.damage == 1.0);
    // friction stays, against the slip
    CHECK(norm(face.traction.shear) == Approx(material.friction * pressure));
    const double kept = flexpm::law::elastic_energy(p, face.at, face.state)
        + face.state.damage_energy + face.state.friction_energy;
    // an identity of the trapezoidal rule, whichever way the slip turns
    CHECK(face.work == Approx(kept).epsilon(1e-12));
    CHECK(face.state.friction_energy > face.state.damage_energy);
}
