// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bonds of cells that are no whole Laguerre cells act across the shared edge, whatever the
/// line of the centres. Deviation D104. SI units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/fem/triangle.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/tiling/given_cells.hpp>
#include <flexpm/kernel/tiling/joint_cut.hpp>
#include <flexpm/kernel/tiling/outline_cells.hpp>

#include "support/dense.hpp"
#include "support/driven.hpp"
#include "support/law_path.hpp"

#include <map>
#include <set>

using namespace driven;
using flexpm::Tiling;

namespace {

using Polygons = std::vector<std::vector<Point>>;

constexpr double side = 2e-3;  // of the upper one of two cells [m]
const auto material = specimens::granite_contact();

Assembly assemble(const Tiling& tiling, flexpm::AssemblyOptions options, bool rigid = false)
{
    options.rigid = rigid;
    return flexpm::make_assembly(tiling.cells, tiling.discs, options);
}

/// A square on a block that reaches `offset` further to the right than to the left: the boundary is
/// level, the line of the centres is not.
Tiling two_cells(double offset)
{
    const double a = side;
    const std::vector<Point> lower { { -a, -a }, { 2.0 * a + offset, -a },
        { 2.0 * a + offset, 0.0 }, { a, 0.0 }, { 0.0, 0.0 }, { -a, 0.0 } };
    const std::vector<Point> upper { { 0.0, 0.0 }, { a, 0.0 }, { a, a }, { 0.0, a } };
    return flexpm::cells_of_polygons({ lower, upper }, false).tiling;
}

/// Largest force on the upper cell along a direction as it moves by `way` along it [N].
double largest_force(Assembly& a, Point along, double way)
{
    constexpr int steps = 4000;
    const Point velocity = (way / steps) * along;
    hold_all(a);
    if (a.grains.is_rigid(1)) {
        prescribe_spin(a.grains, 0, 0.0);
        flexpm::set_motion(a.grains, 1, velocity, 0.0, 1.0);
        a.grains.spin_prescribed[a.grains.slot[1]] = 1;
    } else {
        set_velocity(a, 1, velocity);
    }
    double largest = 0.0;
    for (int i = 0; i < steps; ++i) {
        run(a, 1);
        largest = std::max(largest, flexpm::dot(resultant(a, 0), along));
    }
    return largest;
}

/// Cells drawn by hand: those of a packing whose inner corners are moved at random.
Polygons drawn_polygons(std::uint64_t seed)
{
    const auto s = specimens::random_grains(12e-3, 12e-3, 3e-3, seed);
    std::set<int> rim;
    for (const auto& e : s.cells.boundary_edges)
        rim.insert({ e.vertex_0, e.vertex_1 });
    flexpm::Random random(seed);
    std::vector<Point> vertices = s.cells.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const Point moved { random.next() - 0.5, random.next() - 0.5 };
        if (rim.count(static_cast<int>(v)) == 0) vertices[v] = vertices[v] + 0.5e-3 * moved;
    }
    Polygons polygons(s.cells.cells());
    for (int c = 0; c < s.cells.cells(); ++c) {
        for (int i = s.cells.cell_offsets[c]; i < s.cells.cell_offsets[c + 1]; ++i)
            polygons[c].push_back(vertices[s.cells.cell_vertices[i]]);
    }
    return polygons;
}

/// Rotation by an angle and a translation, of places.
struct Motion {
    double angle = 0.0;
    Point way;

    Point operator()(Point p) const
    {
        const double c = std::cos(angle), s = std::sin(angle);
        return { c * p.x - s * p.y + way.x, s * p.x + c * p.y + way.y };
    }
};

/// Put every node where the linear map of a gradient, and then a motion, brings it.
void place_nodes(Assembly& a, const flexpm::Gradient& h, const Motion& motion)
{
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            const int node = a.grains.node(g, n);
            const Point p = vector_at(a.grains.reference, node);
            const Point to =
                motion({ p.x + h.xx * p.x + h.xy * p.y, p.y + h.yx * p.x + h.yy * p.y });
            set_vector(a.grains.displacement, node, to - p);
        }
    }
}

/// Edge of a grain's side of a contact as it lies now.
Point present_edge(const Assembly& a, int contact, int side)
{
    return a.grains.point_at(a.contacts.node(contact, side, 1))
        - a.grains.point_at(a.contacts.node(contact, side, 0));
}

/// Give all points of a contact the tractions across and along its edge that a stress has, whose
/// product with the edge's reference normal is `traction`.
void set_traction(Assembly& a, int contact, Point traction)
{
    const Point edge = present_edge(a, contact, 0);
    const Point normal = (1.0 / flexpm::norm(edge)) * Point { edge.y, -edge.x };
    const double stiffness = a.contacts.law_of(contact).normal_stiffness;
    for (int p = 0; p < a.contacts.points_of(contact); ++p) {
        flexpm::PointState s;
        s.opening = flexpm::dot(traction, normal) / stiffness;
        s.shear_traction = flexpm::cross(normal, traction);
        s.slip = s.shear_traction / stiffness;  // of a shear ratio of 1: the gap has no moment
        s.max_opening = std::max(s.opening, 0.0);
        a.contacts.set_point_state(contact, p, s);
    }
}

/// Largest force on a node off the outline [N].
double largest_free_force(const Assembly& a)
{
    std::set<int> rim;
    for (int f = 0; f < a.facets.count; ++f) {
        for (int node : a.facets.nodes(f))
            rim.insert(node);
    }
    double largest = 0.0;
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            const int node = a.grains.node(g, n);
            if (rim.count(node) == 0)
                largest = std::max(largest, flexpm::norm(a.grains.force_at(node)));
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("A level boundary bears its strengths times its area, wherever the centres lie")
{
    const double area = side * specimens::thickness;
    const double opened = 2.0 * law_path::elastic_opening(material);
    const double slipped = 2.0 * law_path::elastic_slip(material);
    for (double offset : { 0.0, 2.0 * side, 4.0 * side, 8.0 * side }) {
        for (bool rigid : { false, true }) {
            CAPTURE(offset, rigid);
            Assembly pulled = assemble(two_cells(offset), specimens::options(material), rigid);
            REQUIRE(pulled.contacts.count == 1);
            CHECK(largest_force(pulled, { 0.0, 1.0 }, opened)
                == Approx(material.tensile_strength * area).epsilon(1e-3));
            Assembly sheared = assemble(two_cells(offset), specimens::options(material), rigid);
            CHECK(largest_force(sheared, { 1.0, 0.0 }, slipped)
                == Approx(material.cohesion * area).epsilon(1e-3));
        }
    }
}

TEST_CASE("A uniform stress of drawn cells is in balance, also where it has moved and turned")
{
    const auto contact = specimens::strong_contact(1.80e14, 1.0);
    const flexpm::Gradient h { 8e-4, -5e-4, 2e-4, -1.1e-3 };
    const auto mesh = GENERATE(flexpm::MeshKind::fan, flexpm::MeshKind::refined);
    const std::uint64_t seed = GENERATE(1, 2, 3);
    auto options = specimens::options(contact);
    options.mesh = mesh;
    Assembly a = assemble(flexpm::cells_of_polygons(drawn_polygons(seed), false).tiling, options);
    hold_all(a);
    place_nodes(a, h, {});
    // on areas of the reference
    const auto nominal = flexpm::first_stress(
        h, flexpm::stress(flexpm::plane_stiffness(options.elastic[0]), flexpm::green_strain(h)));
    double longest = 0.0;
    for (int k = 0; k < a.contacts.count; ++k) {
        const Point edge = a.grains.reference_at(a.contacts.node(k, 0, 1))
            - a.grains.reference_at(a.contacts.node(k, 0, 0));
        const double length = flexpm::norm(edge);
        longest = std::max(longest, length);
        const Point n = (1.0 / length) * Point { edge.y, -edge.x };
        set_traction(
            a, k, { nominal.xx * n.x + nominal.xy * n.y, nominal.yx * n.x + nominal.yy * n.y });
    }
    const double scale = 20e6 * longest * specimens::thickness;
    for (const Motion& motion :
        { Motion {}, Motion { 0.0, { 2e-3, -1e-3 } }, Motion { 0.5, {} } }) {
        CAPTURE(motion.angle, motion.way.x);
        place_nodes(a, h, motion);
        run(a, 1);
        CHECK(largest_free_force(a) < 1e-10 * scale);
    }
}

TEST_CASE("Masses of drawn cells keep every mode below the limit")
{
    const double damping = 0.7, limit = 4.0 / (1.0 + damping) / flexpm::mass_margin;
    const auto mesh = GENERATE(flexpm::MeshKind::fan, flexpm::MeshKind::refined);
    auto options = specimens::options();
    options.mesh = mesh;
    for (const std::uint64_t seed : { 4u, 5u }) {
        Assembly a =
            assemble(flexpm::cells_of_polygons(drawn_polygons(seed), false).tiling, options);
        flexpm::scale_masses(a, damping);
        CHECK(dense::largest_eigenvalue(a) <= limit * (1.0 + 1e-12));
    }
}

TEST_CASE("Makers of cells tell which are whole Laguerre cells")
{
    const auto s = specimens::random_grains(15e-3, 15e-3, 3e-3, 6);
    for (int c = 0; c < s.cells.cells(); ++c)
        REQUIRE(s.cells.is_laguerre(c));
    const auto given = flexpm::cells_of_polygons(drawn_polygons(6), false).tiling.cells;
    for (int c = 0; c < given.cells(); ++c)
        REQUIRE_FALSE(given.is_laguerre(c));

    // a sawn cell has lost what lies outside
    const auto outline = flexpm::PolygonOutline::make(
        { { 1e-3, 1e-3 }, { 14e-3, 2e-3 }, { 13e-3, 14e-3 }, { 2e-3, 13e-3 } }, {});
    const auto sawn = flexpm::cells_in_outline(s.discs, outline, 0.0);
    std::set<int> on_rim;
    for (const auto& e : sawn.cells.boundary_edges)
        on_rim.insert(e.cell);
    for (int c = 0; c < sawn.cells.cells(); ++c)
        if (on_rim.count(c) > 0) CHECK_FALSE(sawn.cells.is_laguerre(c));
    CHECK(std::count(sawn.cells.laguerre.begin(), sawn.cells.laguerre.end(), 1) > 3);

    // a joint leaves a cell whole if it neither cuts it nor moves a corner of it
    int moved = 0;
    for (double height : { 4e-3, 7e-3, 11e-3 }) {
        const auto cut = flexpm::cut_by_joints(s.cells, s.discs, {},
            { { { { 0.0, height }, { 15e-3, height + 1e-3 } },
                0 } }).tiling;
        std::map<int, int> pieces;
        for (int origin : cut.origin)
            ++pieces[origin];
        for (int c = 0; c < cut.cells.cells(); ++c) {
            const auto corners = flexpm::cell_polygon(cut.cells, c);
            const auto before = flexpm::cell_polygon(s.cells, cut.origin[c]);
            const bool kept = std::all_of(before.begin(), before.end(), [&](Point p) {
                return std::any_of(corners.begin(), corners.end(),
                    [&](Point q) { return p.x == q.x && p.y == q.y; });
            });
            const bool is_piece = pieces[cut.origin[c]] > 1;
            CHECK(cut.cells.is_laguerre(c) == (kept && !is_piece));
            moved += !kept && !is_piece;
        }
        CHECK(cut.cells.cells() > s.cells.cells());
    }
    CHECK(moved > 0);
}
