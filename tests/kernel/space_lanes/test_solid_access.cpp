// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What scripts read of contacts and grains of a solid, against sums that must agree. SI
/// units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/measure/grain_stress.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include "support/solid_states.hpp"

#include <random>

using namespace solid_states;

namespace {

/// Some grains, moved and turned at random, some points cracked.
SolidState moved(bool rigid)
{
    const Packing p = packing(30, 5);
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
    scale_masses(s, 0.7);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-2e-7, 2e-7);
    for (int g = 0; g < s.grains.count; ++g) {
        if (rigid) {
            set_motion(s, g, { any(random), any(random), any(random) },
                1e3 * Vector { any(random), any(random), any(random) });
            continue;
        }
        for (int n = 0; n < s.grains.nodes_of(g); ++n)
            set_space_vector(
                s.grains.velocity, s.grains.node(g, n), { any(random), any(random), any(random) });
    }
    for (int k = 0; k < 20; ++k)
        step(s, { 1.0, 0.7, 1, true });
    return s;
}

}  // namespace

TEST_CASE("Forces of contacts are all that acts on grains, and leave no moment", "[solids]")
{
    for (const bool rigid : { false, true }) {
        const SolidState s = moved(rigid);
        std::vector<Vector> force(s.grains.count);
        for (int c = 0; c < s.contacts.count; ++c) {
            const auto [a, b] = s.contacts.pairs[c];
            force[b] = force[b] + contact_force(s, c);
            force[a] = force[a] - contact_force(s, c);
        }
        double largest = 0.0, worst = 0.0, moment = 0.0;
        Vector whole;
        for (int g = 0; g < s.grains.count; ++g) {
            const Resultant on = resultant_on(s, g);
            largest = std::max(largest, norm(on.force));
            worst = std::max(worst, norm(on.force - force[g]));
            moment = std::max(moment, norm(on.moment));
            whole = whole + on.moment + cross(s.grains.position(s.grains.centre(g)), on.force);
        }
        CHECK(largest > 1.0);
        CHECK(worst < 1e-9 * largest);
        CHECK(norm(whole) < 1e-9 * moment);
    }
}

TEST_CASE("The points of a contact have its centroid, area and stiffness", "[solids]")
{
    const Packing p = packing(30, 5);
    const SolidState s = make_solid(p.cells, p.solid, granite());
    for (int c = 0; c < s.contacts.count; ++c) {
        const auto face = middle_face(s, c);
        const Vector normal = normal_of(face), origin = face[0];
        // centroid of the triangles of the face, projected on its plane
        Vector sum;
        double area = 0.0;
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            const double part = 0.5 * dot(normal, cross(face[k] - origin, face[k + 1] - origin));
            sum = sum + (part / 3.0) * (origin + face[k] + face[k + 1]);
            area += part;
        }
        CAPTURE(c);
        CHECK(contact_area(s.contacts, c) == Approx(area).epsilon(1e-9));
        const Vector off = contact_middle(s, c) - (1.0 / area) * sum;
        CHECK(norm(off - dot(off, normal) * normal) < 1e-9 * std::sqrt(area));
        const LawParameters& law = s.contacts.law_of(c);
        CHECK(bond_stiffness(s.contacts, c).normal == Approx(law.normal_stiffness * area));
        CHECK(bond_stiffness(s.contacts, c).shear == Approx(law.shear_stiffness * area));
        const Vector way = space_vector(s.grains.reference, s.grains.centre(s.contacts.pairs[c][1]))
            - space_vector(s.grains.reference, s.grains.centre(s.contacts.pairs[c][0]));
        CHECK(dot(contact_frame(s, c).normal, way) > 0.0);
        CHECK(mean_opening(s, c) == 0.0);
    }
}

TEST_CASE("Real masses of grains are those of the box", "[solids]")
{
    const Packing p = packing(30, 5);
    const SolidState s = make_solid(p.cells, p.solid, granite());
    const double edge = solid_samples::side * std::cbrt(0.6 * 30);
    const double density = s.grains.elastic[0].density;
    double mass = 0.0, volume = 0.0;
    for (int g = 0; g < s.grains.count; ++g) {
        mass += real_mass(s, g).mass;
        volume += grain_stress(s, g).volume;
    }
    CHECK(volume == Approx(edge * edge * edge).epsilon(1e-12));
    CHECK(mass == Approx(density * edge * edge * edge).epsilon(1e-12));
}

TEST_CASE("A motion is given to rigid grains alone", "[solids]")
{
    SolidState rigid = moved(true), flexible = moved(false);
    set_motion(rigid, 3, { 1.0, 2.0, 3.0 }, { 0.0, 0.0, 4.0 });
    const int centre = rigid.grains.centre(3), corner = rigid.grains.node(3, 0);
    const Vector arm = rigid.grains.position(corner) - rigid.grains.position(centre);
    const Vector expected { 1.0 - 4.0 * arm.y, 2.0 + 4.0 * arm.x, 3.0 };
    CHECK(norm(node_velocity(rigid, 3, corner) - expected) < 1e-12);
    CHECK_THROWS_WITH(set_motion(flexible, 3, {}, {}),
        "grain = 3, is deformable, must be rigid; write to its velocities instead");
    CHECK_THROWS(set_motion(rigid, 3, { std::nan(""), 0.0, 0.0 }, {}));
}
