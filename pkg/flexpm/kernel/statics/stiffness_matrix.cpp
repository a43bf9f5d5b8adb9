// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Stiffness of triangles, contact points and plates, term by term.
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <array>
#include <utility>
#include <vector>

namespace flexpm {

namespace {

void add_block(std::vector<StiffnessEntry>& entries, int row, int column, const StiffnessBlock& k)
{
    const int row_y = component(row, 1), column_y = component(column, 1);
    entries.push_back({ row, column, k.xx });
    entries.push_back({ row, column_y, k.xy });
    entries.push_back({ row_y, column, k.yx });
    entries.push_back({ row_y, column_y, k.yy });
}

void add_grain(const Grains& grains, int grain, std::vector<StiffnessEntry>& entries)
{
    const PlaneStiffness c = stiffness_of(grains, grain);
    for (int t = 0; t < triangles_of(grains, grain); ++t) {
        const auto n = triangle_nodes(grains, grain, t);
        const TriangleShape s = shape_of(grains, grain, t);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                add_block(entries, grains.node(grain, n[i]), grains.node(grain, n[j]),
                    stiffness_block(s, c, i, j));
            }
        }
    }
}

/// Springs along a normal and across it.
StiffnessBlock spring_block(Point n, double normal, double shear)
{
    const double cross = (normal - shear) * n.x * n.y;
    return { normal * n.x * n.x + shear * n.y * n.y, cross, cross,
        normal * n.y * n.y + shear * n.x * n.x };
}

/// Parts of the nodes of both edges in the relative motion of a point.
std::array<double, 4> parts_of(const Contacts& contacts, int contact, int point)
{
    const double wa = contacts.weight(contact, point, 0), wb = contacts.weight(contact, point, 1);
    return { wa - 1.0, -wa, 1.0 - wb, wb };
}

using Shares = std::array<std::array<double, 4>, 4>;

void add_shares(Shares& share, const std::array<double, 4>& part, double area)
{
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j)
            share[i][j] += area * part[i] * part[j];
    }
}

void add_blocks(const Assembly& a, int contact, const Shares& share, const StiffnessBlock& k,
    std::vector<StiffnessEntry>& entries)
{
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double s = share[i][j];
            add_block(entries, a.contacts.node(contact, i / 2, i % 2),
                a.contacts.node(contact, j / 2, j % 2), { s * k.xx, s * k.xy, s * k.yx, s * k.yy });
        }
    }
}

/// Springs k_n along the bonded normal and k_s across it, between the points of the two edges.
void add_contact(const Assembly& a, int contact, const PointSprings& springs,
    std::vector<StiffnessEntry>& entries)
{
    const Point n = bonded_normal(a, contact);
    Shares share = {};
    for (int p = 0; p < a.contacts.points_of(contact); ++p) {
        const double area = a.contacts.area(contact, p);
        add_shares(share, parts_of(a.contacts, contact, p), area);
        if (springs.empty()) continue;
        const PointSpring& k = springs[contact * a.contacts.group.points + p];
        if (k.normal != 0.0 || k.shear != 0.0)
            add_blocks(a, contact, share, spring_block(n, k.normal, k.shear), entries);
        share = {};
    }
    if (!springs.empty()) return;
    // alike points: one block for all
    const LawParameters& law = a.contacts.law_of(contact);
    add_blocks(
        a, contact, share, spring_block(n, law.normal_stiffness, law.shear_stiffness), entries);
}

/// Part of a node in what moves the spring of a machine behind a plate, and what turns the plate.
struct LagShare {
    int node;
    Point pull;  ///< force that lets the spring give, for a unit way [N/m]
    Point turn;  ///< moment about the seat [N]
};

/// How a soft plate answers to the ways of the nodes before it.
struct LagAnswer {
    std::vector<LagShare> shares;  ///< of all nodes
    double give, both, turn;       ///< inverse of the stiffness against its give and its turn
};

LagAnswer lag_answer(const Assembly& a, const Plate& plate)
{
    const bool gives = plate.machine_stiffness > 0.0;
    LagAnswer found {};
    double k = gives ? plate.machine_stiffness : 1.0, c = 0.0, m = 0.0;
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const Point n = in_plane(point_normal(plate, i));
        const double share = gives ? dot(plate.normal, n) : 0.0, arm = point_arm(plate, i).z;
        const auto nodes = a.facets.nodes(p.facet);
        const auto parts = facet_parts(p.weight);
        const Point t = tangent_of(n);  // friction of a jaw has a part along the plate's normal
        const double rubs = gives ? dot(in_plane(plate.normal), t) : 0.0;
        k += share * share * p.stiffness + rubs * rubs * p.shear_stiffness;
        c -= share * arm * p.stiffness;
        m += arm * arm * p.stiffness;
        for (int f = 0; f < facet_nodes; ++f) {
            const double part = parts[f] * p.stiffness;
            const Point shear = (parts[f] * p.shear_stiffness * rubs) * t;
            if (part != 0.0)
                found.shares.push_back({ nodes[f], part * share * n + shear, -part * arm * n });
        }
    }
    if (m == 0.0) m = 1.0;
    const double whole = k * m - c * c;
    found.give = m / whole;
    found.both = -c / whole;
    found.turn = k / whole;
    return found;
}

/// What the give and the turn of a soft plate take from the stiffness of its points: they couple
/// all of them.
void add_lag(const Assembly& a, const Plate& plate, std::vector<StiffnessEntry>& entries)
{
    const LagAnswer answer = lag_answer(a, plate);
    for (const LagShare& r : answer.shares) {
        const Point give = (-answer.give) * r.pull - answer.both * r.turn;
        const Point turn = (-answer.both) * r.pull - answer.turn * r.turn;
        for (const LagShare& c : answer.shares) {
            add_block(entries, r.node, c.node,
                { give.x * c.pull.x + turn.x * c.turn.x, give.x * c.pull.y + turn.x * c.turn.y,
                    give.y * c.pull.x + turn.y * c.turn.x, give.y * c.pull.y + turn.y * c.turn.y });
        }
    }
}

/// Springs of a plate's points to where the plate, or its crosshead, is.
void add_plate(const Assembly& a, const Plate& plate, const PointSprings* springs,
    std::vector<StiffnessEntry>& entries)
{
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const StiffnessBlock k =
            springs ? plate_springs(plate, i, (*springs)[i]) : plate_springs(plate, i);
        const auto n = a.facets.nodes(p.facet);
        const auto part = facet_parts(p.weight);
        for (int r = 0; r < facet_nodes; ++r) {
            for (int c = 0; c < facet_nodes; ++c) {
                const double s = part[r] * part[c];
                add_block(entries, n[r], n[c], { s * k.xx, s * k.xy, s * k.yx, s * k.yy });
            }
        }
    }
    if (is_soft(plate)) add_lag(a, plate, entries);
}

}  // namespace

StiffnessBlock plate_springs(const Plate& plate, int point)
{
    const EdgePoint p = edge_point(plate, point);
    return plate_springs(plate, point, { p.stiffness, p.shear_stiffness });
}

StiffnessBlock plate_springs(const Plate& plate, int point, const PointSpring& k)
{
    return spring_block(in_plane(point_normal(plate, point)), k.normal, k.shear);
}

PlateLag plate_lag(
    const Assembly& a, const Plate& plate, Vector displacement, const Array<double>* moved)
{
    if (!is_soft(plate)) return {};
    const LagAnswer answer = lag_answer(a, plate);
    double force = 0.0, moment = 0.0;
    for (const LagShare& s : answer.shares) {
        const Vector way = moved ? displacement - a.grains.vector_at(*moved, s.node) : displacement;
        force += dot(s.pull, way);
        moment += dot(s.turn, way);
    }
    return { answer.give * force + answer.both * moment,
        answer.both * force + answer.turn * moment };
}

Vector point_way(const Plate& plate, int point, Vector displacement, const PlateLag& lag)
{
    if (!is_soft(plate)) return displacement;
    return displacement - lag.give * plate.normal
        + lag.turn * point_arm(plate, point).z * point_normal(plate, point);
}

std::vector<StiffnessEntry> stiffness_entries(const Assembly& a, const GivenSprings& springs)
{
    std::vector<StiffnessEntry> entries;
    for (int g = 0; g < a.grains.count; ++g)
        add_grain(a.grains, g, entries);
    for (int c = 0; c < a.contacts.count; ++c)
        add_contact(a, c, springs.contacts, entries);
    for (std::size_t i = 0; i < a.plates.size(); ++i)
        add_plate(a, a.plates[i], springs.plates.empty() ? nullptr : &springs.plates[i], entries);
    return entries;
}

}  // namespace flexpm
