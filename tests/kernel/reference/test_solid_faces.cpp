// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Two grains whose face is torn, sheared, bent, twisted and turned, by the plain step of
/// solids against closed forms.
#include "support/catch.hpp"

#include "reference/solid_samples.hpp"

#include <string>

using namespace solid_samples;

namespace {

const Making rigid { true, false, flexpm::FacePointRule::corners_and_inner };
const Making flexible {};

/// Two cubes, one upon the other: their face is a square across z.
Specimen pair(const Making& making, const flexpm::ContactMaterial& contact)
{
    return make_specimen(brick(1, 1, 2), specimens::granite(), contact, making);
}

constexpr double face_area = side * side;
const Vector face_centre { 0.5 * side, 0.5 * side, side };

double critical_slip(const flexpm::ContactMaterial& m)
{
    return 2.0 * m.shear_fracture_energy / m.cohesion;
}

}  // namespace

TEST_CASE("A face that is torn costs G_fn, sheared along any direction G_fs", "[solids]")
{
    const auto contact = specimens::granite_contact();
    const double u_c = 2.0 * contact.tensile_fracture_energy / contact.tensile_strength;
    // the trapezoid over the peak of shear, within one step
    const double close = 2e-4;
    for (const auto rule : { flexpm::FacePointRule::corners_and_inner, flexpm::FacePointRule::one,
             flexpm::FacePointRule::three, flexpm::FacePointRule::four }) {
        const Making making { true, false, rule };
        const int steps = 400;
        Specimen torn = pair(making, contact);
        for (int k = 0; k < steps; ++k) {
            move(torn, 1, { {}, {}, { 0.0, 0.0, 1.05 * u_c / steps } });
            find_forces(torn);
        }
        CHECK(damage_energy(torn)
            == Approx(contact.tensile_fracture_energy * face_area).epsilon(1e-6));
        CHECK(resultant(torn).largest == 0.0);
        for (const double angle : { 0.0, 0.4, 1.0, 2.5 }) {
            Specimen sheared = pair(making, contact);
            const double way = 1.05 * critical_slip(contact) / steps;
            for (int k = 0; k < steps; ++k) {
                move(sheared, 1, { {}, {}, { way * std::cos(angle), way * std::sin(angle), 0.0 } });
                find_forces(sheared);
            }
            CHECK(damage_energy(sheared)
                == Approx(contact.shear_fracture_energy * face_area).epsilon(close));
            CHECK(resultant(sheared).largest < 1e-6 * contact.cohesion * face_area);
        }
    }
}

TEST_CASE("Grains a thousand times as stiff part as rigid ones do", "[solids]")
{
    const auto contact = specimens::granite_contact();
    auto grain = specimens::granite();
    grain.young *= 1000.0;
    const double h = 0.5 * side;
    const double u_c = 2.0 * contact.tensile_fracture_energy / contact.tensile_strength;
    const double s_c = critical_slip(contact);
    const double tear = contact.tensile_fracture_energy * face_area;
    const double shear = contact.shear_fracture_energy * face_area;
    struct Way {
        Vector way, turn;  // of the upper end, in all
        double energy;
        int points;
    };
    std::vector<Way> ways { { { 0.0, 0.0, 1.2 * u_c }, {}, tear, 5 },
        { {}, { 1.05 * u_c / h, 0.0, 0.0 }, tear / 6.0, 2 },
        { {}, { 0.0, 0.0, 1.05 * s_c / (std::sqrt(2.0) * h) }, shear / 3.0, 4 } };
    for (const double angle : { 0.0, 0.7, 2.5 })
        ways.push_back(
            { 1.2 * s_c * Vector { std::cos(angle), std::sin(angle), 0.0 }, {}, shear, 5 });
    for (const Way& way : ways) {
        Specimen s = make_specimen(brick(1, 1, 2), grain, contact, flexible);
        scale_masses(s, 1.0, 0.7);
        const int steps = 4000;
        const auto turn = flexpm::rotation_by((1.0 / steps) * way.turn);
        const auto along = [&](const Node& n) {
            const Vector arm = n.place() - face_centre;
            return flexpm::turned_by(turn, arm) + (1.0 / steps) * way.way;
        };
        for (Node& n : s.nodes)
            n.held.fill(n.reference.z > 1.99 * side || n.reference.z < 0.01 * side);
        // all of the upper grain begins with its velocity, so that no wave runs
        for (int n : s.grains[1].nodes)
            s.nodes[n].velocity = along(s.nodes[n]);
        for (int k = 0; k < steps; ++k) {
            for (int n : s.grains[1].nodes)
                if (s.nodes[n].held[0]) s.nodes[n].velocity = along(s.nodes[n]);
            step(s, 1.0, 0.7);
        }
        CHECK(cracked_points(s) == way.points);
        CAPTURE(way.energy, friction_energy(s));
        CHECK(damage_energy(s) + friction_energy(s) == Approx(way.energy).epsilon(1e-3));
    }
}

TEST_CASE("A face that is bent or twisted loses the energy of the points that part", "[solids]")
{
    auto contact = specimens::granite_contact();
    const double u_c = 2.0 * contact.tensile_fracture_energy / contact.tensile_strength;
    const double h = 0.5 * side;
    const int steps = 1000;
    Specimen bent = pair(rigid, contact), twisted = pair(rigid, contact);
    const double bend = 1.05 * u_c / h,
                 twist = 1.05 * critical_slip(contact) / (std::sqrt(2.0) * h);
    double work = 0.0, before = 0.0;
    for (int k = 1; k <= steps; ++k) {
        move(bent, 1, { flexpm::rotation_by({ bend / steps, 0.0, 0.0 }), face_centre, {} });
        move(twisted, 1, { flexpm::rotation_by({ 0.0, 0.0, twist / steps }), face_centre, {} });
        find_forces(bent);
        find_forces(twisted);
        // two corners open, two close, the point inside stays: moments by the law, about the
        // middle of the face, which lies across half of the angle
        const double angle = bend * k / steps, opening = 2.0 * h * std::sin(0.5 * angle);
        const double u_e = contact.tensile_strength / contact.normal_stiffness;
        const double tension = opening < u_e
            ? contact.normal_stiffness * opening
            : contact.tensile_strength * std::max(1.0 - (opening - u_e) / (u_c - u_e), 0.0);
        const double moment = face_area / 6.0 * h * std::cos(0.5 * angle)
            * (tension + contact.normal_stiffness * opening);
        const Resultant r = resultant(bent, { bent.grains[1].centre() });
        const Vector found = r.moment + bent.grains[1].moment - cross(face_centre, r.force);
        CHECK(found.x == Approx(-moment).epsilon(1e-9));
        // all corners slip along the circle, the point inside stays
        const double slip = 2.0 * std::sqrt(2.0) * h * std::sin(0.5 * twist * k / steps);
        const double shear_stiffness = contact.shear_ratio * contact.normal_stiffness;
        const double s_e = contact.cohesion / shear_stiffness, s_c = critical_slip(contact);
        const double traction = slip < s_e
            ? shear_stiffness * slip
            : contact.cohesion * std::max((s_c - slip) / (s_c - s_e), 0.0);
        const double shear = twisted.grains[1].moment.z;
        const double arm = std::sqrt(2.0) * h * std::cos(0.5 * twist * k / steps);
        CHECK(shear == Approx(-face_area / 3.0 * arm * traction).epsilon(5e-3).margin(1e-9));
        work += 0.5 * (shear + before) * twist / steps;
        before = shear;
    }
    CHECK(damage_energy(bent)
        == Approx(contact.tensile_fracture_energy * face_area / 6.0).epsilon(1e-3));
    CHECK(cracked_points(bent) == 2);
    const double lost = contact.shear_fracture_energy * face_area / 3.0;
    CHECK(damage_energy(twisted) == Approx(lost).epsilon(1e-3));
    CHECK(-work == Approx(lost).epsilon(1e-3));
    CHECK(cracked_points(twisted) == 4);
}

TEST_CASE("A pair that has slid keeps force and slip as it turns, and has no moment", "[solids]")
{
    const auto contact = specimens::granite_contact();
    const double pressure = 40e6, slip = 1e-4;
    for (const Making& making : { rigid, flexible }) {
        for (const auto rule : { flexpm::FacePointRule::corners_and_inner,
                 flexpm::FacePointRule::one, flexpm::FacePointRule::three }) {
            Making own = making;
            own.rule = rule;
            for (int axis = 0; axis < 3; ++axis) {
                Specimen s = pair(own, contact);
                move(s, 1, { {}, {}, { 0.0, 0.0, -pressure / contact.normal_stiffness } });
                for (int k = 0; k < 200; ++k) {
                    move(s, 1, { {}, {}, { 0.6 * slip / 200, 0.8 * slip / 200, 0.0 } });
                    find_forces(s);
                }
                const Vector force = resultant(s, s.grains[1].nodes).force;
                const Vector rigid_force = s.nodes[s.grains[1].centre()].force;
                const Vector before = own.rigid ? rigid_force : force;
                CHECK(before.z == Approx(pressure * face_area));
                CHECK(std::hypot(before.x, before.y)
                    == Approx(contact.friction * pressure * face_area).epsilon(1e-6));
                const auto places = s.contacts[0].points;
                CHECK(norm(places[0].at.slip) == Approx(slip));
                const int turns = 50;
                const Vector angle { axis == 0 ? 0.1 : 0.0, axis == 1 ? 0.1 : 0.0,
                    axis == 2 ? 0.1 : 0.0 };
                for (int k = 0; k < turns; ++k) {
                    move_all(s, { flexpm::rotation_by((1.0 / turns) * angle), {}, {} });
                    find_forces(s);
                }
                const Vector after = own.rigid ? s.nodes[s.grains[1].centre()].force
                                               : resultant(s, s.grains[1].nodes).force;
                const Vector expected = flexpm::turned(flexpm::rotation_by(angle), before);
                CHECK(norm(after - expected) < 1e-6 * norm(before));
                for (std::size_t p = 0; p < places.size(); ++p) {
                    const auto& now = s.contacts[0].points[p];
                    CHECK(norm(now.at.slip - places[p].at.slip) < 1e-6 * slip);
                    CHECK(now.state.friction_energy
                        == Approx(places[p].state.friction_energy).epsilon(1e-6));
                }
                const Resultant r = resultant(s);
                CHECK(norm(r.force) < 1e-9 * norm(before));
                CHECK(norm(r.moment) < 1e-9 * norm(before) * side);
            }
        }
    }
}

TEST_CASE("Forces of a contact are the derivatives of its energy wherever it has gone", "[solids]")
{
    flexpm::Random random(7);
    Specimen s =
        make_specimen(packing(12, 3), specimens::granite(), specimens::strong_contact(), flexible);
    s.elastic = {};
    for (Contact& c : s.contacts) {
        // no strength is ever met: the energy has a derivative everywhere
        c.law.cohesion = c.law.tensile_strength = 1e30;
        c.law.elastic_opening = c.law.critical_opening = c.law.critical_slip = 1e9;
    }
    // large ways, so that all terms of the frame count
    for (Node& n : s.nodes)
        n.displacement = (0.1 * side) * draw(random);
    const double h = 1e-4 * side;
    for (std::size_t i = 0; i < s.contacts.size(); ++i) {
        Specimen one = s;
        one.contacts = { s.contacts[i] };
        const auto& corners = s.contacts[i].corners[i % 2];
        const int node = corners[i % corners.size()];
        const auto energy = [&](Vector way) {
            one.nodes[node].displacement = s.nodes[node].displacement + way;
            find_forces(one);
            double sum = 0.0;
            for (const ContactPoint& p : one.contacts[0].points)
                sum += p.area * flexpm::law::elastic_energy(one.contacts[0].law, p.at, p.state);
            return sum;
        };
        const Vector slope { energy({ h, 0, 0 }) - energy({ -h, 0, 0 }),
            energy({ 0, h, 0 }) - energy({ 0, -h, 0 }),
            energy({ 0, 0, h }) - energy({ 0, 0, -h }) };
        energy({});
        const Vector force = one.nodes[node].force;
        CHECK(norm(force + (0.5 / h) * slope) < 1e-6 * resultant(one, corners).largest);
    }
}
