// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/random_case.hpp"

#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/geometry/subdivision.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/contact_round.hpp"
#include "support/driven.hpp"
#include "support/law_path.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace plain {

namespace {

using flexpm::Assembly;
using flexpm::AssemblyOptions;
using flexpm::Outline;
using flexpm::Point;
using flexpm::Random;

/// A whole number from 0 to below `end`.
int below(Random& random, int end) { return static_cast<int>(random.next() * end); }
bool chance(Random& random, double share) { return random.next() < share; }
/// Uniform from `low` to `high`.
double between(Random& random, double low, double high)
{
    return low + (high - low) * random.next();
}
/// Uniform in the logarithm.
double scale_between(Random& random, double low, double high)
{
    return low * std::pow(high / low, random.next());
}

/// A rectangle, a convex polygon with corners on an ellipse, or a circle.
Outline draw_outline(Random& random, double width, double height)
{
    const double kind = random.next();
    if (kind < 0.15) return Outline::circle({ 0.5 * width, 0.5 * width }, 0.5 * width);
    if (kind < 0.75)
        return Outline::polygon(
            { { 0.0, 0.0 }, { width, 0.0 }, { width, height }, { 0.0, height } });
    std::vector<Point> corners;
    const int count = 3 + below(random, 5);
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * flexpm::pi * (k + 0.6 * random.next()) / count;
        corners.push_back({ 0.5 * width * std::cos(angle), 0.5 * height * std::sin(angle) });
    }
    return Outline::polygon(corners);
}

/// Discs near the places of a lattice over the outline, those outside left out.
std::vector<flexpm::Disc> draw_discs(Random& random, const Outline& outline, double spacing)
{
    const flexpm::BoundingCircle around = flexpm::bounding_circle(outline);
    const int half = static_cast<int>(around.radius / spacing) + 1;
    std::vector<flexpm::Disc> discs;
    for (int j = -half; j <= half; ++j) {
        for (int i = -half; i <= half; ++i) {
            const Point place = { around.centre.x + (i + 0.6 * (random.next() - 0.5)) * spacing,
                around.centre.y + (j + 0.6 * (random.next() - 0.5)) * spacing };
            const double radius = spacing * between(random, 0.38, 0.58);
            if (flexpm::distance_inside(outline, place) > 0.1 * spacing)
                discs.push_back({ place, radius });
        }
    }
    return discs;
}

/// Random grains, or none where a few discs happen to make no cells or none that share an edge.
std::optional<specimens::Specimen> draw_grains(Random& random)
{
    const double spacing = scale_between(random, 1e-3, 6e-3);  // [m]
    const double width = spacing * between(random, 2.0, 6.0);
    const Outline outline = draw_outline(random, width, spacing * between(random, 2.0, 6.0));
    specimens::Specimen s;
    s.discs = draw_discs(random, outline, spacing);
    flexpm::TessellationOptions o;
    o.short_edge = 0.12 * spacing;
    o.allow_hidden = true;
    try {
        s.cells = flexpm::tessellate(s.discs, outline, o);
    } catch (const std::invalid_argument&) {
        return {};
    }
    if (s.cells.shared_edges.empty()) return {};
    return s;
}

flexpm::ElasticMaterial draw_elastic(Random& random)
{
    flexpm::ElasticMaterial m =
        specimens::granite(chance(random, 0.5) ? flexpm::Plane::stress : flexpm::Plane::strain);
    m.young *= scale_between(random, 0.3, 3.0);
    m.poisson = between(random, 0.05, 0.45);
    m.density *= between(random, 0.5, 2.0);
    return m;
}

/// Some laws dilate, and the friction of some falls after a crack.
flexpm::ContactMaterial draw_law(Random& random)
{
    flexpm::ContactMaterial m = law_path::random_material(random);
    if (chance(random, 0.3)) {
        m.dilation = m.friction * random.next();
        m.dilation_slip = 2.0 * law_path::critical_slip(m) * random.next();
    }
    if (chance(random, 0.4)) {
        m.residual_friction = between(random, m.dilation, m.friction);
        m.slip_length = law_path::critical_slip(m) * between(random, 0.1, 2.0);
    }
    return m;
}

/// One to three minerals, and a law for each pair of them.
void draw_minerals(Random& random, int cells, AssemblyOptions& o)
{
    const int kinds = 1 + below(random, 3);
    o.elastic.clear();
    for (int k = 0; k < kinds; ++k)
        o.elastic.push_back(draw_elastic(random));
    o.laws.assign(kinds * kinds, {});
    for (int i = 0; i < kinds; ++i) {
        for (int j = i; j < kinds; ++j)
            o.laws[i * kinds + j] = o.laws[j * kinds + i] = draw_law(random);
    }
    for (int c = 0; c < cells; ++c)
        o.grain_material.push_back(below(random, kinds));
}

void draw_normals(Random& random, std::size_t edges, AssemblyOptions& o)
{
    const double share = chance(random, 0.5) ? 0.0 : random.next();
    for (std::size_t e = 0; e < edges; ++e)
        o.edge_normal.push_back(chance(random, share));
}

/// Inner particles: elastic within a grain, breaking between two.
Assembly draw_inner(Random& random, const specimens::Specimen& grains, std::string& name)
{
    name = "inner";
    const flexpm::InnerCells inner =
        flexpm::make_inner_cells(grains.cells, between(random, 3.0, 8.0));
    AssemblyOptions o = specimens::options(law_path::random_material(random));
    o.laws.push_back(flexpm::unbreakable(o.laws.front()));
    o.rigid = true;
    o.points = 1;
    o.parent = inner.grain;
    const bool of_edges = chance(random, 0.5);
    for (std::uint8_t outer : inner.outer) {
        o.edge_law.push_back(outer ? 0 : 1);
        o.edge_normal.push_back(outer && of_edges);
    }
    return flexpm::make_assembly(inner.cells, inner.discs, o);
}

Assembly draw_assembly(Random& random, std::string& name)
{
    std::optional<specimens::Specimen> drawn = draw_grains(random);
    while (!drawn)
        drawn = draw_grains(random);
    const specimens::Specimen& grains = *drawn;
    if (chance(random, 0.15)) return draw_inner(random, grains, name);
    AssemblyOptions o = specimens::options();
    o.rigid = chance(random, 0.3);
    o.mesh = chance(random, 0.3) ? flexpm::MeshKind::fan : flexpm::MeshKind::refined;
    o.points = 1 + below(random, 3);
    o.on_centre_line = o.points == 1 && chance(random, 0.3);
    o.thickness = scale_between(random, 1e-3, 1.0);
    draw_minerals(random, grains.cells.cells(), o);
    draw_normals(random, grains.cells.shared_edges.size(), o);
    name = o.rigid ? "rigid" : o.mesh == flexpm::MeshKind::fan ? "fan" : "refined";
    name +=
        ", " + std::to_string(o.points) + " points" + (o.on_centre_line ? " on centre line" : "");
    return specimens::assemble(grains, o);
}

int sides_of(const Assembly& a)
{
    return 1 + *std::max_element(a.facets.side.begin(), a.facets.side.end());
}

bool is_straight(const Assembly& a) { return sides_of(a) > 1; }

/// Normal of a random edge of the outline, inwards; of any length.
Point draw_inward(Random& random, const Assembly& a)
{
    int edge = below(random, a.facets.count);
    while (a.facets.side[edge] < 0)
        edge = below(random, a.facets.count);
    const auto nodes = a.facets.nodes(edge);
    const Point along = flexpm::vector_at(a.grains.reference, nodes[1])
        - flexpm::vector_at(a.grains.reference, nodes[0]);
    return { -along.y, along.x };
}

/// Plates on sides or against the outline, each at rest, driven or under load.
void draw_plates(Random& random, Assembly& a, std::string& name)
{
    const int count = chance(random, 0.4) ? 1 + below(random, 3) : 0;
    for (int i = 0; i < count; ++i) {
        const flexpm::PlateContact contact = { scale_between(random, 1e12, 1e15),
            chance(random, 0.5) ? random.next() : 0.0, chance(random, 0.3) };
        name += contact.bonded ? ", bonded plate" : ", plate";
        const double angle = 2.0 * flexpm::pi * random.next();
        if (is_straight(a) && chance(random, 0.5)) {
            const int side = below(random, sides_of(a));
            if (!flexpm::has_plates(a, side)) flexpm::add_side_plates(a, side, 1, contact);
        } else if (chance(random, 0.5)) {
            flexpm::add_wall(a, { -1.0 * std::cos(angle), -1.0 * std::sin(angle) },
                { std::cos(angle), std::sin(angle) }, contact);
            // the wall is laid far away; bring it into reach
            flexpm::Plate& wall = a.plates.back();
            wall.displacement = flexpm::least_gap(wall) * wall.normal;
        } else {
            flexpm::add_touching_plate(a, draw_inward(random, a), contact);
        }
    }
}

void drive_plates(Random& random, Assembly& a)
{
    for (std::size_t p = 0; p < a.plates.size(); ++p) {
        if (chance(random, 0.4) && a.plates[p].width > 0.0) {
            flexpm::press(a, static_cast<int>(p), scale_between(random, 1e4, 1e8));
            continue;
        }
        const double speed = scale_between(random, 1e-9, 1e-5);
        flexpm::set_velocity(a, static_cast<int>(p),
            { speed * between(random, -1.0, 1.0), speed * between(random, -1.0, 1.0) });
    }
}

void draw_boundary(Random& random, Assembly& a, std::string& name)
{
    for (int side = 0; side < sides_of(a); ++side) {
        if (chance(random, 0.3)) {
            flexpm::set_pressure(a, side, scale_between(random, 1e4, 1e8));
            name += ", pressure";
        }
        if (!a.grains.is_rigid(0) && chance(random, 0.3))
            flexpm::prescribe(a, flexpm::side_nodes(a, side), below(random, 2), 0.0);
    }
    if (a.grains.is_rigid(0) && chance(random, 0.3))
        driven::prescribe_spin(a.grains, below(random, a.grains.count), 0.0);
}

/// Let a part of all velocities be that of a loading, which is not damped.
void draw_loading(Random& random, Assembly& a)
{
    const double part = chance(random, 0.5) ? 0.0 : between(random, -0.5, 1.0);
    flexpm::Grains& grains = a.grains;
    for (std::size_t i = 0; i < grains.velocity.size(); ++i)
        a.loading.grains.velocity[i] = part * grains.velocity[i];
    for (std::size_t i = 0; i < grains.spin.size(); ++i)
        a.loading.grains.spin[i] = part * grains.spin[i];
    for (const flexpm::Plate& p : a.plates)
        a.loading.plates.push_back({ part * p.velocity, {}, {} });
}

/// A length over which the contacts of a specimen soften [m].
double softening_way(Random& random, const Assembly& a)
{
    const flexpm::LawParameters& law = a.contacts.laws[0];
    return scale_between(random, 0.02 * law.elastic_opening, 0.3 * law.critical_opening);
}

}  // namespace

RandomCase::RandomCase(std::uint64_t seed) : random(seed)
{
    assembly = draw_assembly(random, name);
    draw_plates(random, assembly, name);
    damping = chance(random, 0.2) ? 0.0 : between(random, 0.0, 0.95);
    if (chance(random, 0.25)) {
        dt = 0.5 * flexpm::set_real_masses(assembly, damping);
        const double size = scale_between(random, 1.0, 1e6);
        flexpm::set_gravity(
            assembly, { size * between(random, -1.0, 1.0), size * between(random, -1.0, 1.0) });
        name += ", gravity";
    } else {
        flexpm::scale_masses(assembly, damping);
        touches = assembly.grains.is_rigid(0) && chance(random, 0.5);
        if (touches) name += ", touches";
    }
    draw_boundary(random, assembly, name);
    drive_plates(random, assembly);
    steps = 20 + below(random, 60);
}

/// Velocities of an affine motion and of each grain on its own.
void RandomCase::draw_motion()
{
    flexpm::Grains& grains = assembly.grains;
    const double way = softening_way(random, assembly), radius = grains.radius[0];
    const double common = chance(random, 0.3) ? 0.0 : way / radius;
    const double own = chance(random, 0.3) ? 0.0 : way;
    double h[4];  // gradient of the velocity
    for (double& value : h)
        value = common * between(random, -1.0, 1.0);
    for (int g = 0; g < grains.count; ++g) {
        const Point drift = { own * between(random, -1.0, 1.0), own * between(random, -1.0, 1.0) };
        const double spin = own / radius * between(random, -1.0, 1.0);
        const auto velocity = [&](Point x) {
            return (1.0 / dt)
                * (drift + Point { h[0] * x.x + h[1] * x.y, h[2] * x.x + h[3] * x.y });
        };
        if (grains.is_rigid(g)) {
            const Point centre = vector_at(grains.reference, grains.centre(g));
            const bool held = grains.spin_prescribed[grains.slot[g]] != 0;
            flexpm::set_motion(grains, g, velocity(centre), held ? 0.0 : spin / dt, dt);
        } else {
            driven::set_velocity(assembly, g, velocity);
        }
    }
    draw_loading(random, assembly);
    next_motion += 2 + below(random, 15);
}

void RandomCase::load()
{
    if (touches && assembly.step % 10 == 9) contact_round::update_contacts(assembly);
    if (assembly.step >= next_motion) draw_motion();
}

bool RandomCase::has_diverged() const
{
    constexpr double far = 1.0;  // [m], of specimens of a few centimetres
    const auto& u = assembly.grains.displacement;
    return !std::all_of(u.begin(), u.end(), [](double way) { return std::fabs(way) < far; });
}

}  // namespace plain
