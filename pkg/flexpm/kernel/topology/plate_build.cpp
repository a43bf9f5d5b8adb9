// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates find the facets they may touch and where these begin to.
#include <flexpm/kernel/topology/plate_build.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/plate_lay.hpp>
#include <flexpm/kernel/step/step_plan.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace flexpm {

namespace {

/// Make facets of the edges that grains share, too; they lie on no side.
void list_inner_facets(Assembly& a)
{
    std::set<int> known;  // first nodes
    for (int e = 0; e < a.facets.count; ++e)
        known.insert(a.facets.nodes(e)[0]);
    for (int g = 0; g < a.grains.count; ++g) {
        const int corners = a.grains.vertices_of(g);
        for (int k = 0; k < corners; ++k) {
            if (known.count(a.grains.node(g, k)) != 0) continue;
            const int e = a.facets.count++;
            a.facets.grain.push_back(g);
            a.facets.side.push_back(-1);
            a.facets.pressure.push_back(0.0);
            a.facets.resize_rows();
            a.facets.set_nodes(e, { a.grains.node(g, k), a.grains.node(g, (k + 1) % corners) });
        }
    }
    prepare_step(a);
}

double middle_of(const Assembly& a, int facet, Point direction)
{
    const FacetPlace place = facet_place(a, facet);
    return 0.5 * (along(direction, place.start) + along(direction, place.end));
}

/// Facets of one plate each, divided where joints end between two of them: a plate across a joint
/// would press on one of the blocks alone.
std::vector<std::vector<int>> divided_at_joints(const Assembly& a,
    const std::vector<std::vector<int>>& whole, const std::set<GrainPair>& jointed, Point direction)
{
    std::vector<std::vector<int>> parts;
    for (std::vector<int> facets : whole) {
        std::sort(facets.begin(), facets.end(),
            [&](int e, int f) { return middle_of(a, e, direction) < middle_of(a, f, direction); });
        parts.emplace_back();
        for (int e : facets) {
            if (!parts.back().empty()) {
                const auto [one, other] =
                    std::minmax(a.facets.grain[parts.back().back()], a.facets.grain[e]);
                if (jointed.count({ one, other }) != 0) parts.emplace_back();
            }
            parts.back().push_back(e);
        }
    }
    return parts;
}

/// Pairs of grains with a joint between them.
std::set<GrainPair> jointed_pairs(const Contacts& contacts)
{
    std::set<GrainPair> pairs;
    for (int c = 0; c < contacts.count; ++c)
        if (contacts.joint[c] >= 0) pairs.insert(contacts.pairs[c]);
    return pairs;
}

std::vector<Plate> side_plates(const Assembly& a, int side, int pieces, const PlateContact& contact)
{
    if (pieces < 1) refuse("plates on a side", pieces, "", "must be at least 1");
    require_side(a, side);
    std::vector<int> facets;
    for (int e = 0; e < a.facets.count; ++e) {
        if (is_on_side(a, e, side)) facets.push_back(e);
    }
    if (facets.empty()) refuse("edges of a side", 0.0, "", "must be at least 1; all are erased");
    const Point normal = facet_place(a, facets.front()).normal();
    const Point direction = tangent_of(normal);
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (int e : facets) {
        for (Point p : { facet_place(a, e).start, facet_place(a, e).end }) {
            first = std::min(first, along(direction, p));
            last = std::max(last, along(direction, p));
        }
    }
    const double width = (last - first) / pieces;
    std::vector<std::vector<int>> groups(pieces);
    for (int e : facets) {
        const double middle = middle_of(a, e, direction) - first;
        groups[std::clamp(static_cast<int>(middle / width), 0, pieces - 1)].push_back(e);
    }
    if (std::any_of(groups.begin(), groups.end(), [](const auto& one) { return one.empty(); }))
        refuse("plates on a side", pieces, "",
            "must be fewer: a plate has no edge; give a smaller number");
    const std::set<GrainPair> jointed = jointed_pairs(a.contacts);
    const bool in_blocks = pieces > 1 && !jointed.empty();
    if (in_blocks) groups = divided_at_joints(a, groups, jointed, direction);
    std::vector<Plate> plates;
    for (const std::vector<int>& group : groups) {
        Plate p = plate_of(a, normal, contact);
        p.side = side;
        p.width = width;
        p.position = facet_place(a, facets.front()).start;
        if (in_blocks) {  // each block bears the pressure on its own edges
            p.width = 0.0;
            for (int e : group) {
                const FacetPlace facet = facet_place(a, e);
                p.width += std::fabs(along(direction, facet.end - facet.start));
            }
        }
        lay_on_edges(a, p, group, points_on(a, group));
        centre_position(a, p);
        seat(a, p);
        plates.push_back(p);
    }
    return plates;
}

}  // namespace

std::vector<int> add_side_plates(Assembly& a, int side, int pieces, const PlateContact& contact)
{
    return add_plates(a, side_plates(a, side, pieces, contact));
}

int find_side_plate(const Assembly& a, int side, const PlateContact& contact)
{
    return find_alike(a.plates, side_plates(a, side, 1, contact).front());
}

int add_touching_plate(Assembly& a, Point normal, const PlateContact& contact)
{
    Plate p = plate_of(a, unit(normal), contact);
    double nearest = std::numeric_limits<double>::infinity();
    std::vector<int> facets;
    for (int e = 0; e < a.facets.count; ++e) {
        const FacetPlace facet = facet_place(a, e);
        const bool outer = a.facets.side[e] >= 0;
        if (outer && along(p.normal, facet.normal()) > facing) facets.push_back(e);
    }
    if (facets.empty())
        refuse("plate", 0, "", "no boundary edge faces it; let its normal point inwards");
    const TouchAt points = points_on(a, facets);
    for (int e : facets) {
        const FacetPlace facet = facet_place(a, e);
        for (double weight : weights_of(points)) {
            const Point x = facet.at(weight);
            if (along(p.normal, x) < nearest) p.position = x;
            nearest = std::min(nearest, along(p.normal, x));
        }
    }
    lay_on_edges(a, p, facets, points);
    a.plates.push_back(p);
    return static_cast<int>(a.plates.size()) - 1;
}

void fix_tangential(Assembly& a, int plate)
{
    require_plate(a, plate);
    const Plate& p = a.plates[plate];
    if (p.points.empty())
        refuse("edges at the plate", 0.0, "", "must be at least 1; all are erased");
    const auto first = std::min_element(p.points.begin(), p.points.end(),
        [](const PlatePoint& one, const PlatePoint& other) { return one.gap < other.gap; });
    const int facet = first->facet, grain = a.facets.grain[facet];
    const int node = a.grains.is_rigid(grain) ? a.grains.centre(grain)
                                              : a.facets.nodes(facet)[first->weights[1] > 0.5];
    const int axis = std::fabs(p.normal.y) > std::fabs(p.normal.x) ? 0 : 1;
    a.grains.prescribed[a.grains.component(node, axis)] = 1;
    a.grains.velocity[a.grains.component(node, axis)] = 0.0;
}

int add_wall(Assembly& a, Point position, Point normal, const PlateContact& contact)
{
    Plate p = plate_of(a, unit(normal), contact);
    p.position = position;
    list_inner_facets(a);
    std::vector<int> facets(a.facets.count);
    std::iota(facets.begin(), facets.end(), 0);
    lay_on_edges(a, p, facets, TouchAt::ends);  // rigid grains, too, rest on their corners
    const double least = least_gap(p);
    if (!(least >= 0.0)) refuse("gap between wall and grains", least, "m", "must not be below 0");
    a.plates.push_back(p);
    return static_cast<int>(a.plates.size()) - 1;
}

}  // namespace flexpm
