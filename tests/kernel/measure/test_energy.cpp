// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The energy balance: exact for a linear system, kept to 1 % through breaking, and missed
/// when the law is wrong or the rate coarse, paper Eqs. 1-3. SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include "support/balance.hpp"
#include "support/driven.hpp"
#include "support/law_path.hpp"

using namespace driven;

namespace {

// Strains of 1e-14 leave the elements linear to that order; displacements keep all their digits.
constexpr double tiny = 1e-17;  // [m]

void shake(Assembly& a, double speed, std::uint64_t seed)
{
    flexpm::Random random(seed);
    for (int g = 0; g < a.grains.count; ++g) {
        set_velocity(a, g, [&](Point) {
            const double x = random.next(), y = random.next();
            return Point { speed * (2.0 * x - 1.0), speed * (2.0 * y - 1.0) };
        });
    }
}

/// Largest miss of the balance in `steps` measured steps, over the largest energy put in.
template <class Each>
double largest_miss(Assembly& a, double damping, int steps, int every, Each each)
{
    flexpm::StepOptions o;
    o.damping = damping;
    double worst = 0.0, most = 0.0;
    for (int i = 0; i < steps; ++i) {
        o.measure = (i + 1) % every == 0;
        each(i);
        flexpm::step(a, o);
        if (!o.measure) continue;
        const flexpm::Energies e = flexpm::energies(a);
        worst = std::max(worst, std::fabs(balance::miss(e)));
        most = std::max(most, std::max(std::fabs(e.boundary_work), e.initial));
    }
    return worst / most;
}
double largest_miss(Assembly& a, double damping, int steps, int every = 1)
{
    return largest_miss(a, damping, steps, every, [](int) {});
}

Assembly bonded_grid(double damping)
{
    Assembly a = specimens::assemble(specimens::grid(4, 3, 3e-3), specimens::options());
    flexpm::scale_masses(a, damping);
    return a;
}

/// A random specimen pulled or pushed at its top, its bottom held axially.
struct AxialTest {
    Assembly a;
    std::vector<int> top;

    explicit AxialTest(const flexpm::ContactMaterial& m) :
        a(specimens::assemble(
            specimens::random_grains(9e-3, 12e-3, 3e-3, 5), specimens::options(m)))
    {
        flexpm::scale_masses(a, 0.7);
        top = flexpm::side_nodes(a, 2);
        const auto bottom = flexpm::side_nodes(a, 0);
        flexpm::prescribe(a, bottom, 1, 0.0);
        flexpm::prescribe(a, { bottom.front() }, 0, 0.0);
    }
    void drive(double velocity) { flexpm::prescribe(a, top, 1, velocity); }
};

}  // namespace

TEST_CASE("Free vibration without damping keeps the leapfrog energy to 1e-10")
{
    Assembly a = bonded_grid(0.0);
    shake(a, tiny, 1);
    flexpm::reset_energy_balance(a);
    CHECK(flexpm::energies(a).initial > 0.0);
    CHECK(largest_miss(a, 0.0, 2000) < 1e-10);
    const flexpm::Energies e = flexpm::energies(a);
    CHECK(e.elastic > 0.2 * e.initial);  // it does vibrate
    CHECK(e.kinetic > 0.2 * e.initial);
    CHECK(e.damping == 0.0);
    CHECK(e.boundary_work == 0.0);
}

TEST_CASE("Local damping takes exactly what the motion loses")
{
    Assembly a = bonded_grid(0.7);
    shake(a, tiny, 2);
    flexpm::reset_energy_balance(a);
    CHECK(largest_miss(a, 0.7, 2000) < 1e-10);
    const flexpm::Energies e = flexpm::energies(a);
    CHECK(e.damping == Approx(e.initial).epsilon(1e-6));
}

TEST_CASE("Grains that have flown apart are not in balance")
{
    Assembly a = bonded_grid(0.7);
    CHECK(flexpm::unbalanced_ratio(a) == 0.0);
    for (int g = 0; g < a.grains.count; ++g)
        set_velocity(a, g, Point { 1.0 * g, 1.0 * g });  // each far from the others within a step
    flexpm::StepOptions o;
    o.measure = true;
    flexpm::step(a, o);
    shake(a, 1e-9, 4);
    flexpm::step(a, o);
    CHECK(flexpm::sum_of_forces(a.contacts) == 0.0);
    CHECK(flexpm::unbalanced_ratio(a) == 1.0);
}

TEST_CASE("Work of driven nodes and of edge pressure is what the specimen stores and damps")
{
    Assembly a = bonded_grid(0.7);
    flexpm::reset_energy_balance(a);
    const auto bottom = flexpm::side_nodes(a, 0), top = flexpm::side_nodes(a, 2);
    flexpm::prescribe(a, bottom, 1, 0.0);
    const double pressure = 25.8e9 * tiny / 3e-3;  // strains of the same size
    flexpm::prescribe(a, top, 1, -0.01 * tiny);
    CHECK(largest_miss(a, 0.7, 2000, 1, [&](int i) {
        flexpm::set_pressure(a, 1, pressure * std::min(i / 500.0, 1.0));
        flexpm::set_pressure(a, 3, pressure * std::min(i / 500.0, 1.0));
    }) < 1e-10);
    CHECK(std::fabs(a.ledger.pressure_work) > 0.01 * flexpm::energies(a).boundary_work);
}

TEST_CASE("Books opened in the middle of a motion count from there")
{
    Assembly a = bonded_grid(0.3);
    shake(a, tiny, 3);
    flexpm::reset_energy_balance(a);
    largest_miss(a, 0.3, 101);
    flexpm::reset_energy_balance(a);
    const flexpm::Energies e = flexpm::energies(a);
    CHECK(e.damping == 0.0);
    CHECK(e.initial > 0.0);
    CHECK(largest_miss(a, 0.3, 500) < 1e-10);
}

namespace {

/// Books of an axial test: velocity of the top [m/s], way [m], and what is done to the assembly
/// after every step.
template <class Each>
double axial_miss(const flexpm::ContactMaterial& m, double velocity, double way, Each each)
{
    AxialTest test(m);
    test.drive(velocity);
    flexpm::reset_energy_balance(test.a);
    const int steps = static_cast<int>(way / std::fabs(velocity));
    const double worst =
        largest_miss(test.a, 0.7, steps, std::max(steps / 500, 1), [&](int) { each(test.a); });
    CHECK(flexpm::count_cracks(test.a).tensile > 3);
    return worst;
}

/// Calls each(contact, point, state) for all points.
template <class Each> void for_each_point(Assembly& a, Each each)
{
    for (int c = 0; c < a.contacts.count; ++c) {
        for (int p = 0; p < a.contacts.group.points; ++p)
            each(c, p, a.contacts.point_state(c, p));
    }
}

}  // namespace

TEST_CASE("The energies balance to 1 % of the work while a specimen breaks")
{
    const auto m = specimens::granite_contact();
    const auto leave = [](Assembly&) {};
    CHECK(axial_miss(m, 2e-9, 1.2e-5, leave) < 0.01);
    CHECK(axial_miss(m, -2e-8, 2e-4, leave) < 0.01);
    CHECK(axial_miss(law_path::brittle(m), 2e-9, 6e-6, leave) < 0.01);
    CHECK(axial_miss(law_path::brittle(m), -2e-8, 2e-4, leave) < 0.01);
}

TEST_CASE("Energies do not balance under wrong laws")
{
    const auto m = specimens::granite_contact();
    // shear that forgets a thousandth of its traction in every step
    CHECK(axial_miss(m, -2e-8, 2e-4, [](Assembly& a) {
        for_each_point(a, [&](int c, int p, const flexpm::PointState& s) {
            a.contacts.state(c, p, &flexpm::PointState::shear_traction) = 0.999 * s.shear_traction;
        });
    }) > 0.01);
    // unloading along K_n: the opening from which the elastic slope starts stays behind
    CHECK(axial_miss(m, 2e-9, 1.2e-5, [](Assembly& a) {
        for_each_point(a, [&](int c, int p, const flexpm::PointState& s) {
            const flexpm::LawParameters& law = a.contacts.law_of(c);
            const double d = flexpm::law::damage(law, s.max_opening, s.shear_damage);
            if (d == 0.0 || d == 1.0 || s.opening >= s.max_opening) return;
            const double slope = flexpm::law::secant(law, s.max_opening, d);
            const double unloading = s.max_opening - s.opening;
            a.contacts.state(c, p, &flexpm::PointState::opening) -=
                unloading * std::max(law.normal_stiffness / slope - 1.0, 0.0);
        });
    }) > 0.01);
    // cracks that heal
    CHECK(axial_miss(m, 2e-9, 1.2e-5, [](Assembly& a) {
        for_each_point(a, [&](int c, int p, const flexpm::PointState& s) {
            a.contacts.state(c, p, &flexpm::PointState::max_opening) = 0.999 * s.max_opening;
        });
    }) > 0.01);
}

TEST_CASE("Energies do not balance at a coarse rate, halving it halves the miss")
{
    // two held grains drawn apart: each point passes its softening branch in a few steps or in many
    const auto m = specimens::granite_contact();
    const auto miss_at = [&](double fraction, const flexpm::ContactMaterial& material) {
        Assembly a = specimens::assemble(specimens::grid(2, 1, 3e-3), specimens::options(material));
        hold_all(a);
        set_velocity(a, 1, Point { fraction * law_path::critical_opening(material), 0.0 });
        flexpm::reset_energy_balance(a);
        return largest_miss(a, 0.0, static_cast<int>(2.0 / fraction));
    };
    CHECK(miss_at(0.7, m) > 0.1);
    CHECK(miss_at(1.0 / 500.3, m) < 0.01);
    const auto brittle = law_path::brittle(m);
    CHECK(miss_at(0.9, brittle) > 0.1);
    CHECK(miss_at(1.0 / 1000.3, brittle) < 0.01);
    CHECK(miss_at(1.0 / 2000.3, brittle) < 0.6 * miss_at(1.0 / 1000.3, brittle));
}

TEST_CASE("energies of blocks are those of their grains and points")
{
    AxialTest test(specimens::granite_contact());
    Assembly& a = test.a;
    REQUIRE(a.grains.count % flexpm::lanes != 0);  // some lanes are empty
    REQUIRE(a.contacts.count % flexpm::lanes != 0);
    test.drive(2e-8);
    for (int i = 0; i < 400; ++i)
        flexpm::step(a, flexpm::StepOptions());

    double strain = 0.0;
    for (int g = 0; g < a.grains.count; ++g) {
        for (int t = 0; t < flexpm::triangles_of(a.grains, g); ++t) {
            const auto n = flexpm::triangle_nodes(a.grains, g, t);
            const auto u = [&](int k) {
                return vector_at(a.grains.displacement, a.grains.node(g, n[k]));
            };
            strain += flexpm::triangle_energy(flexpm::shape_of(a.grains, g, t),
                flexpm::stiffness_of(a.grains, g), u(0), u(1), u(2));
        }
    }
    double stored = 0.0, softened = 0.0;
    flexpm::ContactLoss lost;
    for (int c = 0; c < a.contacts.count; ++c) {
        for (int p = 0; p < a.contacts.group.points; ++p) {
            const flexpm::PointState s = a.contacts.point_state(c, p);
            const double area = a.contacts.area(c, p);
            stored += area * flexpm::law::elastic_energy(a.contacts.law_of(c), s);
            lost.damage += area * s.damage_energy;
            if (a.contacts.crack_steps[a.contacts.point_index(c, p)] < 0)
                softened += area * s.damage_energy;
            lost.friction += area * s.friction_energy;
        }
    }
    double forces = 0.0;
    for (int c = 0; c < a.contacts.count; ++c) {
        const double* f = &a.contacts.forces[flexpm::Contacts::force_index(c, 0, 0)];
        forces += std::hypot(f[0] + f[2], f[1] + f[3]);
    }
    CHECK(flexpm::sum_of_forces(a.contacts) == Approx(forces).epsilon(1e-12));
    const flexpm::ContactLoss found = flexpm::contact_loss(a.contacts);
    REQUIRE(lost.damage > 0.0);
    CHECK(flexpm::strain_energy(a.grains) == Approx(strain).epsilon(1e-12));
    CHECK(flexpm::contact_energy(a.contacts) == Approx(stored).epsilon(1e-12));
    CHECK(found.damage == Approx(lost.damage).epsilon(1e-12));
    CHECK(found.friction == Approx(lost.friction).epsilon(1e-12));
    REQUIRE(softened > 0.0);
    CHECK(flexpm::softened_energy(a.contacts) == Approx(softened).epsilon(1e-12));
}

TEST_CASE("The power of damping sums to its work, and is none where all move with the loading")
{
    const bool rigid = GENERATE(false, true);
    auto options = specimens::options();
    options.rigid = rigid;
    Assembly a = specimens::assemble(specimens::grid(4, 3, 3e-3), options);
    flexpm::scale_masses(a, 0.7);
    flexpm::reset_energy_balance(a);
    if (rigid) {
        for (int g = 0; g < a.grains.count; ++g)
            flexpm::set_motion(
                a.grains, g, { tiny * (g % 3), -tiny * (g % 2) }, 1e2 * tiny * g, 1.0);
    } else {
        shake(a, tiny, 7);
    }
    double sum = 0.0;
    flexpm::StepOptions o;
    o.dt = 0.05;  // steps that are short beside all vibrations: a power times dt is a work
    for (int i = 0; i < 2000; ++i) {
        flexpm::step(a, o);
        sum += o.dt * flexpm::damping_power(a, o.damping);
    }
    CHECK(sum / flexpm::energies(a).damping == Approx(1.0).epsilon(0.05));
    a.loading.grains.velocity = a.grains.velocity;
    a.loading.grains.spin = a.grains.spin;
    CHECK(flexpm::damping_power(a, o.damping) == 0.0);
}

TEST_CASE("What damping does to the motion that it leaves alone has a name of its own")
{
    Assembly a = bonded_grid(0.7);
    shake(a, tiny, 5);
    for (std::size_t i = 0; i < a.grains.velocity.size(); ++i)
        a.loading.grains.velocity[i] = 3.0 * tiny;
    flexpm::reset_energy_balance(a);
    flexpm::StepOptions o;
    o.damping = 0.7;
    o.measure = true;
    double before = 0.0, given = 0.0, lost = 0.0, miss = 0.0;
    for (int i = 0; i < 400; ++i) {
        flexpm::step(a, o);
        const flexpm::Energies e = flexpm::energies(a);
        lost = std::max(lost, before - e.damping);
        before = e.damping;
        given = std::max(given, std::fabs(e.drag));
        miss = std::max(miss, std::fabs(balance::miss(e)));
    }
    CHECK(before > 0.0);
    CHECK(lost <= 1e-3 * before);  // a node that turns within a step
    CHECK(given > 0.1 * before);
    CHECK(miss < 1e-10 * before);
}
