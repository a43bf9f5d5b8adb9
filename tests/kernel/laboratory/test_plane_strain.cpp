// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The plane within space: one layer of prisms between frictionless planes is the plane's
/// assembly in plane strain, whose three points of an edge are the default ones of a rectangle.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/laboratory/steady_motion.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/loose_grains.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double width = 0.02, height = 0.04;

/// Cells of the plane that keep all their edges.
specimens::Specimen plane_cells()
{
    specimens::Specimen s = specimens::random_grains(width, height, 3e-3, 11);
    s.cells = tessellate(s.discs,
        Outline::polygon({ { 0.0, 0.0 }, { width, 0.0 }, { width, height }, { 0.0, height } }),
        { 0.0, true });
    return s;
}

/// The same cells as prisms, the plane's y along z.
SolidState prisms(const specimens::Specimen& plane, double depth,
    const ContactMaterial& contact = specimens::strong_contact(), bool rigid = false)
{
    std::vector<Sphere> spheres;
    for (int disc : plane.cells.disc_of_cell) {
        const auto& [centre, radius] = plane.discs[disc];
        spheres.push_back({ { centre.x, 0.5 * depth, centre.y }, radius });
    }
    const Solid solid = Solid::box(width, depth, height);
    SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
    input.contacts = { contact };
    return make_solid(polyhedra(spheres, solid, {}), solid, input);
}

/// Constants of the elastic solution, over the whole height as those of the plane.
ElasticConstants constants(SolidState s)
{
    hold_ends(s, { false, false });
    scale_masses(s, 0.7);
    start_ends(s, elastic_field(s), 1e-7, 1e-12, true, 1.0);
    const AxialObservation now = observe(s, solid_frame(s, Sense::tension));
    return { now.axial_stress / now.axial_strain, -mean_strain(s, &Vector::x) / now.axial_strain };
}

/// What a layer of rigid prisms is in the plane: normals of edges, three points of an edge.
Assembly rigid_plane(const specimens::Specimen& cells, double depth, const ContactMaterial& contact)
{
    AssemblyOptions o = specimens::options(contact, specimens::granite(Plane::strain));
    o.rigid = true;
    o.thickness = depth;
    o.edge_normal.assign(cells.cells.shared_edges.size(), 1);
    return specimens::assemble(cells, o);
}

constexpr double depth = 3e-3, rough = 0.3, pressed = 20e6, sheared = 2.0;
constexpr double plate_mass = 5e-3, damping = 0.2;

/// Rough plates below and above; the lower one goes along x, a pressure moves the upper one.
template <class State> void load(State& s)
{
    s.plates[0].velocity = { sheared, 0.0, 0.0 };
    s.plates[1].mass = plate_mass;
    press(s, 1, pressed);
}

Assembly loaded_plane(const specimens::Specimen& cells, const ContactMaterial& contact)
{
    Assembly a = rigid_plane(cells, depth, contact);
    for (const int side : { bottom_side, top_side })
        add_side_plates(a, side, 1, { 0.0, rough });
    set_real_masses(a, damping);
    load(a);
    return a;
}

/// Plates below and above a box; a load may move the upper one.
void lay_plates(SolidState& s, double across, double deep, double high, double friction)
{
    const double far = 1e-3;
    for (const double up : { 1.0, -1.0 }) {
        const double at = up > 0.0 ? 0.0 : high;
        SolidPatch patch { { 0.0, 0.0, up }, { -far, -far, at - far },
            { across + far, deep + far, at + far } };
        patch.friction = friction;
        add_patch_plate(s, patch);
    }
    free_plate(s, 1);
}

SolidState loaded_layer(const specimens::Specimen& cells, const ContactMaterial& contact)
{
    SolidState s = prisms(cells, depth, contact, true);
    lay_plates(s, width, depth, height, rough);
    set_real_masses(s);
    load(s);
    return s;
}

constexpr int row = 600;  ///< step at which the ends rub, points soften and waves run

/// The loaded layer and its plane after as many steps of the same length.
struct Pair {
    Assembly plane;
    SolidState layer;
    StepOptions options;
};

Pair loaded_pair(int steps)
{
    const specimens::Specimen cells = plane_cells();
    const ContactMaterial contact = specimens::granite_contact();
    Pair p { loaded_plane(cells, contact), loaded_layer(cells, contact), {} };
    const double dt = std::min(stable_step(p.plane, damping), stable_step(p.layer, damping));
    p.options = { 0.3 * dt, damping, 1, true };
    for (int k = 0; k < steps; ++k) {
        step(p.plane, p.options);
        step(p.layer, p.options);
    }
    return p;
}

Point centre_of(const Assembly& a, int grain)
{
    return a.grains.reference_at(a.grains.centre(grain));
}

Point centre_of(const SolidState& s, int grain)
{
    const Vector r = space_vector(s.grains.reference, s.grains.centre(grain));
    return { r.x, r.z };
}

/// Leave no bond to the contacts that cross a height, and lift the grains and the plate above.
void cut(Assembly& a, double at, double way)
{
    const auto above = [&](int grain) { return centre_of(a, grain).y > at; };
    for (int c = 0; c < a.contacts.count; ++c) {
        if (above(a.contacts.pairs[c][0]) == above(a.contacts.pairs[c][1])) continue;
        for (int p = 0; p < a.contacts.points_of(c); ++p) {
            take_strength(a.contacts, c, p);
            a.contacts.state(c, p, &PointState::opening) = way;  // it grows by steps
        }
    }
    a.plates[1].displacement.y += way;
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g) && above(g); ++n)
            a.grains.displacement[a.grains.component(a.grains.node(g, n), 1)] += way;
    }
}

void cut(SolidState& s, double at, double way)
{
    const auto above = [&](int grain) { return centre_of(s, grain).y > at; };
    for (int c = 0; c < s.contacts.count; ++c) {
        if (above(s.contacts.pairs[c][0]) == above(s.contacts.pairs[c][1])) continue;
        for (int p = 0; p < s.contacts.points_of(c); ++p) {
            s.contacts.set_state(c, p, FaceRow::shear_damage, 1.0);
            s.contacts.set_crack(c, p, { 0, tensile_crack, {}, 0.0 });
        }
    }
    s.plates[1].displacement.z += way;
    for_each_node(s, [&](int g, int n) {
        if (above(g)) s.grains.displacement[s.grains.component(s.grains.node(g, n), 2)] += way;
    });
}

/// Grains of the layer in the order of those of the plane.
std::vector<int> same_grains(const Assembly& plane, const SolidState& layer)
{
    std::vector<int> found(plane.grains.count, -1);
    for (int g = 0; g < plane.grains.count; ++g)
        for (int k = 0; k < layer.grains.count; ++k)
            if (norm(centre_of(plane, g) - centre_of(layer, k)) < 1e-9) found[g] = k;
    return found;
}

}  // namespace

TEST_CASE("Rigid prisms dissipate, damp and come to balance as their plane does", "[solids]")
{
    const Pair p = loaded_pair(row);
    REQUIRE(p.layer.contacts.count == p.plane.contacts.count);
    // what 1 % is of must be there: friction of the ends alone, and plates that are out of balance
    const Dissipation plane = dissipation(p.plane), layer = dissipation(p.layer);
    REQUIRE(plane.friction - contact_loss(p.plane.contacts).friction > 0.9 * plane.friction);
    Assembly still = p.plane;
    still.plates[1].loaded = false;
    REQUIRE(damping_power(still, damping) < 0.95 * damping_power(p.plane, damping));
    CHECK(layer.friction == Approx(plane.friction).epsilon(0.01));
    CHECK(layer.damage == Approx(plane.damage).epsilon(0.01));
    CHECK(layer.boundary_work == Approx(plane.boundary_work).epsilon(0.01));
    CHECK(damping_power(p.layer, damping) == Approx(damping_power(p.plane, damping)).epsilon(0.01));
    CHECK(unbalanced_ratio(p.layer) == Approx(unbalanced_ratio(p.plane)).epsilon(0.01));
    const Energies of_plane = energies(p.plane), of_layer = energies(p.layer);
    CHECK(of_layer.friction == layer.friction);
    CHECK(of_layer.kinetic == Approx(of_plane.kinetic).epsilon(0.01));
    CHECK(of_layer.damping == Approx(of_plane.damping).epsilon(0.01));
}

TEST_CASE("Grains that hang on a pressed plate alone are loose in a layer as in its plane, D57")
{
    Pair p = loaded_pair(20);
    cut(p.plane, 0.7 * height, 1e-3);
    cut(p.layer, 0.7 * height, 1e-3);
    find_loose(p.plane);
    find_loose(p.layer);
    const auto& loose = p.plane.grains.loose;
    REQUIRE(std::count(loose.begin(), loose.end(), 1) > 10);
    REQUIRE(std::count(loose.begin(), loose.end(), 0) > 10);
    const double fastest = 1e3;  // no bound
    for (int look = 0; look < 2; ++look) {
        follow_steady_motion(p.plane, p.options.dt, fastest);
        follow_steady_motion(p.layer, p.options.dt, fastest);
        for (int k = 0; k < 5; ++k) {
            step(p.plane, p.options);
            step(p.layer, p.options);
        }
    }
    const std::vector<int> same = same_grains(p.plane, p.layer);
    for (int g = 0; g < p.plane.grains.count; ++g) {
        CAPTURE(g);
        REQUIRE(same[g] >= 0);
        CHECK(p.layer.grains.loose[same[g]] == loose[g]);
        const Point mean = vector_at(p.plane.undamped().velocity, p.plane.grains.centre(g));
        const Vector of_layer =
            space_vector(p.layer.undamped().velocity, p.layer.grains.centre(same[g]));
        CHECK((norm(mean) == 0.0) == (loose[g] == 1));
        CHECK((norm(of_layer) == 0.0) == (loose[g] == 1));
        CHECK((norm(spin_in(p.layer.undamped(), same[g])) == 0.0) == (loose[g] == 1));
    }
}

TEST_CASE("A grain whose spin is given holds what hangs on it in a layer as in its plane, D57")
{
    Pair p = loaded_pair(20);
    cut(p.plane, 0.7 * height, 1e-3);
    cut(p.layer, 0.7 * height, 1e-3);
    find_loose(p.plane);
    const auto& loose = p.plane.grains.loose;
    const int grain = static_cast<int>(std::find(loose.begin(), loose.end(), 1) - loose.begin());
    REQUIRE(grain < p.plane.grains.count);
    p.plane.grains.spin_prescribed[p.plane.grains.slot[grain]] = 1;
    const std::vector<int> same = same_grains(p.plane, p.layer);
    set_spin(p.layer, same[grain], {}, true);
    find_loose(p.plane);
    find_loose(p.layer);
    CHECK(loose[grain] == 0);
    for (int g = 0; g < p.plane.grains.count; ++g)
        CHECK(p.layer.grains.loose[same[g]] == loose[g]);
}

TEST_CASE("A soft strip before a plate is in series along and across it, as in the plane")
{
    const specimens::Specimen cells = plane_cells();
    const ContactMaterial contact = specimens::granite_contact();
    const double strip = 0.3 * contact.normal_stiffness;
    Assembly plane = rigid_plane(cells, depth, contact);
    add_side_plates(plane, bottom_side, 1, { 0.0, rough, false, strip });
    SolidState layer = prisms(cells, depth, contact, true);
    SolidPatch patch { { 0.0, 0.0, 1.0 }, { -1e-3, -1e-3, -1e-3 },
        { width + 1e-3, depth + 1e-3, 1e-3 } };
    patch.friction = rough;
    patch.strip = strip;
    add_patch_plate(layer, patch);
    const double softer = 1.0 / (1.0 + contact.normal_stiffness / strip);
    for (const Plate& plate : { plane.plates[0], layer.plates[0] }) {
        CHECK(plate.stiffness == Approx(softer * contact.normal_stiffness));
        CHECK(plate.shear_stiffness
            == Approx(softer * contact.shear_ratio * contact.normal_stiffness));
    }
}

TEST_CASE("A plate out of balance by a part of its load has that ratio however wide it is, D103")
{
    const double part = 0.05;
    const int rows = 4;
    // rigid cubes in columns, each of which bears its share: `state` at rest, then more load
    const auto ratio = [&](auto& state) {
        scale_masses(state, 0.7);
        press(state, 1, pressed);
        for (int k = 0; k < 2000; ++k)
            step(state, { 1.0, 0.7, 1, true });
        REQUIRE(unbalanced_ratio(state) < 1e-3 * part);
        press(state, 1, (1.0 + part) * pressed);
        step(state, { 1.0, 0.7, 1, true });
        return unbalanced_ratio(state);
    };
    for (const int columns : { 3, 6 }) {
        CAPTURE(columns);
        const double side = solid_samples::side;
        AssemblyOptions o = specimens::options(specimens::strong_contact());
        o.rigid = true;
        Assembly plane = specimens::assemble(specimens::grid(columns, rows, side), o);
        for (const int at : { bottom_side, top_side })
            add_side_plates(plane, at, 1, {});
        SolidInput input = granite(FacePointRule::corners_and_inner, true);
        input.contacts = { specimens::strong_contact() };
        SolidState layer = make_solid(solid_samples::brick(columns, 1, rows),
            Solid::box(columns * side, side, rows * side), input);
        lay_plates(layer, columns * side, side, rows * side, 0.0);
        // contacts between columns bear nothing and count in the mean
        const int upright = columns * (rows - 1), across = (columns - 1) * rows;
        REQUIRE(plane.contacts.count == upright + across);
        REQUIRE(layer.contacts.count == upright + across);
        const double expected = part * (upright + across) / upright;
        CHECK(ratio(plane) == Approx(expected).epsilon(1e-3));
        CHECK(ratio(layer) == Approx(expected).epsilon(1e-3));
    }
}

TEST_CASE("Prisms between frictionless planes have plane strain's E and nu", "[solids][many_steps]")
{
    const specimens::Specimen plane = plane_cells();
    AssemblyOptions o =
        specimens::options(specimens::strong_contact(), specimens::granite(Plane::strain));
    o.mesh = MeshKind::fan;
    const ElasticConstants expected = elastic_constants(specimens::assemble(plane, o));
    for (const double deep : { 1e-3, 2e-3, 3e-3 }) {
        SolidState s = prisms(plane, deep);
        CHECK(s.contacts.count == static_cast<int>(plane.cells.shared_edges.size()));
        const ElasticConstants loose = constants(s);
        hold_side(s, static_cast<int>(SolidSide::front), 1);
        hold_side(s, static_cast<int>(SolidSide::back), 1);
        const ElasticConstants found = constants(s);
        CHECK(found.youngs_modulus == Approx(expected.youngs_modulus).epsilon(1e-3));
        CHECK(found.poissons_ratio == Approx(expected.poissons_ratio).epsilon(1e-3));
        CHECK(loose.youngs_modulus < 0.97 * expected.youngs_modulus);
    }
}

TEST_CASE("A side that cannot be held is refused", "[solids]")
{
    SolidState s = prisms(plane_cells(), 2e-3);
    CHECK_THROWS_WITH(hold_side(s, 9, 1), Catch::Contains("nodes of side 9 = 0"));
    CHECK_THROWS_WITH(hold_side(s, 4, 3), Catch::Contains("axis = 3, must be 0, 1 or 2"));
}

TEST_CASE("A push on a held face stops it and does no more than a plastic impact", "[solids]")
{
    const Packing p = packing(12, 2);
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, true));
    set_real_masses(s);
    const int axis = GENERATE(0, 1, 2);
    hold_side(s, 4, axis);  // the front, across y
    if (axis == 1) {
        CHECK(s.held_faces.empty());
        CHECK(side_nodes(s, SolidSide::front).size() > 3);
        return;
    }
    REQUIRE(s.held_faces.size() > 2);
    const HeldFace face = s.held_faces.back();
    s.held_faces = { face };
    const int centre = s.grains.centre(face.grain);
    const Vector spin { 2e-4, -1e-4, 3e-4 }, velocity { 1e-6, 2e-6, -3e-6 };
    set_motion(s, face.grain, velocity, spin);
    const Vector before = s.bodies[face.grain].angular_momentum;
    const double kinetic = kinetic_of_velocities(s);
    hold_faces(s);
    const Vector now = space_vector(s.grains.velocity, centre), turn = s.bodies[face.grain].spin;
    const auto along = [&](Vector v) { return axis == 0 ? v.x : v.z; };
    const double moving = along(velocity + cross(spin, face.arm));
    CHECK(std::fabs(along(now + cross(turn, face.arm))) < 1e-12 * std::fabs(moving));
    CHECK(now.y == velocity.y);
    // momenta change by one push in the middle of the face, half of whose work is lost
    const double mass = 1.0 / s.grains.inverse_mass[s.grains.scalar_index(centre)];
    const double push = mass * along(now - velocity);
    const Vector pushed = axis == 0 ? Vector { push, 0.0, 0.0 } : Vector { 0.0, 0.0, push };
    const Vector moment = s.bodies[face.grain].angular_momentum - before;
    CHECK(norm(moment - cross(face.arm, pushed)) < 1e-9 * norm(moment));
    CHECK(kinetic - kinetic_of_velocities(s) == Approx(-0.5 * push * moving).epsilon(1e-9));
    CHECK_THROWS_WITH(elastic_field(s), Catch::Contains("held faces of rigid grains = 1"));
}
