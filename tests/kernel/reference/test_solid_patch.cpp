// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Elastic solids under uniform stress and by any rotation, by the plain step of solids
/// against closed forms.
#include "support/catch.hpp"

#include <flexpm/kernel/statics/solid_constants.hpp>

#include "reference/solid_samples.hpp"

using namespace solid_samples;

namespace {

constexpr double damping = 0.7;

/// The granite as the static solve takes it.
flexpm::SolidElasticity elasticity(double normal_stiffness = 1.8e14)
{
    const auto grain = specimens::granite();
    const auto contact = specimens::strong_contact(normal_stiffness);
    return { grain.young, grain.poisson, contact.normal_stiffness, contact.shear_ratio };
}

/// Constants of a specimen pulled between ends without friction.
struct Constants {
    double young, poisson;
    double unbalanced;  ///< largest free force over the load
};

/// Pull along z between ends that glide, until the forces are in balance to `tolerance`.
Constants pull(Specimen& s, Vector size, double strain, double tolerance)
{
    scale_masses(s, 1.0, damping);
    const double low = 1e-6 * size.z;
    for (Node& n : s.nodes) {
        const Vector r = n.reference;
        // begins with the strain of a bar, so that little has to relax
        n.displacement = { -0.2 * strain * (r.x - 0.5 * size.x),
            -0.2 * strain * (r.y - 0.5 * size.y), strain * r.z };
        n.held[2] = r.z < low || r.z > size.z - low;
    }
    Constants c {};
    for (int k = 0; k < 20000; ++k) {
        step(s, 1.0, damping);
        if (k % 50 != 49) continue;
        double load = 0.0, free = 0.0;
        for (const Node& n : s.nodes) {
            if (n.held[2] && n.reference.z > low) load -= n.force.z;
            free = std::max({ free, std::fabs(n.force.x), std::fabs(n.force.y),
                n.held[2] ? 0.0 : std::fabs(n.force.z) });
        }
        c.young = load / (size.x * size.y * strain);
        c.unbalanced = free / load;
        if (c.unbalanced < tolerance) break;
    }
    // mean of the sides
    double widths[2] = { 0.0, 0.0 };
    int counts[2] = { 0, 0 };
    for (const Node& n : s.nodes) {
        const bool right = n.reference.x > size.x - low;
        if (!right && n.reference.x > low) continue;
        widths[right] += n.displacement.x;
        ++counts[right];
    }
    c.poisson = -(widths[1] / counts[1] - widths[0] / counts[0]) / (size.x * strain);
    return c;
}

}  // namespace

TEST_CASE("A uniform strain is in balance inside of grains that share their nodes", "[solids]")
{
    const flexpm::SpaceGradient h { { 1e-6, -4e-7, 2e-7 }, { 7e-7, -2e-6, 5e-7 },
        { -3e-7, 6e-7, 8e-7 } };
    for (const auto& cells : { brick(1, 1, 1), brick(2, 2, 3), packing(30, 1) }) {
        Specimen s = make_specimen(cells, specimens::granite(), specimens::granite_contact(),
            { false, true, flexpm::FacePointRule::corners_and_inner });
        double low = 0.0, high = 0.0;
        for (const Node& n : s.nodes)
            high = std::max(high, n.reference.z);
        const double edge = cells.cells() == 12 ? 2.0 * side : high;
        for (Node& n : s.nodes) {
            const Vector r = n.reference;
            n.displacement = { dot(h.x, r), dot(h.y, r), dot(h.z, r) };
        }
        find_forces(s);
        double inner = 0.0, outer = 0.0;
        int inside = 0;
        for (const Node& n : s.nodes) {
            const Vector r = n.reference;
            const double from =
                std::min({ r.x - low, r.y - low, r.z - low, edge - r.x, edge - r.y, high - r.z });
            const bool is_inner = from > 1e-6 * side;
            inside += is_inner;
            double& largest = is_inner ? inner : outer;
            largest = std::max(largest, norm(n.force));
        }
        CHECK(inside >= cells.cells());
        CHECK(inner < 1e-10 * outer);
    }
}

TEST_CASE("Cubic grains and their contacts are springs in series", "[solids]")
{
    const auto grain = specimens::granite();
    const double strain = 1e-6;
    for (const auto rule : { flexpm::FacePointRule::corners_and_inner, flexpm::FacePointRule::one,
             flexpm::FacePointRule::three, flexpm::FacePointRule::four,
             flexpm::FacePointRule::corners }) {
        const auto contact = specimens::strong_contact();
        Specimen s = make_specimen(brick(2, 1, 3), grain, contact, { false, false, rule });
        const Constants c = pull(s, { 2.0 * side, side, 3.0 * side }, strain, 1e-9);
        const double compliance = 1.0 / grain.young + 2.0 / (3.0 * side * contact.normal_stiffness);
        // St. Venant and Kirchhoff: the force has a second order in the strain
        CHECK(c.young * compliance == Approx(1.0).epsilon(3.0 * strain));
        // across, the grains alone strain, and the contact between them bears nothing
        CHECK(c.poisson == Approx(grain.poisson * c.young / grain.young).epsilon(1e-5));
    }
    Specimen joined = make_specimen(brick(2, 1, 3), grain, specimens::strong_contact(),
        { false, true, flexpm::FacePointRule::one });
    const Constants c = pull(joined, { 2.0 * side, side, 3.0 * side }, strain, 1e-9);
    CHECK(c.young == Approx(grain.young).epsilon(3.0 * strain));
    CHECK(c.poisson == Approx(grain.poisson).epsilon(1e-5));
}

TEST_CASE("Constants of a packing tend to those of its grains as contacts stiffen", "[solids]")
{
    const auto grain = specimens::granite();
    const auto cells = packing(25, 2);
    double edge = 0.0;
    for (const Vector& v : cells.vertices)
        edge = std::max(edge, v.z);
    const auto constants = [&](double factor) {
        Specimen s = make_specimen(cells, grain, specimens::strong_contact(1.8e14 * factor), {});
        return pull(s, { edge, edge, edge }, 1e-6, 2e-5);
    };
    const Constants soft = constants(1.0), stiff = constants(100.0);
    CHECK(soft.young < 0.98 * grain.young);
    CHECK(soft.young > 0.9 * grain.young);
    CHECK(stiff.young == Approx(grain.young).epsilon(2e-3));
    CHECK(stiff.poisson == Approx(grain.poisson).epsilon(2e-3));
}

TEST_CASE("Any rotation of a solid leaves no force", "[solids]")
{
    flexpm::Random random(5);
    const auto cells = packing(30, 4);
    for (const bool rigid : { false, true }) {
        const Specimen bonded =
            make_specimen(cells, specimens::granite(), specimens::granite_contact(),
                { rigid, false, flexpm::FacePointRule::corners_and_inner });
        for (int k = 0; k < 5; ++k) {
            Specimen s = bonded;
            move_all(s, { flexpm::rotation_by(6.0 * draw(random)), {}, {} });
            find_forces(s);
            // Places of 5 mm have a last digit of 1e-18 m. Over a tetrahedron's height, times E and
            // its sides, that is 1e-9 N; corners of rigid grains, which come from two centres, have
            // it times K_n A
            CHECK(resultant(s).largest < (rigid ? 2e-8 : 2e-9));
        }
        for (std::size_t g = 0; g < bonded.grains.size(); ++g) {
            Specimen s = bonded;
            s.contacts.clear();
            const Vector centre = s.nodes[s.grains[g].centre()].reference;
            const Motion turn { flexpm::rotation_by(6.0 * draw(random)), centre, {} };
            move(s, static_cast<int>(g), turn);
            find_forces(s);
            CHECK(resultant(s).largest < 1e-9);
        }
    }
}

TEST_CASE("The static solve has the constants of the plain step at rest", "[solids]")
{
    const auto grain = specimens::granite();
    const auto contact = specimens::strong_contact();
    const double edge = side * std::cbrt(0.6 * 25);
    const auto solid = flexpm::Solid::box(edge, edge, edge);
    const auto cells = packing(25, 2);
    const auto found = flexpm::solid_constants(cells, solid, elasticity());
    CHECK(found.residual < 1e-10);
    Specimen s = make_specimen(cells, grain, contact, {});
    const Constants relaxed = pull(s, { edge, edge, edge }, 1e-7, 1e-9);
    CHECK(relaxed.young == Approx(found.youngs_modulus).epsilon(1e-6));
    // there the mean over nodes, here over area
    CHECK(relaxed.poisson == Approx(found.poissons_ratio).epsilon(0.02));
}

TEST_CASE("The static solve has springs in series and tends to the grains' constants", "[solids]")
{
    const auto grain = specimens::granite();
    const auto contact = specimens::strong_contact();
    const auto solid = flexpm::Solid::box(2.0 * side, side, 3.0 * side);
    const auto found = flexpm::solid_constants(brick(2, 1, 3), solid, elasticity());
    const double compliance = 1.0 / grain.young + 2.0 / (3.0 * side * contact.normal_stiffness);
    CHECK(found.youngs_modulus * compliance == Approx(1.0).epsilon(1e-9));
    CHECK(found.poissons_ratio
        == Approx(grain.poisson * found.youngs_modulus / grain.young).epsilon(1e-9));

    flexpm::Solid core = flexpm::Solid::cylinder(4.0 * side, 5.0 * side, side);
    const auto cells =
        flexpm::polyhedra(flexpm_test::packed_spheres(core, 90, 1), core, { 0.1 * side, false });
    const auto stiff = flexpm::solid_constants(cells, core, elasticity(1.8e16));
    CHECK(stiff.youngs_modulus == Approx(grain.young).epsilon(2e-3));
    CHECK(stiff.poissons_ratio == Approx(grain.poisson).epsilon(2e-3));
    CHECK_THROWS_WITH(
        flexpm::solid_constants(cells, solid, elasticity()), Catch::Contains("wall of a facet"));
    CHECK_THROWS_WITH(flexpm::solid_constants(brick(2, 1, 2), solid, elasticity()),
        Catch::Contains("must be that of the cells"));
}
