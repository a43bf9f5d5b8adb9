// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Ends of solids: moduli, works against energies, plates of rigid grains, changes of the
/// velocity.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/laboratory/steady_motion.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/statics/solid_constants.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0;

Packing column(int nx, int ny, int nz)
{
    const double d = solid_samples::side;
    return { Solid::box(nx * d, ny * d, nz * d), solid_samples::brick(nx, ny, nz) };
}

/// Held at its ends, with scaled masses.
SolidState held(const Packing& p, bool rigid, bool pulled)
{
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
    hold_ends(s, { pulled, false });
    scale_masses(s, damping);
    return s;
}

/// Let the surface and all centres go ways of their places at the reference.
template <class Way> void move(SolidState& s, Way way)
{
    const auto put = [&](int node) {
        set_space_vector(s.grains.displacement, node, way(space_vector(s.grains.reference, node)));
    };
    for (const auto& nodes : s.surface.nodes)
        std::for_each(nodes.begin(), nodes.end(), put);
    for (int g = 0; g < s.grains.count; ++g)
        put(s.grains.centre(g));
}

double balance_of(const Energies& e)
{
    return e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag - e.boundary_work
        - e.initial;
}

}  // namespace

TEST_CASE("The linear field of deformable grains is that of their elastic constants", "[solids]")
{
    const Packing p = box(60, 2);
    const auto grain = specimens::granite();
    const auto contact = specimens::granite_contact();
    const SolidExtension expected = solid_extension(p.cells, p.solid,
        SolidElasticity {
            grain.young, grain.poisson, contact.normal_stiffness, contact.shear_ratio });
    const SolidField found = elastic_field(held(p, false, false));
    REQUIRE(found.ways.size() == expected.field.size());
    CHECK(found.turns.empty());
    // nothing holds it laterally
    double worst = 0.0;
    for (std::size_t n = 0; n < found.ways.size(); ++n)
        worst = std::max(worst, std::fabs(found.ways[n].z - expected.field[n].z));
    CHECK(worst < 1e-7 * p.solid.high.z);
}

TEST_CASE("A solid keeps the modulus of its linear field, and its Poisson's ratio",
    "[solids][many_steps]")
{
    for (const bool rigid : { false, true }) {
        for (const Sense sense : { Sense::compression, Sense::tension }) {
            const double sign = sense == Sense::tension ? 1.0 : -1.0;
            const Packing p = box(120, 2);
            SolidState s = held(p, rigid, sense == Sense::tension);
            const SolidField field = elastic_field(s);
            const SolidFrame frame = solid_frame(s, sense);
            CHECK(frame.area == Approx(p.solid.volume / p.solid.high.z).epsilon(1e-9));
            CHECK(frame.height == Approx(p.solid.high.z).epsilon(1e-9));
            const double strain = 4e-6, rate = 4e-9;  // far from softening
            start_ends(s, field, sign * strain, sign * rate * frame.height, true, dt);
            const AxialObservation start = observe(s, frame);
            CHECK(start.axial_stress > 0.0);
            CHECK(start.end_mismatch < 1e-3);
            for (int k = 0; k < 200; ++k)
                step(s, { dt, damping, 1, true });
            const AxialObservation now = observe(s, frame);
            CAPTURE(rigid, sign, start.axial_stress, now.axial_stress, now.axial_strain,
                now.lateral_strain, now.unbalanced_ratio);
            CHECK(now.step == 200);
            CHECK(now.axial_stress / now.axial_strain
                == Approx(start.axial_stress / start.axial_strain).epsilon(2e-3));
            CHECK(now.lateral_strain / now.axial_strain
                == Approx(start.lateral_strain / start.axial_strain).epsilon(1e-2));
            if (!rigid) {
                const auto grain = specimens::granite();
                const auto contact = specimens::granite_contact();
                const SolidConstants e = solid_constants(p.cells, p.solid,
                    SolidElasticity { grain.young, grain.poisson, contact.normal_stiffness,
                        contact.shear_ratio });
                CHECK(
                    now.axial_stress / now.axial_strain == Approx(e.youngs_modulus).epsilon(2e-3));
                CHECK(now.lateral_strain / now.axial_strain
                    == Approx(e.poissons_ratio).epsilon(1e-2));
            }
            CHECK(now.end_mismatch < 0.01);
            CHECK(now.cracks.tensile == 0);
            CHECK(std::fabs(balance_of(now.energies)) < 1e-4 * now.energies.elastic);
            CHECK(now.energies.boundary_work > 0.0);
            CHECK(find_bad_value(now) == nullptr);
            CHECK(find_bad_number(s).empty());
        }
    }
}

TEST_CASE("Constants between the ends are those of the static solve, and of springs", "[solids]")
{
    const Packing p = box(60, 2);
    const auto grain = specimens::granite();
    const auto contact = specimens::granite_contact();
    const SolidConstants expected = solid_constants(p.cells, p.solid,
        SolidElasticity {
            grain.young, grain.poisson, contact.normal_stiffness, contact.shear_ratio });
    const ElasticConstants found = constants_between_ends(make_solid(p.cells, p.solid, granite()));
    CHECK(found.youngs_modulus == Approx(expected.youngs_modulus).epsilon(1e-5));
    CHECK(found.poissons_ratio == Approx(expected.poissons_ratio).epsilon(1e-2));
    // those of the static solve are of the whole height
    SolidState pulled = held(p, false, true);
    start_ends(pulled, elastic_field(pulled), 1e-6, 0.0, true, dt);
    const double across = mean_strain(pulled, &Vector::x) + mean_strain(pulled, &Vector::y);
    CHECK(-0.5 * across == Approx(1e-6 * expected.poissons_ratio).epsilon(1e-4));

    // faces of rigid cubes are springs in rows side by side
    const Packing cubes = column(2, 2, 6);
    const ElasticConstants rigid = constants_between_ends(
        make_solid(cubes.cells, cubes.solid, granite(FacePointRule::corners_and_inner, true)));
    CHECK(rigid.youngs_modulus
        == Approx(contact.normal_stiffness * solid_samples::side).epsilon(1e-5));
    CHECK(std::fabs(rigid.poissons_ratio) < 1e-6);

    CHECK_THROWS_WITH(constants_between_ends(held(p, true, true)), Catch::Contains("held already"));
}

TEST_CASE("The lateral strain is that at the waist, wherever the specimen goes", "[solids]")
{
    const double along_x = 3e-4, along_y = 1e-4, expected = 0.5 * (along_x + along_y);
    for (const bool rigid : { false, true }) {
        const Packing p = box(rigid ? 120 : 1000, 2);
        // centres of both sides do not lie equally high
        const double tilt = rigid ? 0.0 : 0.2;
        const auto even = [=](Vector r) {
            return Vector { along_x * r.x - tilt * r.z + 1e-3, along_y * r.y + tilt * r.x, 0.0 };
        };
        SolidState s =
            make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
        move(s, even);
        CHECK(lateral_strain(s, Sense::compression) == Approx(expected).epsilon(1e-9));
        CHECK(lateral_strain(s, Sense::tension) == Approx(-expected).epsilon(1e-9));
        const double height = p.solid.high.z;
        move(s, [&](Vector r) {
            const bool end = std::fabs(r.z / height - 0.5) > 0.4;
            return end ? Vector { 0.1 * r.x, -0.3 * r.y, 0.0 } : even(r);
        });
        CHECK(lateral_strain(s, Sense::compression) == Approx(expected).epsilon(1e-9));
        if (rigid) continue;
        // a strain that grows with the square of the distance from the middle pins the third, up to
        // what straight triangles add
        move(s, [&](Vector r) {
            const double up = r.z / height - 0.5;
            return Vector { up * up * r.x, up * up * r.y, 0.0 };
        });
        const double found = lateral_strain(s, Sense::compression);
        CHECK(found > 1.0 / 108.0);
        CHECK(found < 1.15 / 108.0);
    }
}

TEST_CASE("A layer of one rigid grain has no strain across, a column none at all", "[solids]")
{
    const double side = solid_samples::side;
    const auto strain = [&](int wide, int deep, double shift) {
        // in a layer grains do not lie equally deep
        const Solid solid = Solid::box(wide * side, deep * side, 6.0 * side);
        std::vector<Sphere> spheres;
        for (int k = 0; k < 6; ++k) {
            for (int j = 0; j < deep; ++j) {
                for (int i = 0; i < wide; ++i) {
                    const double off = shift * side * ((i + k) % 2 ? 1.0 : -1.0);
                    spheres.push_back(
                        { { (i + 0.5) * side + off, (j + 0.5) * side + off, (k + 0.5) * side },
                            0.5 * side });
                }
            }
        }
        SolidState s = make_solid(
            polyhedra(spheres, solid, {}), solid, granite(FacePointRule::corners_and_inner, true));
        move(s, [](Vector r) { return Vector { 3e-4 * r.x, 1e-4 * r.y + 1e-6 * r.z, 0.0 }; });
        return lateral_strain(s, Sense::compression);
    };
    for (const double shift : { 0.0, 0.02, 0.1 }) {
        CAPTURE(shift);
        CHECK(strain(4, 1, shift) == Approx(3e-4).epsilon(1e-6));
        CHECK(strain(1, 4, shift) == Approx(1e-4).epsilon(2e-2));
        CHECK(strain(2, 2, shift) == Approx(2e-4).epsilon(2e-2));
        CHECK(std::isnan(strain(1, 1, shift)));
    }
}

TEST_CASE("A column of rigid grains between plates is springs in a row", "[solids]")
{
    const int grains = 6;
    const double stiffness = specimens::granite_contact().normal_stiffness;
    const Packing p = column(1, 1, grains);
    for (const bool pulled : { false, true }) {
        SolidState s = held(p, true, pulled);
        const SolidField field = elastic_field(s);
        // each contact and each plate takes an equal part of the way
        const double part = p.solid.high.z / (grains + 1);
        for (int g = 0; g < grains; ++g) {
            const double z = space_vector(s.grains.reference, s.grains.centre(g)).z;
            const int below = static_cast<int>(std::lround(z / solid_samples::side - 0.5));
            CHECK(field.ways[g].z == Approx((below + 1) * part).epsilon(1e-8));
            CHECK(norm(field.turns[g]) < 1e-9);
        }
        const double strain = pulled ? 1e-6 : -1e-6;
        start_ends(s, field, strain, 0.0, true, dt);
        const Sense sense = pulled ? Sense::tension : Sense::compression;
        const SolidFrame frame = solid_frame(s, sense);
        const double expected = stiffness * std::fabs(strain) * part;
        CHECK(observe(s, frame).axial_stress == Approx(expected).epsilon(1e-6));
        CHECK(energies(s).elastic
            == Approx(0.5 * expected * frame.area * std::fabs(strain) * p.solid.high.z)
                   .epsilon(1e-6));
        // without the plates' part
        CHECK(observe(s, frame).axial_strain
            == Approx(expected / (stiffness * solid_samples::side)).epsilon(1e-6));
        for (int k = 0; k < 50; ++k)
            step(s, { dt, damping, 1, true });
        CHECK(observe(s, frame).axial_stress == Approx(expected).epsilon(1e-6));
    }
}

TEST_CASE("The strain of the elastic limit is that at which the first point softens", "[solids]")
{
    for (const bool rigid : { false, true }) {
        for (const double sense : { -1.0, 1.0 }) {
            SolidState s = held(box(60, 2), rigid, sense > 0.0);
            const SolidField field = elastic_field(s);
            const double limit = elastic_strain(s, field, sense);
            CAPTURE(rigid, sense, limit);
            REQUIRE(limit > 0.0);
            SolidState below = s;
            start_ends(below, field, 0.98 * sense * limit, 0.0, true, dt);
            CHECK(energies(below).damage == 0.0);
            start_ends(s, field, 1.05 * sense * limit, 0.0, true, dt);
            CHECK(energies(s).damage > 0.0);
        }
    }
}

TEST_CASE("A plate only presses unless it is bonded, and lies on an end once", "[solids]")
{
    const Packing p = column(1, 1, 2);
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, true));
    add_end_plate(s, SolidSide::top, false);
    CHECK_THROWS_WITH(add_end_plate(s, SolidSide::top, false), Catch::Contains("it has one"));
    CHECK_THROWS_WITH(add_end_plate(s, SolidSide::left, false), Catch::Contains("side = 3"));
    add_end_plate(s, SolidSide::bottom, false);
    scale_masses(s, damping);
    CHECK_THROWS_WITH(hold_ends(s, { false, false }), Catch::Contains("held already"));
    go_on(s, drive_of_top(s), 1e-9, dt);
    for (int k = 0; k < 10; ++k)
        step(s, { dt, damping, 1, true });
    CHECK(end_forces(s).top == 0.0);
    CHECK(s.plates.front().points.front().opening == Approx(1e-8));
    CHECK(energies(s).boundary_work == 0.0);

    SolidState soft = make_solid(p.cells, p.solid, granite());
    CHECK_THROWS_WITH(elastic_field(soft), Catch::Contains("held nodes = 0"));
    CHECK_THROWS_WITH(
        start_ends(soft, {}, 0.0, 1.0, false, dt), Catch::Contains("call hold_ends()"));
}

TEST_CASE("Rough plates hold grains across as far as friction bears it", "[solids][many_steps]")
{
    const Packing p = box(60, 2);
    for (const bool rigid : { false, true }) {
        double stress[3], lateral[3], waist[3];
        const double friction[3] = { 0.0, 0.005, 100.0 };
        for (int k = 0; k < 3; ++k) {
            SolidState s =
                make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
            hold_ends(s, { false, true });
            roughen_plates(s, friction[k]);
            scale_masses(s, damping);
            const SolidFrame frame = solid_frame(s, Sense::compression);
            start_ends(s, elastic_field(s), 0.0, -8e-9 * frame.height, true, dt);
            for (int n = 0; n < 1000; ++n)
                step(s, { dt, damping, 1, true });
            const AxialObservation now = observe(s, frame);
            // strains of rigid grains lie between their centres, away from the plates
            stress[k] = now.axial_stress;
            lateral[k] = mean_strain(s, &Vector::x) + mean_strain(s, &Vector::y);
            waist[k] = now.lateral_strain;
            CHECK(now.end_mismatch < 0.01);
            const Energies& e = now.energies;
            CHECK(std::fabs(e.kinetic + e.elastic + e.friction + e.damping + e.drag
                      - e.boundary_work - e.initial)
                < 2e-4 * e.elastic);
            double most = 0.0, sum = 0.0;
            for (const Plate& plate : s.plates) {
                for (int i = 0; i < plate_points(plate); ++i) {
                    if (friction[k] == 0.0) continue;
                    const double along = norm(point_shear(plate, i));
                    const double pushed = point_stiffness(plate, i) * -plate.points[i].opening;
                    most = std::max(most, along / (friction[k] * std::max(pushed, 1e-300)));
                    CHECK(point_shear(plate, i).z == 0.0);
                    CHECK(plate.points[i].friction_energy >= 0.0);
                    sum += plate.points[i].friction_energy;
                }
            }
            CHECK(most <= 1.0 + 1e-12);
            CHECK(e.friction == Approx(sum));
            if (friction[k] == 0.005) {
                CHECK(most > 0.99);
                CHECK(sum > 0.0);
            } else {
                CHECK(e.friction < 1e-6 * e.elastic);
            }
        }
        CHECK(stress[0] < stress[1]);
        CHECK(stress[1] < stress[2]);
        CHECK(lateral[0] > lateral[1]);
        CHECK(lateral[1] > lateral[2]);
        // the waist feels less of what holds the ends
        CHECK(
            std::fabs(waist[2] / waist[0] - 1.0) < 0.5 * std::fabs(lateral[2] / lateral[0] - 1.0));
    }
    SolidState pulled = held(p, true, true);
    CHECK_THROWS_WITH(roughen_plates(pulled, 0.2), Catch::Contains("must be 2 that press"));
    SolidState bare = make_solid(p.cells, p.solid, granite());
    CHECK_THROWS_WITH(roughen_plates(bare, 0.2), Catch::Contains("plates with friction = 0"));
}

TEST_CASE("A change of the velocity raises no wave and is work of the ends", "[solids]")
{
    for (const bool rigid : { false, true }) {
        SolidState s = held(box(60, 2), rigid, false);
        const SolidFrame frame = solid_frame(s, Sense::compression);
        start_ends(s, elastic_field(s), -2e-5, -2e-7 * frame.height, true, dt);
        const SolidDrive top = drive_of_top(s);
        double largest = 0.0;
        for (int k = 0; k < 100; ++k) {
            if (k % 20 == 10) go_on(s, top, (k % 40 == 10 ? 0.1 : 10.0) * velocity_of(s, top), dt);
            step(s, { dt, damping, 1, true });
            const AxialObservation now = observe(s, frame);
            largest = std::max(largest, now.end_mismatch);
            CHECK(std::fabs(balance_of(now.energies)) < 2e-3 * now.energies.elastic);
        }
        CAPTURE(rigid, largest);
        CHECK(largest < 0.02);
        CHECK(velocity_of(s, top) == Approx(-0.1 * 2e-7 * frame.height));
    }
}

TEST_CASE("Steady motion is what damping leaves alone", "[solids]")
{
    // a solid that falls as a whole: nothing holds it up, and its motion is not damped
    for (const bool rigid : { false, true }) {
        const Packing p = packing(20, 3);
        SolidState s =
            make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
        scale_masses(s, damping);
        const Vector velocity { 1e-9, -2e-9, 3e-9 };
        for (int g = 0; g < s.grains.count; ++g)
            for (int n = 0; n < s.grains.nodes_of(g); ++n)
                set_space_vector(s.grains.velocity, s.grains.node(g, n), velocity);
        for (int look = 0; look < 3; ++look) {
            follow_steady_motion(s, dt, 1e-6);
            for (int k = 0; k < 10; ++k)
                step(s, { dt, 0.0, 1, true });
        }
        const int node = s.grains.centre(0);
        CHECK(norm(space_vector(s.undamped().velocity, node) - velocity) < 1e-6 * norm(velocity));
        CHECK(damping_power(s, damping) < 1e-9 * energies(s).kinetic);
        follow_steady_motion(s, dt, 0.1 * norm(velocity));
        CHECK(norm(space_vector(s.undamped().velocity, node)) == Approx(0.1 * norm(velocity)));
        end_steady_motion(s);
        CHECK(norm(space_vector(s.undamped().velocity, node)) == 0.0);
    }
}

TEST_CASE("Scales of a solid are those of the plane's formulas", "[solids]")
{
    const Packing p = box(60, 2);
    const SolidState s = held(p, false, false);
    const TestScales scales = solid_scales(s, Sense::compression, dt);
    const auto grain = specimens::granite();
    const auto contact = specimens::granite_contact();
    double diameter = 0.0;
    for (double r : s.grains.radius)
        diameter += 2.0 * r / s.grains.count;
    CHECK(scales.modulus
        == Approx(
            series_modulus(grain.young, contact_modulus(contact.normal_stiffness, diameter))));
    CHECK(scales.height == Approx(p.solid.high.z));
    CHECK(scales.width * scales.width == Approx(p.solid.volume / p.solid.high.z));
    CHECK(scales.strength
        == Approx(reference_strength(
            Sense::compression, { contact.tensile_strength, contact.cohesion, contact.friction })));
    double mass = 0.0;
    for (double m : s.grains.inverse_mass)
        if (m > 0.0) mass += 1.0 / m;
    CHECK(scales.crossing_steps
        == Approx(
            std::sqrt(mass * scales.height * p.solid.high.z / (scales.modulus * p.solid.volume))));
}

TEST_CASE("Means of equal values of a solid's grains are these values", "[solids]")
{
    SolidState s = held(column(3, 3, 11), true, true);
    std::fill(s.grains.radius.begin(), s.grains.radius.end(), 0.5 * solid_samples::side);
    const ContactMaterial contact = specimens::granite_contact();
    double plain = 0.0, plain_diameter = 0.0;
    for (int g = 0; g < s.grains.count; ++g) {
        plain += contact.friction;
        plain_diameter += 2.0 * s.grains.radius[g];
    }
    // the plain sums miss them
    REQUIRE(plain / s.grains.count != contact.friction);
    REQUIRE(plain_diameter / s.grains.count != solid_samples::side);
    const TestScales scales = solid_scales(s, Sense::compression, dt);
    CHECK(scales.strength
        == reference_strength(
            Sense::compression, { contact.tensile_strength, contact.cohesion, contact.friction }));
    CHECK(scales.modulus == contact_modulus(contact.normal_stiffness, solid_samples::side));
    for (const Plate& plate : s.plates) {
        CHECK(plate.stiffness == contact.normal_stiffness);
        CHECK(plate.shear_stiffness == contact.shear_ratio * contact.normal_stiffness);
    }
    const SolidExtent extent = extent_of(s);
    const int node = side_nodes(s, SolidSide::top).front();
    CHECK(extent.height == s.grains.reference[s.grains.component(node, 2)]);
}
