// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Invariants of the packed assembly: layout, padding, gathered forces, spin. SI units.
#include "support/specimens.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <functional>
#include <set>

using namespace flexpm;

namespace {

constexpr double width = 0.02, height = 0.03;

Assembly random_assembly(MeshKind mesh = MeshKind::refined, int points = 3)
{
    AssemblyOptions o = specimens::options(specimens::strong_contact());
    o.mesh = mesh;
    o.points = points;
    return specimens::assemble(specimens::random_grains(width, height, 3e-3, 21), o);
}

void for_each_node(const Assembly& a, const std::function<void(int grain, int node)>& visit)
{
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n)
            visit(g, a.grains.node(g, n));
    }
}

/// Distort the assembly by random velocities for one step of dt = 1; masses are infinite.
void distort(Assembly& a, double amplitude)
{
    Random random(5);
    for_each_node(a, [&](int, int n) {
        a.grains.velocity[n] = amplitude * (random.next() - 0.5);
        a.grains.velocity[component(n, 1)] = amplitude * (random.next() - 0.5);
    });
    step(a, StepOptions());
}

/// Force of contact `c` on end `end` of its edge on side `side`.
Point contact_force(const Assembly& a, int c, int side, int end)
{
    const double* f = &a.contacts.forces[Contacts::force_index(c, side, end)];
    return { f[0], f[1] };
}

int contact_node(const Assembly& a, int c, int side, int end)
{
    return a.contacts.node(c, side, end);
}

Point rotate(Point p, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return { c * p.x - s * p.y, s * p.x + c * p.y };
}

/// Turn all nodes about the origin from angle `from` to angle `to` in one step, along the chord.
void spin(Assembly& a, double from, double to)
{
    for_each_node(a, [&](int, int n) {
        const Point p = vector_at(a.grains.reference, n);
        const Point p0 = rotate(p, from), p1 = rotate(p, to);
        a.grains.velocity[n] = p1.x - p0.x;
        a.grains.velocity[component(n, 1)] = p1.y - p0.y;
    });
    step(a, StepOptions());
}

double largest_force(const Assembly& a)
{
    double largest = 0.0;
    for (double f : a.grains.force)
        largest = std::max(largest, std::fabs(f));
    return largest;
}

}  // namespace

TEST_CASE("a layout tells node, component and grain of a value apart", "[assembly]")
{
    // eight grains side by side, and one whose vectors fill four values
    for (const Layout& layout : { plane_layout, Layout { 3, 1, 1, 4 } }) {
        std::set<int> places, scalars;
        for (int number = 0; number < 5; ++number) {
            for (int lane = 0; lane < layout.grains_per_block; ++lane) {
                const int node = layout.node_stride * number + lane;
                scalars.insert(layout.scalar_index(node));
                for (int axis = 0; axis < layout.dimension; ++axis) {
                    const int index = layout.component(node, axis);
                    places.insert(index);
                    CHECK(layout.axis_of(index) == axis);
                    CHECK(index / layout.node_stride == number);
                }
            }
        }
        const int nodes = 5 * layout.grains_per_block;
        CHECK(static_cast<int>(places.size()) == layout.dimension * nodes);
        CHECK(static_cast<int>(scalars.size()) == nodes);
        CHECK(*scalars.begin() == 0);
        CHECK(*scalars.rbegin() == nodes - 1);
    }
}

TEST_CASE("every node has its own place in the packed arrays", "[assembly]")
{
    const Assembly a = random_assembly();
    std::set<int> places, scalars;
    int nodes = 0;
    for_each_node(a, [&](int, int n) {
        ++nodes;
        REQUIRE(n >= 0);
        REQUIRE(component(n, 1) < static_cast<int>(a.grains.reference.size()));
        places.insert({ n, component(n, 1) });
        scalars.insert(scalar_index(n));
    });
    CHECK(static_cast<int>(places.size()) == 2 * nodes);
    CHECK(static_cast<int>(scalars.size()) == nodes);
    CHECK(*scalars.begin() >= 0);
    CHECK(*scalars.rbegin() < static_cast<int>(a.grains.inverse_mass.size()));
    for (int g = 0; g < a.grains.count; ++g)
        CHECK(a.grains.in_slot[a.grains.slot[g]] == g);
}

TEST_CASE("grains fill the rectangle and keep their corners", "[assembly]")
{
    const auto s = specimens::random_grains(width, height, 3e-3, 21);
    for (const MeshKind mesh : { MeshKind::fan, MeshKind::refined }) {
        const Assembly a = random_assembly(mesh);
        REQUIRE(a.grains.count == s.cells.cells());
        double volume = 0.0;
        for (int g = 0; g < a.grains.count; ++g) {
            for (int t = 0; t < triangles_of(a.grains, g); ++t)
                volume += shape_of(a.grains, g, t).volume;
            std::set<std::pair<double, double>> cell, grain;
            for (const Point& p : cell_polygon(s.cells, g))
                cell.insert({ p.x, p.y });
            for (int n = 0; n < s.cells.vertices_of(g); ++n) {
                const Point p = a.grains.point_at(a.grains.node(g, n));
                grain.insert({ p.x, p.y });
            }
            CHECK(cell == grain);
        }
        CHECK(volume == Approx(width * height * specimens::thickness).epsilon(1e-12));
    }
}

TEST_CASE("contacts join the same edge of their two grains", "[assembly]")
{
    const int points = GENERATE(1, 2, 3);
    const Assembly a = random_assembly(MeshKind::refined, points);
    for (int c = 0; c < a.contacts.count; ++c) {
        std::set<int> owned[2];
        for (int side = 0; side < 2; ++side) {
            const int g = a.contacts.pairs[c][side];
            for (int n = 0; n < a.grains.nodes_of(g); ++n)
                owned[side].insert(a.grains.node(g, n));
            const int row = side == 0 ? NodeRow::centre_a : NodeRow::centre_b;
            CHECK(a.contacts.nodes[row_index(c, row, NodeRow::count)] == a.grains.centre_place(g));
        }
        for (int end = 0; end < 2; ++end) {
            const int na = contact_node(a, c, 0, end), nb = contact_node(a, c, 1, end);
            REQUIRE(owned[0].count(na) == 1);
            REQUIRE(owned[1].count(nb) == 1);
            CHECK(a.grains.point_at(na).x == a.grains.point_at(nb).x);
            CHECK(a.grains.point_at(na).y == a.grains.point_at(nb).y);
        }
        const Point p0 = a.grains.point_at(contact_node(a, c, 0, 0));
        const Point p1 = a.grains.point_at(contact_node(a, c, 0, 1));
        const double length = std::hypot(p1.x - p0.x, p1.y - p0.y);
        double area = 0.0, first = 0.0, second = 0.0;
        for (int p = 0; p < points; ++p) {
            const double w = a.contacts.weight(c, p, 0);
            CHECK(a.contacts.weight(c, p, 1) == w);
            const double share = a.contacts.area(c, p);
            area += share;
            first += share * (w - 0.5) * length;
            second += share * (w - 0.5) * (w - 0.5) * length * length;
        }
        CHECK(area == Approx(length * specimens::thickness).epsilon(1e-14));
        CHECK(std::fabs(first) < 1e-14 * area * length);
        // Lobatto's three points have the bending stiffness of the whole edge, the ends three times
        const double expected[] = { 0.0, 1.0 / 4.0, 1.0 / 12.0 };
        CHECK(second / (area * length * length) == Approx(expected[points - 1]).margin(1e-14));
        // the normal points out of the first grain, whose edge runs counter-clockwise
        const Point n = a.contacts.normal(c);
        CHECK(std::hypot(n.x, n.y) == Approx(1.0).epsilon(1e-14));
        CHECK(n.x * (p1.y - p0.y) - n.y * (p1.x - p0.x) > 0.0);
    }
}

TEST_CASE("padded lanes stay at rest and exert nothing", "[assembly]")
{
    Assembly a = random_assembly();
    REQUIRE(a.grains.blocks() * lanes > a.grains.count);
    scale_masses(a, 0.7);
    distort(a, 1e-7);
    for (int n = 0; n < 50; ++n)
        step(a, StepOptions());
    int padded = 0;
    for (int slot = 0; slot < a.grains.blocks() * lanes; ++slot) {
        if (a.grains.in_slot[slot] >= 0) continue;
        ++padded;
        for (int k = 0; k < a.grains.group(slot / lanes).nodes; ++k) {
            const int n = a.grains.block_nodes[slot / lanes] + node_stride * k + slot % lanes;
            for (int i : { n, component(n, 1) }) {
                CHECK(a.grains.prescribed[i] == 1);
                CHECK(a.grains.displacement[i] == 0.0);
                CHECK(a.grains.velocity[i] == 0.0);
                CHECK(a.grains.force[i] == 0.0);
            }
        }
    }
    CHECK(padded == a.grains.blocks() * lanes - a.grains.count);
    for (int c = a.contacts.count; c < a.contacts.blocks() * lanes; ++c) {
        for (int i = 0; i < Contacts::force_values; ++i)
            CHECK(a.contacts.forces[Contacts::force_index(c, 0, 0) + i] == 0.0);
    }
}

TEST_CASE("every force acts on the right node, and all forces sum to nothing", "[assembly]")
{
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    Assembly a = random_assembly(mesh);
    distort(a, 1e-6);
    const double scale = largest_force(a);
    REQUIRE(scale > 1e3);
    double sum_x = 0.0, sum_y = 0.0;
    for_each_node(a, [&](int, int n) {
        sum_x += a.grains.force[n];
        sum_y += a.grains.force[component(n, 1)];
    });
    CHECK(std::hypot(sum_x, sum_y) < 1e-11 * scale);

    // what is left without the contacts, in each grain: elements, in balance of force and moment
    Array<double> rest = a.grains.force;
    for (int c = 0; c < a.contacts.count; ++c) {
        for (int side = 0; side < 2; ++side) {
            for (int end = 0; end < 2; ++end) {
                const int n = contact_node(a, c, side, end);
                const Point f = contact_force(a, c, side, end);
                rest[n] -= f.x;
                rest[component(n, 1)] -= f.y;
            }
        }
    }
    for (int g = 0; g < a.grains.count; ++g) {
        double x = 0.0, y = 0.0, moment = 0.0;
        const Point centre = a.grains.point_at(a.grains.centre(g));
        for (int k = 0; k < a.grains.nodes_of(g); ++k) {
            const int n = a.grains.node(g, k);
            const Point p = a.grains.point_at(n);
            x += rest[n];
            y += rest[component(n, 1)];
            moment += (p.x - centre.x) * rest[component(n, 1)] - (p.y - centre.y) * rest[n];
        }
        CHECK(std::hypot(x, y) < 1e-12 * scale);
        CHECK(std::fabs(moment) < 1e-12 * scale * 3e-3);
    }
}

TEST_CASE("a spun specimen carries no force, at any angle", "[assembly]")
{
    Random random(9);
    const double scale = 25.8e9 * specimens::thickness * width;
    for (int i = 0; i < 20; ++i) {
        const double angle = i == 0 ? 0.5 * M_PI : 2.0 * M_PI * random.next();
        for (const MeshKind mesh : { MeshKind::fan, MeshKind::refined }) {
            Assembly one = specimens::assemble(specimens::hexagon(), specimens::options());
            spin(one, 0.0, angle);
            CHECK(largest_force(one) < 1e-14 * scale);
            Assembly many = random_assembly(mesh);
            const int steps = 20;
            for (int n = 0; n < steps; ++n)
                spin(many, angle * n / steps, angle * (n + 1) / steps);
            CHECK(largest_force(many) < 1e-12 * scale);
        }
    }
}

TEST_CASE("materials belong to grains and pairs of grains", "[assembly]")
{
    const auto s = specimens::grid(2, 2, 2e-3);
    AssemblyOptions o = specimens::options();
    ElasticMaterial stiff = specimens::granite();
    stiff.young *= 2.0;
    o.elastic.push_back(stiff);
    o.laws.clear();
    for (const double k : { 1e14, 2e14, 3e14, 4e14 })
        o.laws.push_back(specimens::strong_contact(k));
    o.grain_material = { 0, 1, 1, 0 };
    const Assembly a = specimens::assemble(s, o);
    for (int g = 0; g < 4; ++g) {
        CHECK(stiffness_of(a.grains, g).shear
            == Approx((o.grain_material[g] + 1) * 0.5 * 25.8e9 / 1.23).epsilon(1e-14));
    }
    for (int c = 0; c < a.contacts.count; ++c) {
        const int i = o.grain_material[a.contacts.pairs[c][0]];
        const int j = o.grain_material[a.contacts.pairs[c][1]];
        CHECK(a.contacts.law_of(c).normal_stiffness == 1e14 * (1 + 2 * i + j));
    }
    // half of the grains have 1e14 and 25.8e9, half 4e14 and 51.6e9
    const double contacts = 2.5e14 * 2.0 * a.grains.radius[0];
    const auto scales = flexpm::scale_inputs(a, flexpm::Sense::tension, 1.0);
    CHECK(scales.modulus == Approx(1.0 / (1.0 / 38.7e9 + 1.0 / contacts)));
}

TEST_CASE("wrong options are refused", "[assembly]")
{
    const auto s = specimens::grid(2, 1, 2e-3);
    const AssemblyOptions good = specimens::options();
    const auto refused = [&](const std::function<void(AssemblyOptions&)>& spoil, const char* text) {
        AssemblyOptions o = good;
        spoil(o);
        CHECK_THROWS_AS(specimens::assemble(s, o), std::invalid_argument);
        CHECK_THROWS_WITH(specimens::assemble(s, o), Catch::Contains(text));
    };
    for (const double bad : { 0.0, -0.08, std::nan(""), HUGE_VAL }) {
        refused([&](AssemblyOptions& o) { o.thickness = bad; }, "thickness");
    }
    for (const int bad : { 0, 4, -1 }) {
        refused([&](AssemblyOptions& o) { o.points = bad; }, "contact points");
    }
    refused([](AssemblyOptions& o) { o.on_centre_line = true; }, "centre line");
    refused([](AssemblyOptions& o) { o.elastic.clear(); }, "materials");
    refused([](AssemblyOptions& o) { o.laws.clear(); }, "contact laws");
    refused([](AssemblyOptions& o) { o.grain_material = { 0 }; }, "grain materials");
    refused([](AssemblyOptions& o) { o.grain_material = { 0, 1 }; }, "grain material");
    refused([](AssemblyOptions& o) { o.parent = { 0, 2 }; }, "grain of a particle = 2");
    refused([](AssemblyOptions& o) { o.parent = { -1, 0 }; }, "grain of a particle = -1");
    refused([](AssemblyOptions& o) { o.elastic[0].young = -1.0; }, "young");
    refused([](AssemblyOptions& o) { o.laws[0].normal_stiffness = 0.0; }, "normal_stiffness");
}

TEST_CASE("discs that are not those of the cells are refused", "[assembly]")
{
    const auto s = specimens::grid(2, 1, 2e-3);
    auto discs = s.discs;
    discs.pop_back();
    const auto options = specimens::options();
    CHECK_THROWS_WITH(
        flexpm::make_assembly(s.cells, discs, options), Catch::Contains("discs of the cells = 1"));
    CHECK_THROWS_WITH(flexpm::make_grain_meshes(s.cells, discs, options.mesh),
        Catch::Contains("discs of the cells = 1"));
    discs = s.discs;
    discs[1].radius = std::nan("");
    CHECK_THROWS_WITH(
        flexpm::make_assembly(s.cells, discs, options), Catch::Contains("disc 1: radius = nan m"));
    discs = s.discs;
    discs[0].centre.y = HUGE_VAL;
    CHECK_THROWS_WITH(
        flexpm::make_assembly(s.cells, discs, options), Catch::Contains("disc 0: centre"));
}

TEST_CASE(
    "a node is found by its place: its grain, its number there, or a padded lane", "[assembly]")
{
    const Assembly a =
        specimens::assemble(specimens::random_grains(9e-3, 9e-3, 3e-3, 4), specimens::options());
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            const flexpm::GrainNode found = flexpm::grain_node(a.grains, a.grains.node(g, n));
            CHECK((found.grain == g && found.number == n));
        }
    }
    for (std::size_t slot = 0; slot < a.grains.in_slot.size(); ++slot) {
        const int block = static_cast<int>(slot) / flexpm::lanes;
        const int lane = static_cast<int>(slot) % flexpm::lanes;
        const int node = a.grains.block_nodes[block] + flexpm::node_stride + lane;
        CHECK(flexpm::grain_node(a.grains, node).grain == a.grains.in_slot[slot]);
    }
}
