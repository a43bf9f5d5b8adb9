// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts that come and go.
#include <flexpm/kernel/topology/contact_update.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/removal.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// A place on the outline of a grain: an edge and the share of its end.
struct Place {
    int node_0, node_1;
    double weight;
    double along;  ///< length of the edge along the tangent [m]
    double length;
};

Place nearest_place(const Assembly& a, int grain, Point x, Point tangent)
{
    const int corners = a.group(a.grain_slot[grain] / lanes).vertices;
    Place best {};
    double least = -1.0;
    for (int k = 0; k < corners; ++k) {
        const int n0 = a.node(grain, k), n1 = a.node(grain, (k + 1) % corners);
        const Point p0 = a.position(n0), p1 = a.position(n1);
        const double ex = p1.x - p0.x, ey = p1.y - p0.y, square = ex * ex + ey * ey;
        const double share = ((x.x - p0.x) * ex + (x.y - p0.y) * ey) / square;
        const double w = std::min(std::max(share, 0.0), 1.0);
        const double distance = std::hypot(p0.x + w * ex - x.x, p0.y + w * ey - x.y);
        if (least >= 0.0 && distance >= least) continue;
        least = distance;
        best = { n0, n1, w, ex * tangent.x + ey * tangent.y, std::sqrt(square) };
    }
    return best;
}

/// Where the two discs of a pair touch, on both grains.
struct Seat {
    Point normal;  ///< from the first grain to the second
    Place places[2];
};

Seat seat_of(const Assembly& a, GrainPair pair)
{
    const Point pa = a.position(a.centre(pair[0])), pb = a.position(a.centre(pair[1]));
    const double dx = pb.x - pa.x, dy = pb.y - pa.y, d = std::hypot(dx, dy);
    const Point normal { dx / d, dy / d }, tangent { -dy / d, dx / d };
    // Eq. 7 with d_v = 0
    const double reach = 0.5 * (d + a.radius[pair[0]] - a.radius[pair[1]]);
    const Point x { pa.x + reach * normal.x, pa.y + reach * normal.y };
    return { normal,
        { nearest_place(a, pair[0], x, tangent), nearest_place(a, pair[1], x, tangent) } };
}

/// Let contact `c` act where a seat says.
void sit(Assembly& a, int c, const Seat& seat)
{
    for (int side = 0; side < 2; ++side) {
        const Place& place = seat.places[side];
        a.contact_nodes[row_index(c, 2 * side, ContactRows::nodes)] = place.node_0;
        a.contact_nodes[row_index(c, 2 * side + 1, ContactRows::nodes)] = place.node_1;
        // an edge across the tangent cannot carry the gap's couple
        const bool facing = std::fabs(place.along) > 0.5 * place.length;
        a.edge_reach[row_index(c, side, 2)] = facing ? 1.0 / place.along : 0.0;
        for (int p = 0; p < a.points; ++p) {
            a.weight[row_index(c, 2 * p + side, 2 * a.points)] = place.weight;
        }
    }
}

/// Contact `c` acts elsewhere than a seat says, by more than a small part of an edge.
bool has_left(const Assembly& a, int c, const Seat& seat)
{
    for (int side = 0; side < 2; ++side) {
        const Place& place = seat.places[side];
        const double weight = a.weight[row_index(c, side, 2 * a.points)];
        if (a.contact_nodes[row_index(c, 2 * side, ContactRows::nodes)] != place.node_0
            || std::fabs(weight - place.weight) > 0.05) {
            return true;
        }
    }
    return false;
}

/// Fill the rows of contact `c` for a pair whose discs touch.
void fill_touch(Assembly& a, int c, GrainPair pair)
{
    const Seat seat = seat_of(a, pair);
    const int centres[] = { a.centre(pair[0]), a.centre(pair[1]) };
    sit(a, c, seat);
    const double area = std::min(seat.places[0].length, seat.places[1].length) * a.thickness;
    for (int side = 0; side < 2; ++side) {
        a.contact_nodes[row_index(c, 4 + side, ContactRows::nodes)] = a.centre_slot(pair[side]);
    }
    for (int p = 0; p < a.points; ++p) {
        a.area[row_index(c, p, a.points)] = area / a.points;
        a.crack_step[row_index(c, p, a.points)] = -1;
        a.point_state[row_index(c, p * ContactRows::state + ContactRows::shear_damage,
            a.points * ContactRows::state)] = 1.0;
    }
    a.span[row_index(c, 0, 2)] = a.reference[centres[1]] - a.reference[centres[0]];
    a.span[row_index(c, 1, 2)] = a.reference[centres[1] + lanes] - a.reference[centres[0] + lanes];
    a.normal[row_index(c, 0, 2)] = seat.normal.x;
    a.normal[row_index(c, 1, 2)] = seat.normal.y;
}

/// Where each contact of the new order comes from: an old contact, or -1 - index of a touching pair.
std::vector<int> new_order(
    const Assembly& a, const std::vector<int>& over, const std::vector<GrainPair>& touching)
{
    std::vector<int> order;
    for (int c = 0; c < a.contacts; ++c) {
        const bool ends = std::binary_search(over.begin(), over.end(), c);
        if (!ends || a.contact_bonded[c]) order.push_back(c);
    }
    for (std::size_t i = 0; i < touching.size(); ++i)
        order.push_back(-1 - static_cast<int>(i));
    const auto pair_of = [&](int from) {
        return from >= 0 ? GrainPair { a.contact_grains[2 * from], a.contact_grains[2 * from + 1] }
                         : touching[-1 - from];
    };
    std::stable_sort(
        order.begin(), order.end(), [&](int i, int j) { return pair_of(i) < pair_of(j); });
    return order;
}

/// Move the rows of all contact arrays into the new order; those of touching pairs become 0.
void move_rows(Assembly& a, const std::vector<int>& order)
{
    const int count = static_cast<int>(order.size());
    visit_contact_rows(a, [&](auto& values, int rows, auto index) {
        auto moved = values;
        moved.assign(static_cast<std::size_t>((count + lanes - 1) / lanes * lanes) * rows, 0);
        for (int c = 0; c < count; ++c) {
            for (int r = 0; order[c] >= 0 && r < rows; ++r) {
                moved[index(c, r, rows)] = values[index(order[c], r, rows)];
            }
        }
        values = std::move(moved);
    });
}

/// Padded lanes repeat the last contact, without area.
void pad_contacts(Assembly& a)
{
    for (int c = a.contacts; c < a.contact_blocks() * lanes; ++c) {
        visit_contact_rows(a, [&](auto& values, int rows, auto index) {
            for (int r = 0; r < rows; ++r) {
                values[index(c, r, rows)] = values[index(a.contacts - 1, r, rows)];
            }
        });
        for (int p = 0; p < a.points; ++p) {
            a.area[row_index(c, p, a.points)] = 0.0;
            a.crack_mode[row_index(c, p, a.points)] = intact;
        }
    }
}

/// What contacts that end have dissipated stays in the books; what they store leaves as friction.
void book_removed(Assembly& a, const std::vector<int>& over)
{
    for (int c : over) {
        for (int p = 0; p < a.points; ++p) {
            const double area = a.area[row_index(c, p, a.points)];
            const PointState s = point_state(a, c, p);
            a.past_damage += area * s.damage_energy;
            a.past_friction +=
                area * (s.friction_energy + law::elastic_energy(a.laws[a.contact_law[c]], s));
        }
    }
}

/// Kinetic energy that the assembly gains as `change` raises masses is booked as initial energy.
template <class Change> void book_kinetic_change(Assembly& a, Change change)
{
    const double before = kinetic_of_velocities(a);
    change();
    a.initial_energy += kinetic_of_velocities(a) - before;
}

void raise_masses(Assembly& a, double damping, double dt)
{
    const Array<double> nodes = a.inverse_mass, grains = a.inverse_inertia;
    scale_masses(a, damping, dt);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        a.inverse_mass[i] = std::min(a.inverse_mass[i], nodes[i]);
    }
    for (std::size_t i = 0; i < grains.size(); ++i) {
        a.inverse_inertia[i] = std::min(a.inverse_inertia[i], grains[i]);
    }
}

}  // namespace

bool carries(const Assembly& a, int contact)
{
    double area = 0.0;
    for (int p = 0; p < a.points; ++p)
        area += a.area[row_index(contact, p, a.points)];
    return area > 0.0;
}

double square_distance(const Assembly& a, GrainPair pair)
{
    const Point pa = a.position(a.centre(pair[0])), pb = a.position(a.centre(pair[1]));
    return (pb.x - pa.x) * (pb.x - pa.x) + (pb.y - pa.y) * (pb.y - pa.y);
}

double centre_distance(const Assembly& a, int grain_a, int grain_b)
{
    const Point pa = a.position(a.centre(grain_a)), pb = a.position(a.centre(grain_b));
    return std::hypot(pb.x - pa.x, pb.y - pa.y);
}

double touching_distance(const Assembly& a, GrainPair pair)
{
    const double radii = a.radius[pair[0]] + a.radius[pair[1]];
    const auto close = a.close_pairs.find({ pair[0], pair[1] });
    return close == a.close_pairs.end() ? radii : std::min(radii, close->second);
}

bool is_touching(const Assembly& a, GrainPair pair)
{
    const double radii = a.radius[pair[0]] + a.radius[pair[1]];
    if (square_distance(a, pair) >= radii * radii) return false;  // most pairs, at little cost
    return centre_distance(a, pair[0], pair[1]) < touching_distance(a, pair);
}

bool is_over(const Assembly& a, int contact)
{
    if (!carries(a, contact)) return !a.contact_bonded[contact];
    for (int p = 0; p < a.points; ++p) {
        if (damage_of(a, contact, p) < 1.0) return false;
    }
    const int ga = a.contact_grains[2 * contact], gb = a.contact_grains[2 * contact + 1];
    double limit = touching_distance(a, { ga, gb });
    if (a.contact_bonded[contact]) {
        limit = std::max(
            limit, std::hypot(a.span[row_index(contact, 0, 2)], a.span[row_index(contact, 1, 2)]));
    }
    return centre_distance(a, ga, gb) > limit;
}

bool follow_touches(Assembly& a, double damping, double dt)
{
    bool moved = false;
    for (int c = 0; c < a.contacts; ++c) {
        if (a.contact_bonded[c] || !carries(a, c)) continue;
        const Seat seat = seat_of(a, { a.contact_grains[2 * c], a.contact_grains[2 * c + 1] });
        if (!has_left(a, c, seat)) continue;
        sit(a, c, seat);
        moved = true;
    }
    if (!moved) return false;
    pad_contacts(a);
    prepare_step(a);
    if (dt > 0.0) book_kinetic_change(a, [&] { raise_masses(a, damping, dt); });
    return true;
}

void change_contacts(Assembly& a, const std::vector<int>& over,
    const std::vector<GrainPair>& touching, double damping, double dt)
{
    if (over.empty() && touching.empty()) return;
    book_removed(a, over);
    for (int c : over)
        retire_contact(a, c);
    const std::vector<int> order = new_order(a, over, touching);
    move_rows(a, order);
    const auto old_grains = a.contact_grains;
    const auto old_law = a.contact_law;
    const auto old_bonded = a.contact_bonded;
    a.contacts = static_cast<int>(order.size());
    a.contact_grains.clear();
    a.contact_law.clear();
    a.contact_bonded.clear();
    const int materials = static_cast<int>(a.elastic.size());
    for (int c = 0; c < a.contacts; ++c) {
        const int from = order[c];
        const GrainPair pair = from >= 0
            ? GrainPair { old_grains[2 * from], old_grains[2 * from + 1] }
            : touching[-1 - from];
        a.contact_grains.insert(a.contact_grains.end(), pair.begin(), pair.end());
        a.contact_law.push_back(from >= 0
                ? old_law[from]
                : a.grain_material[pair[0]] * materials + a.grain_material[pair[1]]);
        a.contact_bonded.push_back(from >= 0 ? old_bonded[from] : 0);
        if (from < 0) fill_touch(a, c, pair);
    }
    pad_contacts(a);
    prepare_step(a);
    if (!touching.empty() && dt > 0.0) {
        book_kinetic_change(a, [&] { raise_masses(a, damping, dt); });
    }
}

}  // namespace flexpm
