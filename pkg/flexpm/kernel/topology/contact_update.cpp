// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/contact_update.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/removal.hpp>
#include <flexpm/kernel/topology/touch_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexpm {

namespace {

/// Fill the rows of contact `c` for a pair whose discs touch.
void fill_touch(Assembly& a, int c, GrainPair pair)
{
    Contacts& contacts = a.contacts;
    const TouchPoint touch = touch_point(a.grains, pair);
    attach(contacts, c, touch);
    const double area =
        std::min(touch.closest[0].edge_length, touch.closest[1].edge_length) * a.thickness;
    const int centre_rows[] = { NodeRow::centre_a, NodeRow::centre_b };
    for (int side = 0; side < 2; ++side) {
        contacts.nodes[row_index(c, centre_rows[side], NodeRow::count)] =
            a.grains.centre_place(pair[side]);
    }
    const int points = contacts.points_of(c);
    for (int p = 0; p < points; ++p) {
        contacts.area(c, p) = area / points;
        contacts.crack_steps[contacts.point_index(c, p)] = -1;
        contacts.state(c, p, PointRow::shear_damage) = 1.0;
    }
    contacts.set_branch(c,
        vector_at(a.grains.reference, a.grains.centre(pair[1]))
            - vector_at(a.grains.reference, a.grains.centre(pair[0])));
    contacts.set_normal(c, touch.normal);
}

/// A contact once some have come and gone: one that was there before, or a new touch of a pair.
struct Origin {
    static constexpr int new_touch = -1;
    GrainPair pair;
    int contact;  ///< its number before, or new_touch
};

/// All contacts that stay and all new ones, in the order of their pairs.
std::vector<Origin> origins(
    const Contacts& contacts, const std::vector<int>& ended, const std::vector<GrainPair>& touching)
{
    std::vector<Origin> order;
    for (int c = 0; c < contacts.count; ++c) {
        const bool ends = std::binary_search(ended.begin(), ended.end(), c);
        if (!ends || contacts.bonded[c]) order.push_back({ contacts.pairs[c], c });
    }
    for (const GrainPair& pair : touching)
        order.push_back({ pair, Origin::new_touch });
    std::stable_sort(order.begin(), order.end(),
        [](const Origin& i, const Origin& j) { return i.pair < j.pair; });
    return order;
}

/// Move the rows of all contacts into a new order; those of new touches become 0.
void move_rows(Contacts& contacts, const std::vector<Origin>& order)
{
    const int count = static_cast<int>(order.size());
    Contacts::visit_rows(contacts, [&](auto& values, int rows, auto index) {
        const auto old = values;
        values.assign(static_cast<std::size_t>(blocks_of(count)) * lanes * rows, 0);
        for (int c = 0; c < count; ++c) {
            if (order[c].contact == Origin::new_touch) continue;
            for (int r = 0; r < rows; ++r)
                values[index(c, r, rows)] = old[index(order[c].contact, r, rows)];
        }
    });
}

/// Bring all contacts into a new order, with new touches in their places.
void reorder(Assembly& a, const std::vector<Origin>& order)
{
    Contacts& contacts = a.contacts;
    move_rows(contacts, order);
    const auto old_id = contacts.id;
    const auto old_law = contacts.law;
    const auto old_joint = contacts.joint;
    const auto old_bonded = contacts.bonded;
    const auto old_erased = contacts.erased;
    contacts.count = static_cast<int>(order.size());
    contacts.append_no_force();
    contacts.pairs.clear();
    contacts.id.clear();
    contacts.law.clear();
    contacts.joint.clear();
    contacts.bonded.clear();
    contacts.erased.clear();
    for (int c = 0; c < contacts.count; ++c) {
        const auto& [pair, from] = order[c];
        const bool is_new = from == Origin::new_touch;
        contacts.pairs.push_back(pair);
        contacts.id.push_back(is_new ? contacts.next_id++ : old_id[from]);
        contacts.law.push_back(is_new ? a.grains.law_index(pair[0], pair[1]) : old_law[from]);
        contacts.joint.push_back(is_new ? -1 : old_joint[from]);
        contacts.bonded.push_back(is_new ? 0 : old_bonded[from]);
        contacts.erased.push_back(is_new ? 0 : old_erased[from]);
        if (is_new) fill_touch(a, c, pair);
    }
}

/// Padded lanes repeat the last contact, without area.
void pad_contacts(Contacts& contacts)
{
    for (int c = contacts.count; c < contacts.blocks() * lanes; ++c) {
        Contacts::visit_rows(contacts, [&](auto& values, int rows, auto index) {
            for (int r = 0; r < rows; ++r)
                values[index(c, r, rows)] = values[index(contacts.count - 1, r, rows)];
        });
        for (int p = 0; p < contacts.points_of(c); ++p) {
            contacts.area(c, p) = 0.0;
            contacts.crack_modes[contacts.point_index(c, p)] = intact;
        }
    }
}

/// Keep in the balance what contacts that end have dissipated; what they store leaves as friction.
void keep_energy(Assembly& a, const std::vector<int>& ended)
{
    for (int c : ended) {
        for (int p = 0; p < a.contacts.points_of(c); ++p) {
            const double area = a.contacts.area(c, p);
            const PointState s = a.contacts.point_state(c, p);
            a.ledger.removed_damage += area * s.damage_energy;
            a.ledger.removed_friction +=
                area * (s.friction_energy + law::elastic_energy(a.contacts.law_of(c), s));
        }
    }
}

/// Raise masses where new contacts need it. The kinetic energy that this adds counts as initial energy.
void raise_masses(Assembly& a, double damping, double dt)
{
    Grains& grains = a.grains;
    const double before = kinetic_of_velocities(grains);
    const Array<double> nodes = grains.inverse_mass, rotations = grains.inverse_inertia;
    scale_masses(a, damping, dt);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        grains.inverse_mass[i] = std::min(grains.inverse_mass[i], nodes[i]);
    for (std::size_t i = 0; i < rotations.size(); ++i)
        grains.inverse_inertia[i] = std::min(grains.inverse_inertia[i], rotations[i]);
    a.ledger.initial += kinetic_of_velocities(grains) - before;
}

Point between_centres(const Grains& grains, GrainPair pair)
{
    return grains.position(grains.centre(pair[1])) - grains.position(grains.centre(pair[0]));
}

/// Whether the faces of a joint have slid past each other: no place of one lies opposite to the other.
bool has_slid_off(const Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const double slip = std::abs(contacts.state(contact, p, PointRow::slip));
        if (slip * std::abs(contacts.inverse_edge_length(contact, 0)) < 1.0) return false;
    }
    return true;
}

}  // namespace

bool is_active(const Contacts& contacts, int contact)
{
    double area = 0.0;
    for (int p = 0; p < contacts.points_of(contact); ++p)
        area += contacts.area(contact, p);
    return area > 0.0;
}

double square_distance(const Grains& grains, GrainPair pair)
{
    const Point d = between_centres(grains, pair);
    return dot(d, d);
}

double centre_distance(const Grains& grains, GrainPair pair)
{
    return norm(between_centres(grains, pair));
}

double touching_distance(const Assembly& a, GrainPair pair)
{
    const double radii = a.grains.radius[pair[0]] + a.grains.radius[pair[1]];
    const auto close = a.contacts.close_pairs.find(pair);
    return close == a.contacts.close_pairs.end() ? radii : std::min(radii, close->second);
}

bool is_touching(const Assembly& a, GrainPair pair)
{
    const double radii = a.grains.radius[pair[0]] + a.grains.radius[pair[1]];
    if (square_distance(a.grains, pair) >= radii * radii) return false;  // most, at little cost
    return centre_distance(a.grains, pair) < touching_distance(a, pair);
}

bool has_ended(const Assembly& a, int contact)
{
    const Contacts& contacts = a.contacts;
    if (!is_active(contacts, contact)) return !contacts.bonded[contact];
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        if (damage_of(contacts, contact, p) < 1.0) return false;
    }
    if (contacts.joint[contact] >= 0) return has_slid_off(contacts, contact);
    const GrainPair pair = contacts.pairs[contact];
    double limit = touching_distance(a, pair);
    if (contacts.bonded[contact]) limit = std::max(limit, norm(contacts.branch(contact)));
    return centre_distance(a.grains, pair) > limit;
}

std::vector<int> ended_contacts(const Assembly& a)
{
    const Contacts& contacts = a.contacts;
    std::vector<int> ended;
    for (int first = 0, next = 0; first < contacts.count; first = next) {
        while (next < contacts.count && contacts.pairs[next] == contacts.pairs[first])
            ++next;
        std::vector<int> of_pair;
        bool stays = false;
        for (int c = first; c < next; ++c) {
            if (has_ended(a, c))
                of_pair.push_back(c);
            else
                stays = stays || is_active(contacts, c);
        }
        if (!stays) ended.insert(ended.end(), of_pair.begin(), of_pair.end());
    }
    return ended;
}

bool follow_touches(Assembly& a, double damping, double dt)
{
    Contacts& contacts = a.contacts;
    bool moved = false;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.bonded[c]) continue;
        const TouchPoint touch = touch_point(a.grains, contacts.pairs[c]);
        if (!is_elsewhere(contacts, c, touch)) continue;
        attach(contacts, c, touch);
        moved = true;
    }
    if (!moved) return false;
    pad_contacts(contacts);
    prepare_step(a);
    if (dt > 0.0) raise_masses(a, damping, dt);
    return true;
}

void change_contacts(Assembly& a, const std::vector<int>& ended,
    const std::vector<GrainPair>& touching, double damping, double dt)
{
    if (ended.empty() && touching.empty()) return;
    keep_energy(a, ended);
    for (int c : ended)
        remove_contact(a.contacts, c);
    reorder(a, origins(a.contacts, ended, touching));
    pad_contacts(a.contacts);
    prepare_step(a);
    if (!touching.empty() && dt > 0.0) raise_masses(a, damping, dt);
}

}  // namespace flexpm
