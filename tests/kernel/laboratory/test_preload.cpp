// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Preload of a test along its elastic solution, in 2D and 3D: equilibrium, the first point's
/// utilisation, and the energy balance. SI units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/preload.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>

#include "laboratory/gripped.hpp"
#include "support/balance.hpp"
#include "support/solid_states.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace flexpm;

namespace {

constexpr double share = 0.9;
constexpr PreloadPath path { share, 10, 1.0 };

Sense sense_of(double velocity) { return velocity < 0.0 ? Sense::compression : Sense::tension; }

/// Largest share of its strength that a point bears, tension or Mohr-Coulomb. At a load that grows
/// in proportion c / (|shear| + mu normal) is what it may still grow by.
struct Utilisation {
    double largest = 0.0;

    void add(const LawParameters& law, double normal, double shear)
    {
        largest = std::max(largest, normal / law.tensile_strength);
        largest = std::max(largest, (shear + law.friction * normal) / law.cohesion);
    }
};

/// Random grains between driven ends.
struct Rectangle {
    static constexpr double speed = 1e-9;  ///< [m/step]
    static constexpr bool between_plates = false;
    double velocity;
    Assembly a;
    ElasticConstants solved;
    std::vector<int> held;

    explicit Rectangle(double v) : velocity(v), a(gripped::grains(v)), solved(elastic_constants(a))
    {
    }
    Assembly& state() { return a; }
    void preload(const PreloadPath& along = path) { held = flexpm::preload(a, along); }
    void release(double v) { release_preload(a, held, v, 1.0, false); }
    void run(int steps) { gripped::run(a, steps); }
    TestFrame frame() const { return rectangle_frame(a, sense_of(velocity)); }
    AxialObservation observe() const { return flexpm::observe(a, frame()); }
    double height() const { return frame().height; }
    double utilisation() const
    {
        Utilisation of;
        for (int c = 0; c < a.contacts.count; ++c) {
            const LawParameters& law = a.contacts.law_of(c);
            for (int p = 0; p < a.contacts.group.points; ++p) {
                const PointState s = a.contacts.point_state(c, p);
                of.add(law, law.normal_stiffness * s.opening, std::fabs(s.shear_traction));
            }
        }
        return of.largest;
    }
};

/// The same in 3D.
template <bool rigid> struct Box {
    static constexpr double speed = 1e-10;  ///< smaller grains come to their strengths sooner
    static constexpr bool between_plates = rigid;
    double velocity;
    SolidState s;
    ElasticConstants solved;
    SolidDrive drive;
    SolidField field;
    std::vector<int> held;

    explicit Box(double v) : velocity(v)
    {
        const auto packing = solid_states::box(60, 2);
        s = make_solid(packing.cells, packing.solid,
            solid_states::granite(FacePointRule::corners_and_inner, rigid));
        solved = constants_between_ends(s);
        hold_ends(s, { v > 0.0, false });
        scale_masses(s, 0.7);
        drive = drive_of_top(s);
        field = elastic_field(s);
    }
    SolidState& state() { return s; }
    void preload(const PreloadPath& along = path)
    {
        held = flexpm::preload(s, drive, field, velocity < 0.0 ? -1.0 : 1.0, along);
    }
    void release(double v) { release_preload(s, drive, held, v, 1.0, false); }
    void run(int steps)
    {
        for (int i = 0; i < steps; ++i)
            step(s, { 1.0, 0.7, 1, true });
    }
    AxialObservation observe() const
    {
        return flexpm::observe(s, solid_frame(s, sense_of(velocity)));
    }
    double height() const { return solid_frame(s, sense_of(velocity)).height; }
    double utilisation() const
    {
        Utilisation of;
        for (int c = 0; c < s.contacts.count; ++c) {
            for (int p = 0; p < s.contacts.points_of(c); ++p) {
                const FaceTraction t = traction_of(s, c, p);
                of.add(s.contacts.law_of(c), t.normal, norm(t.shear));
            }
        }
        return of.largest;
    }
};

using DeformableBox = Box<false>;
using RigidBox = Box<true>;

}  // namespace

TEMPLATE_TEST_CASE(
    "A specimen preloaded along its elastic solution is in equilibrium at the share asked for",
    "[solids]", Rectangle, DeformableBox, RigidBox)
{
    const double velocity = GENERATE(-1e-9, 1e-9);
    TestType test(velocity);
    test.preload();
    test.run(path.steps);
    const AxialObservation o = test.observe();
    // the solution is linear: strains of a few 1e-4 turn and stretch by as much of each term
    CHECK(test.utilisation() == Approx(share).epsilon(2e-3));
    CHECK(o.axial_stress / o.axial_strain == Approx(test.solved.youngs_modulus).epsilon(2e-3));
    CHECK(o.lateral_strain / o.axial_strain == Approx(test.solved.poissons_ratio).epsilon(2e-3));
    const Energies e = energies(test.state());
    CHECK(e.damage == 0.0);
    CHECK(e.initial == 0.0);
    CHECK(std::fabs(balance::miss(e)) < 1e-5 * e.elastic);
}

TEMPLATE_TEST_CASE("After the elastic solution the test goes on without a jolt", "[solids]",
    Rectangle, DeformableBox, RigidBox)
{
    const double velocity = GENERATE(-1.0, 1.0) * TestType::speed;
    TestType test(velocity);
    test.preload();
    test.run(path.steps);
    const AxialObservation before = test.observe();
    test.release(velocity);
    CHECK(unbalanced_ratio(test.state()) == 0.0);  // nothing was free
    double largest = 0.0;
    for (int i = 0; i < 300; ++i) {
        test.run(1);
        largest = std::max(largest, unbalanced_ratio(test.state()));
    }
    CHECK(largest < 5e-3);
    const AxialObservation after = test.observe();
    const double strain = after.axial_strain - before.axial_strain;
    // the record's strain of rigid grains has no part in what lies before the plates
    if (!TestType::between_plates)
        CHECK(strain == Approx(300.0 * std::fabs(velocity) / test.height()).epsilon(1e-6));
    CHECK(after.axial_stress - before.axial_stress
        == Approx(strain * before.axial_stress / before.axial_strain).epsilon(0.02));
    const Energies e = energies(test.state());
    CHECK(std::fabs(balance::miss(e)) < 1e-5 * e.elastic);
}

TEMPLATE_TEST_CASE("A start from the elastic solution refuses shares and steps that make no sense",
    "[solids]", Rectangle, RigidBox)
{
    TestType test(-1e-9);
    CHECK_THROWS_AS(test.preload({ 1.0, 10, 1.0 }), std::invalid_argument);
    CHECK_THROWS_AS(test.preload({ 0.0, 10, 1.0 }), std::invalid_argument);
    CHECK_THROWS_AS(test.preload({ share, 0, 1.0 }), std::invalid_argument);
}

TEMPLATE_TEST_CASE("A release without a preload is refused", "[solids]", Rectangle, DeformableBox)
{
    TestType test(0.0);
    CHECK_THROWS_WITH(test.release(-1e-9), Catch::Contains("velocity of the preload = 0 m/s"));
    CHECK_THROWS_AS(test.release(std::nan("")), std::invalid_argument);
}

TEST_CASE("A solid with a point past its strength has no elastic start", "[solids]")
{
    Box<false> test(1e-9);
    start_ends(test.s, test.field, 1.2 * elastic_strain(test.s, test.field, 1.0), 0.0, false, 1.0);
    REQUIRE(energies(test.s).damage > 0.0);
    CHECK_THROWS_WITH(test.preload(), Catch::Contains("no contact point may have softened"));
}
