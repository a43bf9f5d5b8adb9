// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Inner particles: equal areas, and a conforming tessellation across the edges of grains.
#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/geometry/lloyd.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/subdivision.hpp>
#include <flexpm/kernel/law/bilinear_step.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include "support/catch.hpp"

#include "support/driven.hpp"
#include "support/specimens.hpp"

#include <map>

using flexpm::Assembly;
using flexpm::component;
using flexpm::lanes;
using flexpm::Point;

namespace {

double length_of(const flexpm::Tessellation& t, int v0, int v1)
{
    return std::hypot(t.vertices[v1].x - t.vertices[v0].x, t.vertices[v1].y - t.vertices[v0].y);
}

/// True if the cell has the edge from v0 to v1 in its counter-clockwise sense.
bool has_edge(const flexpm::Tessellation& t, int cell, int v0, int v1)
{
    const int first = t.cell_offsets[cell], n = t.vertices_of(cell);
    for (int k = 0; k < n; ++k) {
        if (t.cell_vertices[first + k] == v0 && t.cell_vertices[first + (k + 1) % n] == v1)
            return true;
    }
    return false;
}

}  // namespace

TEST_CASE("power cells of relaxed seeds share a polygon evenly", "[inner]")
{
    const auto cells = specimens::random_grains(12e-3, 18e-3, 3e-3, GENERATE(1, 2)).cells;
    for (int c = 0; c < cells.cells(); ++c) {
        const auto polygon = flexpm::cell_polygon(cells, c);
        const auto packing = flexpm::relax_seeds(polygon, 26);
        REQUIRE(packing.cells.size() == 26);
        const double mean = flexpm::cell_area(cells, c) / 26;
        double total = 0.0;
        for (const auto& cell : packing.cells) {
            std::vector<Point> corners;
            for (const auto& k : cell)
                corners.push_back(k.point);
            const double area = flexpm::polygon_shape(corners).area;
            CHECK(area == Approx(mean).epsilon(0.02));
            total += area;
        }
        CHECK(total == Approx(26 * mean).epsilon(1e-12));
    }
}

TEST_CASE("inner cells tile the specimen and meet edge to edge", "[inner]")
{
    const auto s = specimens::random_grains(15e-3, 24e-3, 3e-3, GENERATE(1, 2, 3));
    const double count = GENERATE(1.0, 7.0, 26.0);
    const auto inner = flexpm::make_inner_cells(s.cells, count);
    const auto& t = inner.cells;
    CHECK(t.cells() == Approx(count * s.cells.cells()).epsilon(0.03));
    double area = 0.0;
    for (int c = 0; c < t.cells(); ++c) {
        CHECK(t.vertices_of(c) >= 3);
        CHECK(flexpm::cell_area(t, c) > 0.0);
        area += flexpm::cell_area(t, c);
        const double seat = 3.14159265358979 * inner.discs[c].radius * inner.discs[c].radius;
        CHECK(seat == Approx(flexpm::cell_area(t, c)).epsilon(0.15));  // before corners were merged
    }
    CHECK(area == Approx(15e-3 * 24e-3).epsilon(1e-9));

    const int edges = static_cast<int>(t.shared_edges.size() + t.boundary_edges.size());
    CHECK(static_cast<int>(t.vertices.size()) - edges + t.cells() == 1);  // Euler
    int sides = 0;
    for (int c = 0; c < t.cells(); ++c)
        sides += t.vertices_of(c);
    CHECK(sides == static_cast<int>(2 * t.shared_edges.size() + t.boundary_edges.size()));
    for (const auto& e : t.shared_edges) {
        CHECK(e.cell_a < e.cell_b);
        CHECK(has_edge(t, e.cell_a, e.vertex_0, e.vertex_1));
        CHECK(has_edge(t, e.cell_b, e.vertex_1, e.vertex_0));
    }
    for (const auto& e : t.boundary_edges)
        CHECK(has_edge(t, e.cell, e.vertex_0, e.vertex_1));
}

TEST_CASE("stretches along a grain's edge add up to it", "[inner]")
{
    const auto s = specimens::random_grains(15e-3, 24e-3, 3e-3, 4);
    const auto inner = flexpm::make_inner_cells(s.cells);
    std::map<std::pair<int, int>, double> lengths;
    for (std::size_t i = 0; i < inner.outer.size(); ++i) {
        const auto& e = inner.cells.shared_edges[i];
        const int a = inner.grain[e.cell_a], b = inner.grain[e.cell_b];
        CHECK(inner.outer[i] == (a != b));
        if (a != b) lengths[std::minmax(a, b)] += length_of(inner.cells, e.vertex_0, e.vertex_1);
    }
    for (const auto& e : s.cells.shared_edges) {
        const double length = length_of(s.cells, e.vertex_0, e.vertex_1);
        CHECK(lengths[std::minmax(e.cell_a, e.cell_b)] == Approx(length).epsilon(1e-9));
    }
    CHECK(lengths.size() == s.cells.shared_edges.size());
}

TEST_CASE(
    "an unbreakable contact has the same stiffness and never leaves its elastic branch", "[inner]")
{
    const auto law = flexpm::make_law(flexpm::unbreakable(specimens::granite_contact()));
    flexpm::PointState s;
    const auto t = flexpm::advance_point(law, 1e-4, 1e-4, s);
    CHECK(t.damage == 0.0);
    CHECK(t.normal == Approx(1.80e14 * 1e-4).epsilon(1e-14));
    CHECK(t.shear == Approx(0.28 * 1.80e14 * 1e-4).epsilon(1e-14));
}

TEST_CASE("contacts across an edge of a grain may take its normal", "[inner]")
{
    const auto s = specimens::random_grains(9e-3, 9e-3, 3e-3, 2);
    const auto inner = flexpm::make_inner_cells(s.cells, 9.0);
    auto o = specimens::options();
    o.rigid = true;
    o.points = 1;
    o.laws.push_back(flexpm::unbreakable(o.laws[0]));
    o.edge_normal = inner.outer;
    for (auto outer : inner.outer)
        o.edge_law.push_back(outer ? 0 : 1);
    Assembly a = flexpm::make_assembly(inner.cells, inner.discs, o);
    flexpm::scale_masses(a, 0.7);
    // the whole specimen turns: normals follow and nothing is strained
    const double angle = 0.3 / 50;
    const Point pivot = vector_at(a.grains.reference, a.grains.centre(0));
    for (int i = 0; i < 50; ++i) {
        for (int g = 0; g < a.grains.count; ++g) {
            const Point p = a.grains.point_at(a.grains.centre(g));
            const double c = std::cos(angle) - 1.0, sn = std::sin(angle);
            const double x = p.x - pivot.x, y = p.y - pivot.y;
            flexpm::set_motion(a.grains, g, { c * x - sn * y, sn * x + c * y }, angle, 1.0);
        }
        flexpm::step(a, flexpm::StepOptions());
    }
    const double turned = 0.3;
    for (int c = 0; c < a.contacts.count; ++c) {
        const auto& e = inner.cells.shared_edges[c];
        const Point p = inner.cells.vertices[e.vertex_0], q = inner.cells.vertices[e.vertex_1];
        const Point ca = inner.discs[e.cell_a].centre, cb = inner.discs[e.cell_b].centre;
        Point n = { q.y - p.y, p.x - q.x };
        if (!inner.outer[c]) n = { cb.x - ca.x, cb.y - ca.y };
        const double d = std::hypot(n.x, n.y);
        const Point now = a.contacts.normal(c);
        CHECK(now.x == Approx((std::cos(turned) * n.x - std::sin(turned) * n.y) / d).margin(1e-9));
        CHECK(now.y == Approx((std::sin(turned) * n.x + std::cos(turned) * n.y) / d).margin(1e-9));
        CHECK(std::fabs(a.contacts.point_state(c, 0).opening) < 1e-12);
        CHECK(std::fabs(a.contacts.point_state(c, 0).slip) < 1e-12);
    }
}

TEST_CASE("two grains out of line: opening and slip along the chosen normal", "[inner]")
{
    const double size = 3e-3, rise = 0.3 * size, way = 1e-9;
    const bool of_edge = GENERATE(false, true);
    auto s = specimens::grid(2, 1, size);
    s.discs[1].centre.y += rise;
    auto o = specimens::options(specimens::strong_contact());
    o.rigid = true;
    o.points = 1;
    o.edge_normal = { static_cast<std::uint8_t>(of_edge) };
    Assembly a = specimens::assemble(s, o);
    flexpm::scale_masses(a, 0.7);
    a.grains.prescribed[a.grains.centre(0)] =
        a.grains.prescribed[component(a.grains.centre(0), 1)] = 1;
    driven::prescribe_spin(a.grains, 0, 0.0);
    a.grains.prescribed[a.grains.centre(1)] =
        a.grains.prescribed[component(a.grains.centre(1), 1)] = 1;
    driven::prescribe_spin(a.grains, 1, 0.0);
    flexpm::set_motion(a.grains, 1, { way, 0.0 }, 0.0, 1.0);
    flexpm::step(a, flexpm::StepOptions());

    const double k = o.laws[0].normal_stiffness, ratio = o.laws[0].shear_ratio;
    const double area = size * specimens::thickness, far = std::hypot(size, rise);
    const Point n = of_edge ? Point { 1.0, 0.0 } : Point { size / far, rise / far };
    const auto point = a.contacts.point_state(0, 0);
    CHECK(point.opening == Approx(way * n.x).epsilon(1e-5));
    CHECK(std::fabs(point.slip) == Approx(way * n.y).epsilon(1e-5).margin(1e-15));
    // K_n along the normal and eta K_n across it pull the grain back
    const auto force = flexpm::resultant_on(a.grains, 1).force;
    CHECK(force.x == Approx(-k * area * way * (n.x * n.x + ratio * n.y * n.y)).epsilon(1e-5));
    CHECK(
        force.y == Approx(-k * area * way * (1.0 - ratio) * n.x * n.y).epsilon(1e-5).margin(1e-7));
}

TEST_CASE("particles know the grain of the rock that they are part of", "[inner]")
{
    const auto s = specimens::random_grains(9e-3, 9e-3, 3e-3, 2);
    const auto inner = flexpm::make_inner_cells(s.cells, 9.0);
    auto o = specimens::options();
    o.rigid = true;
    o.points = 1;
    o.parent = inner.grain;
    const Assembly a = flexpm::make_assembly(inner.cells, inner.discs, o);
    const auto bonded = flexpm::count_contacts(a);
    const auto outer = std::count(inner.outer.begin(), inner.outer.end(), 1);
    CHECK(bonded.between == outer);
    CHECK(bonded.between + bonded.within == a.contacts.count);
    const auto shown = flexpm::take_snapshot(a);
    for (std::size_t t = 0; t < shown.element_grain.size(); ++t)
        CHECK(shown.element_grain[t] == inner.grain[shown.element_particle[t]]);
    for (int c = 0; c < a.contacts.count; ++c) {
        const bool between = shown.contact_grains[2 * c] != shown.contact_grains[2 * c + 1];
        CHECK(between == (inner.outer[c] != 0));
    }
    o.parent.pop_back();
    CHECK_THROWS_WITH(flexpm::make_assembly(inner.cells, inner.discs, o),
        Catch::Contains("must be one for each cell"));
}

TEST_CASE("inner cells do not depend on anything but the grains", "[inner]")
{
    const auto s = specimens::random_grains(9e-3, 9e-3, 3e-3, 4);
    const auto one = flexpm::make_inner_cells(s.cells), two = flexpm::make_inner_cells(s.cells);
    REQUIRE(one.discs.size() == two.discs.size());
    for (std::size_t i = 0; i < one.discs.size(); ++i) {
        CHECK(one.discs[i].centre.x == two.discs[i].centre.x);
        CHECK(one.discs[i].radius == two.discs[i].radius);
    }
    CHECK_THROWS_WITH(flexpm::make_inner_cells(s.cells, 0.0), Catch::Contains("must be 1 to 1000"));
}
