// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Faces, sections and values by which a window shows solids, against volumes, areas and
/// numbers that must come out. SI units, tension positive.
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/view/grain_values.hpp>
#include <flexpm/kernel/view/solid_faces.hpp>

#include "support/catch.hpp"

#include "support/solid_states.hpp"

#include <numeric>
#include <set>

using namespace solid_states;

namespace {

SolidState sample(bool rigid = false)
{
    const Packing p = box(60, 3);
    return make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
}

/// Upper corner of the box.
Vector corner_of(const SolidState& s) { return extent_of(s.grains).high; }

/// Area vector of a polygon.
Vector area_of(const Polygon& polygon)
{
    Vector sum;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        sum = sum + 0.5 * cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
    return sum;
}

/// Six times the volume between a polygon and the origin.
double cone_of(const Polygon& polygon)
{
    double sum = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        sum += triple(polygon[0], polygon[k], polygon[k + 1]);
    return sum;
}

/// Volume of all grains in front of a plane: by what is drawn of their surfaces, and the area of
/// the section, which closes them.
double drawn_volume(const SolidState& s, const CutPlane& plane)
{
    const auto edges = polyhedron_edges(s);
    double cones = 0.0, area = 0.0;
    for (int g = 0; g < s.grains.count; ++g) {
        const GrainFaces faces = grain_faces(s, g, edges[g], 1.0, plane);
        for (const Polygon& face : faces.outside)
            cones += cone_of(face);
        for (const Polygon& face : faces.section)
            area += dot(area_of(face), plane.normal);
    }
    return cones / 6.0 + plane.offset * area / 3.0;
}

/// Crack all points of a contact.
void crack(SolidState& s, int contact)
{
    for (int p = 0; p < s.contacts.points_of(contact); ++p)
        s.contacts.set_state(
            contact, p, FaceRow::max_opening, 2.0 * s.contacts.law_of(contact).critical_opening);
}

}  // namespace

TEST_CASE("A plane parts what is drawn of a solid into two volumes", "[view][solids]")
{
    for (const bool rigid : { false, true }) {
        const SolidState s = sample(rigid);
        const Vector top = corner_of(s);
        const double whole = top.x * top.y * top.z;
        CHECK(drawn_volume(s, {}) == Approx(whole).epsilon(1e-9));
        const Vector leaning = (1.0 / 3.0) * Vector { 1.0, 2.0, 2.0 };
        const double offset = 0.5 * dot(leaning, top);
        CHECK(drawn_volume(s, { leaning, offset }) == Approx(0.5 * whole).epsilon(1e-9));
        CHECK(drawn_volume(s, { { 0.0, 0.0, 1.0 }, 0.3 * top.z })
            == Approx(0.3 * whole).epsilon(1e-9));
        CHECK(drawn_volume(s, { { 0.0, 0.0, 1.0 }, -top.z }) == 0.0);
    }
}

TEST_CASE("The section of a box has its area, and its rim is drawn", "[view][solids]")
{
    const SolidState s = sample();
    const Vector top = corner_of(s);
    const CutPlane plane { { 0.0, 1.0, 0.0 }, 0.37 * top.y };
    const auto edges = polyhedron_edges(s);
    double area = 0.0, rim = 0.0;
    for (int g = 0; g < s.grains.count; ++g) {
        const GrainFaces faces = grain_faces(s, g, edges[g], 1.0, plane);
        for (const Polygon& face : faces.section)
            area += norm(area_of(face));
        for (const Segment& line : faces.lines) {
            CHECK(plane.beyond(line[0]) < 1e-12);
            CHECK(plane.beyond(line[1]) < 1e-12);
            const auto on = [&](Vector p) {
                const bool side =
                    p.x < 1e-12 || p.x > top.x - 1e-12 || p.z < 1e-12 || p.z > top.z - 1e-12;
                return side && std::fabs(plane.beyond(p)) < 1e-12;
            };
            const Vector middle = 0.5 * (line[0] + line[1]);
            if (on(middle)) rim += norm(line[1] - line[0]);
        }
    }
    CHECK(area == Approx(top.x * top.z).epsilon(1e-9));
    CHECK(rim == Approx(2.0 * (top.x + top.z)).epsilon(1e-9));
}

TEST_CASE("Edges are those of polyhedra: corners less edges plus faces are two", "[view][solids]")
{
    const SolidState s = sample();
    std::vector<int> faces(s.grains.count);
    for (int c = 0; c < s.contacts.count; ++c)
        for (int grain : s.contacts.pairs[c])
            ++faces[grain];
    std::set<std::array<int, 2>> walls;
    for (std::size_t t = 0; t < s.surface.grain.size(); ++t)
        walls.insert({ s.surface.grain[t], s.surface.side[t] });
    for (const auto& wall : walls)
        ++faces[wall[0]];
    const auto edges = polyhedron_edges(s);
    for (int g = 0; g < s.grains.count; ++g) {
        CAPTURE(g);
        CHECK(s.grains.vertices_of(g) - static_cast<int>(edges[g].size()) + faces[g] == 2);
    }
}

TEST_CASE("Displacements are drawn larger", "[view][solids]")
{
    SolidState s = sample();
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        set_space_vector(
            s.grains.displacement, node, 1e-3 * space_vector(s.grains.reference, node));
    });
    const auto edges = polyhedron_edges(s);
    double once = 0.0, more = 0.0;
    for (const Polygon& face : grain_faces(s, 7, edges[7], 0.0, {}).outside)
        once += cone_of(face);
    for (const Polygon& face : grain_faces(s, 7, edges[7], 500.0, {}).outside)
        more += cone_of(face);
    CHECK(more == Approx(std::pow(1.5, 3) * once).epsilon(1e-12));
}

TEST_CASE("The points of a face share it by their areas", "[view][solids]")
{
    const SolidState s = sample();
    for (int c = 0; c < s.contacts.count; ++c) {
        const FaceGroup& group = s.contacts.group_of(c);
        const double area = norm(area_of(middle_face(s, c)));
        double sum = 0.0;
        Vector sum_vector;
        for (int p = 0; p < group.points; ++p)
            for (const Polygon& part : point_part(s, c, p, 1.0)) {
                sum += norm(area_of(part));
                sum_vector = sum_vector + area_of(part);
            }
        CAPTURE(c);
        if (group.points != group.corners + 1 || group.at_corners == 0) continue;
        CHECK(sum == Approx(area).epsilon(0.05));  // faces are slightly bent
        const Polygon inner = point_part(s, c, group.points - 1, 1.0).front();
        CHECK(norm(area_of(inner)) / area
            == Approx(s.contacts.area(c, group.points - 1) / contact_area(s.contacts, c))
                   .epsilon(1e-9));
    }
}

TEST_CASE("The rims of cracks on the surface are the lines between its grains", "[view][solids]")
{
    const SolidState s = sample();
    const auto outer = surface_nodes(s);
    const Vector top = corner_of(s);
    const auto on_wall = [&](Vector p) {
        const double least = std::min({ p.x, p.y, p.z, top.x - p.x, top.y - p.y, top.z - p.z });
        return least < 1e-9;
    };
    int lines = 0, inner = 0;
    double length = 0.0;
    for (int c = 0; c < s.contacts.count; ++c)
        for (int p = 0; p < s.contacts.points_of(c); ++p)
            for (const Segment& line : point_rim(s, c, p, 1.0, outer)) {
                ++lines;
                length += norm(line[1] - line[0]);
                inner += !on_wall(line[0]);
            }
    CHECK(lines > 100);
    CHECK(inner == 0);
    // both halves of each edge
    double walls = 0.0;
    for (int c = 0; c < s.contacts.count; ++c)
        for (int k = 0; k < s.contacts.corners_of(c); ++k) {
            const int a = s.contacts.node(c, 0, k);
            const int b = s.contacts.node(c, 0, (k + 1) % s.contacts.corners_of(c));
            const bool both = outer[s.grains.scalar_index(a)] && outer[s.grains.scalar_index(b)];
            if (both && s.contacts.group_of(c).at_corners > 0)
                walls += norm(s.grains.position(a) - s.grains.position(b));
        }
    CHECK(length == Approx(walls).epsilon(1e-12));
}

TEST_CASE("Values of solids are those of their strain, cracks and fragments", "[view][solids]")
{
    SolidState s = sample();
    constexpr double strain = 1e-6;
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        set_space_vector(s.grains.displacement, node,
            { 0.0, 0.0, strain * space_vector(s.grains.reference, node).z });
    });
    const PlaneStiffness c = solid_stiffness(s.grains.elastic[0]);
    for (double stress : grain_values(s, GrainValue::stress_zz))
        CHECK(stress == Approx(c.normal * strain).epsilon(1e-5));
    for (double stress : grain_values(s, GrainValue::stress_xx))
        CHECK(stress == Approx(c.cross * strain).epsilon(1e-5));
    for (double stress : grain_values(s, GrainValue::stress_xy))
        CHECK(std::fabs(stress) < 1e-6 * c.normal * strain);
    const auto ways = grain_values(s, GrainValue::displacement);
    const Vector centre = space_vector(s.grains.reference, s.grains.centre(5));
    CHECK(ways[5] == Approx(strain * centre.z).epsilon(1e-12));

    const auto before = grain_values(s, GrainValue::fragment);
    CHECK(*std::max_element(before.begin(), before.end()) == 0.0);
    int points = 0, cracked = 0;
    for (int k = 0; k < s.contacts.count; ++k) {
        const auto [a, b] = s.contacts.pairs[k];
        if (a == 5 || b == 5) crack(s, k);
        if (a == 6 || b == 6) points += s.contacts.points_of(k);
        if ((a == 5 && b == 6) || (a == 6 && b == 5)) cracked += s.contacts.points_of(k);
    }
    const auto after = grain_values(s, GrainValue::fragment);
    CHECK(after[5] == 1.0);
    CHECK(std::accumulate(after.begin(), after.end(), 0.0) == 1.0);
    const auto damage = grain_values(s, GrainValue::damage);
    CHECK(damage[5] == 1.0);
    CHECK(damage[6] == Approx(static_cast<double>(cracked) / points));
}

TEST_CASE("Grains of the plane have no values of space", "[view][solids]")
{
    CHECK(grain_value("stress_zz", 3) == GrainValue::stress_zz);
    CHECK(grain_value("fragment", 3) == GrainValue::fragment);
    CHECK_FALSE(grain_value("stress_zz"));
    CHECK(scale_title(GrainValue::stress_yz) == "stress yz [MPa]");
}
