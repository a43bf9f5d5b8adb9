// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The kernel's step against a plain one, step by step from the solver's own state, for
/// random assemblies.
///
/// FLEXPM_ASSEMBLIES gives another number of assemblies, and has the largest differences printed;
/// FLEXPM_FIRST_SEED is the first of their seeds:
///     FLEXPM_ASSEMBLIES=10000 kernel_tests "[reference]"
#include "support/catch.hpp"

#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "reference/plain_step.hpp"
#include "reference/random_case.hpp"
#include "reference/read_state.hpp"
#include "support/joint_rows.hpp"

#include <cstdlib>
#include <string>

namespace {

int number_from_environment(const char* name, int otherwise)
{
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : std::stoi(text);
}

/// What the contact points of all assemblies have gone through.
struct Events {
    long softened = 0, cracked = 0, closed = 0, slid = 0;

    void count(const plain::Specimen& before, const plain::Specimen& after)
    {
        for (std::size_t c = 0; c < after.contacts.size(); ++c) {
            for (std::size_t p = 0; p < after.contacts[c].points.size(); ++p) {
                const plain::ContactPoint& now = after.contacts[c].points[p];
                const flexpm::PointState &s = now.state, &old = before.contacts[c].points[p].state;
                cracked += now.crack_step == after.step;
                softened += s.damage_energy > old.damage_energy;
                closed += old.opening > 0.0 && s.opening <= 0.0;
                slid += s.friction_energy > old.friction_energy;
            }
        }
    }
};

plain::Differences largest_differences(plain::RandomCase& drawn, Events& events)
{
    plain::Differences largest;
    flexpm::StepOptions options;
    options.dt = drawn.dt;
    options.damping = drawn.damping;
    for (int i = 0; i < drawn.steps && !drawn.has_diverged(); ++i) {
        drawn.load();
        options.measure = i % 3 == 0;
        plain::Specimen expected = plain::read_state(drawn.assembly);
        const plain::Specimen before = expected;
        plain::step(expected, drawn.dt, drawn.damping);
        flexpm::step(drawn.assembly, options);
        const plain::Specimen found = plain::read_state(drawn.assembly);
        largest.take_larger(plain::compare(before, found, expected));
        events.count(before, found);
    }
    return largest;
}

}  // namespace

TEST_CASE("A step agrees with a plain one", "[reference]")
{
    const int assemblies = number_from_environment("FLEXPM_ASSEMBLIES", 300);
    const int first = number_from_environment("FLEXPM_FIRST_SEED", 1);
    plain::Differences all;
    Events events;
    for (int seed = first; seed < first + assemblies; ++seed) {
        plain::RandomCase drawn(seed);
        const plain::Differences found = largest_differences(drawn, events);
        CAPTURE(seed, drawn.name, found.text());
        CHECK(found.largest() < 1e-12);
        CHECK(found.records == 0);
        all.take_larger(found);
    }
    const bool tells = std::getenv("FLEXPM_ASSEMBLIES") != nullptr;
    if (tells) {
        WARN(assemblies << " assemblies: " << all.points << " steps of points, " << all.excepted
                        << " excepted; largest differences: " << all.text() << "; softened "
                        << events.softened << ", cracked " << events.cracked << ", closed "
                        << events.closed << ", slid " << events.slid);
    }
    CHECK(all.excepted <= 1 + all.points / 1000000);
    for (long count : { events.softened, events.cracked, events.closed, events.slid })
        CHECK(count > 10 * assemblies);
}

TEST_CASE("A step between faces that have been paired anew agrees with a plain one", "[reference]")
{
    const bool rigid = GENERATE(false, true);
    flexpm::Assembly a = joint_rows::two_rows(rigid);
    flexpm::scale_masses(a, 0.7);
    // across the joint, along it and turning
    for (int g = 0; g < a.grains.count; ++g) {
        const bool upper = g >= joint_rows::columns;
        driven::set_velocity(a, g, [&](flexpm::Point p) {
            return upper ? flexpm::Point { 1e-5 - 1e-4 * p.y, 1e-4 * p.x - 2e-6 }
                         : flexpm::Point {};
        });
        if (rigid && upper) a.grains.spin[a.grains.slot[g]] = 1e-4;
    }
    flexpm::StepOptions options;
    options.damping = 0.0;
    plain::Differences all;
    int changes = 0;
    for (int i = 0; i < 300; ++i) {
        changes += !flexpm::follow_faces(a, 0.7, 1.0).empty();
        plain::Specimen expected = plain::read_state(a);
        const plain::Specimen before = expected;
        plain::step(expected, options.dt, options.damping);
        flexpm::step(a, options);
        all.take_larger(plain::compare(before, plain::read_state(a), expected));
    }
    CAPTURE(all.text());
    CHECK(changes > 5);
    CHECK(all.largest() < 1e-12);
    CHECK(all.records == 0);
}
