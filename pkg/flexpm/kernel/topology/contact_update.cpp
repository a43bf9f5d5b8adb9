// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/contact_update.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/crack_faces.hpp>
#include <flexpm/kernel/topology/joint_faces.hpp>
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
        a.area_of(std::min(touch.closest[0].edge_length, touch.closest[1].edge_length));
    const int centre_rows[] = { NodeRow::centre_a, NodeRow::centre_b };
    for (int side = 0; side < 2; ++side) {
        contacts.nodes[row_index(c, centre_rows[side], NodeRow::count)] =
            a.grains.centre_place(pair[side]);
    }
    const int points = contacts.points_of(c);
    for (int p = 0; p < points; ++p) {
        contacts.area(c, p) = area / points;
        contacts.crack_slip(c, p) = law::slip_to_residual(contacts.law_of(c));
    }
    contacts.set_branch(c,
        a.grains.reference_at(a.grains.centre(pair[1]))
            - a.grains.reference_at(a.grains.centre(pair[0])));
    contacts.set_normal(c, touch.normal);
}

/// Fill the rows of contact `c` between the parts of two faces.
void fill_face(Assembly& a, int c, const FaceContact& face)
{
    Contacts& contacts = a.contacts;
    const int centre_rows[] = { NodeRow::centre_a, NodeRow::centre_b };
    for (int side = 0; side < 2; ++side) {
        for (int corner = 0; corner < contacts.corners_of(c); ++corner)
            contacts.node(c, side, corner) = face.edges[side][corner];
        contacts.nodes[row_index(c, centre_rows[side], NodeRow::count)] =
            a.grains.centre_place(face.pair[side]);
        contacts.inverse_edge_length(c, side) = face.inverse_edge_length[side];
    }
    for (int p = 0; p < contacts.points_of(c); ++p) {
        const FaceContact::Place& point = face.points[p];
        for (int side = 0; side < 2; ++side)
            contacts.weight(c, p, side) = point.weight[side];
        contacts.area(c, p) = point.area;
        contacts.set_point_state(c, p, point.state);
        contacts.paired_slip(c, p) = point.state.slip;
        contacts.crack_slip(c, p) = point.crack_slip;
    }
    contacts.set_normal(c, face.normal);
}

/// A contact that begins: the touch of a pair, or one between faces.
struct NewContact {
    GrainPair pair;
    const FaceContact* face = nullptr;  ///< none: the discs touch
};

/// A contact once some have come and gone: one that was there before, or a new one.
struct Origin {
    static constexpr int is_new = -1;
    int contact;  ///< its number before, or is_new
    NewContact made;
};

/// All contacts that stay and all new ones, in the order of their pairs.
std::vector<Origin> origins(const Contacts& contacts, const std::vector<int>& ended,
    const std::vector<NewContact>& beginning)
{
    std::vector<Origin> order;
    for (int c = 0; c < contacts.count; ++c) {
        const bool ends = std::binary_search(ended.begin(), ended.end(), c);
        if (!ends || contacts.bonded[c]) order.push_back({ c, { contacts.pairs[c] } });
    }
    for (const NewContact& made : beginning)
        order.push_back({ Origin::is_new, made });
    std::stable_sort(order.begin(), order.end(),
        [](const Origin& i, const Origin& j) { return i.made.pair < j.made.pair; });
    return order;
}

/// Move the rows of all contacts into a new order; those of new ones become 0.
void move_rows(Contacts& contacts, const std::vector<Origin>& order)
{
    const int count = static_cast<int>(order.size());
    Contacts::visit_rows(contacts, [&](auto& values, int rows, auto index) {
        const auto old = values;
        values.assign(static_cast<std::size_t>(blocks_of(count)) * lanes * rows, 0);
        for (int c = 0; c < count; ++c) {
            if (order[c].contact == Origin::is_new) continue;
            for (int r = 0; r < rows; ++r)
                values[index(c, r, rows)] = old[index(order[c].contact, r, rows)];
        }
    });
}

/// Fill the rows of a contact that begins.
void fill_new(Assembly& a, int c, const NewContact& made)
{
    Contacts& contacts = a.contacts;
    for (int p = 0; p < contacts.points_of(c); ++p) {
        contacts.set_crack(c, p, {});
        take_strength(contacts, c, p);
    }
    if (made.face)
        fill_face(a, c, *made.face);
    else
        fill_touch(a, c, made.pair);
}

/// Bring all contacts into a new order, with new ones in their places.
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
        const auto& [from, made] = order[c];
        const auto& [pair, face] = made;
        const bool is_new = from == Origin::is_new;
        const int law = face ? face->law : a.grains.law_index(pair[0], pair[1]);
        contacts.pairs.push_back(pair);
        contacts.id.push_back(is_new ? contacts.next_id++ : old_id[from]);
        contacts.law.push_back(is_new ? law : old_law[from]);
        contacts.joint.push_back(!is_new ? old_joint[from] : face ? face->joint : -1);
        contacts.bonded.push_back(is_new ? 0 : old_bonded[from]);
        contacts.erased.push_back(is_new ? 0 : old_erased[from]);
        if (is_new) fill_new(a, c, made);
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
            PointCrack crack = contacts.crack(c, p);
            crack.mode = intact;
            contacts.set_crack(c, p, crack);
        }
    }
}

/// Stored and dissipated by the points of a contact [J].
struct ContactEnergy {
    double elastic = 0.0, damage = 0.0, friction = 0.0;
    double area = 0.0;  ///< [m^2]
};

ContactEnergy sum_energy(const Contacts& contacts, int contact)
{
    ContactEnergy sum;
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const double area = contacts.area(contact, p);
        const PointEnergy energy = energy_of(contacts, contact, p);
        sum.elastic += area * energy.elastic;
        sum.damage += area * energy.damage;
        sum.friction += area * energy.friction;
        sum.area += area;
    }
    return sum;
}

/// Keep in the balance what contacts that end have dissipated; what they store leaves as friction.
/// Point by point: sums in another order have other last digits, which the waiting for cracks makes
/// other results.
void keep_energy(Assembly& a, const std::vector<int>& ended)
{
    for (int c : ended) {
        for (int p = 0; p < a.contacts.points_of(c); ++p) {
            const double area = a.contacts.area(c, p);
            const PointEnergy energy = energy_of(a.contacts, c, p);
            a.ledger.removed_damage += area * energy.damage;
            a.ledger.removed_friction += area * (energy.friction + energy.elastic);
        }
    }
}

/// Raise masses where new contacts need it. The kinetic energy that this adds counts as initial
/// energy.
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

/// Take contacts out and put new ones in, and prepare the next step.
void replace(Assembly& a, const std::vector<int>& ended, const std::vector<NewContact>& beginning)
{
    keep_energy(a, ended);
    for (int c : ended)
        remove_contact(a.contacts, c);
    reorder(a, origins(a.contacts, ended, beginning));
    pad_contacts(a.contacts);
    prepare_step(a);
}

/// Let a contact act between other parts of the same faces: what it has dissipated stays with it.
void shift_contact(Assembly& a, const FaceContact& face)
{
    Contacts& contacts = a.contacts;
    const ContactEnergy before = sum_energy(contacts, face.contact);
    fill_face(a, face.contact, face);
    const ContactEnergy now = sum_energy(contacts, face.contact);
    for (int p = 0; p < contacts.points_of(face.contact); ++p) {
        set_dissipated(
            contacts, face.contact, p, before.damage / now.area, before.friction / now.area);
    }
    a.ledger.removed_friction += before.elastic - now.elastic;
}

}  // namespace

bool is_active(const Contacts& contacts, int contact)
{
    double area = 0.0;
    for (int p = 0; p < contacts.points_of(contact); ++p)
        area += contacts.area(contact, p);
    return area > 0.0;
}

Point between_centres(const Grains& grains, GrainPair pair)
{
    return grains.point_at(grains.centre(pair[1])) - grains.point_at(grains.centre(pair[0]));
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

bool is_apart(const Assembly& a, int contact)
{
    const GrainPair pair = a.contacts.pairs[contact];
    double limit = touching_distance(a, pair);
    if (a.contacts.bonded[contact]) {
        if (presses(a.contacts, contact)) return false;
        limit = std::max(limit, bonded_distance(a.grains, pair));
    }
    return centre_distance(a.grains, pair) > limit;
}

bool joins(const Assembly& a, int contact)
{
    return is_active(a.contacts, contact)
        && (!is_crack(a.contacts, contact) || !is_apart(a, contact));
}

bool has_ended(const Assembly& a, int contact)
{
    const Contacts& contacts = a.contacts;
    if (!is_active(contacts, contact)) return !contacts.bonded[contact];
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        if (damage_of(contacts, contact, p) < 1.0) return false;
    }
    if (contacts.joint[contact] >= 0) return false;  // follow_faces() ends it
    if (!is_apart(a, contact)) return contacts.bonded[contact] && has_parted(a, contact);
    const bool is_face = contacts.bonded[contact] && is_between_faces(contacts, contact);
    return !is_face || !is_watched(a, contact);
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

void renew_step(Assembly& a, double damping, double dt)
{
    pad_contacts(a.contacts);
    prepare_step(a);
    if (dt > 0.0) raise_masses(a, damping, dt);
}

bool follow_touches(Assembly& a, double damping, double dt)
{
    Contacts& contacts = a.contacts;
    bool moved = false;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.bonded[c] || contacts.joint[c] >= 0) continue;
        const TouchPoint touch = touch_point(a.grains, contacts.pairs[c]);
        if (!is_elsewhere(contacts, c, touch)) continue;
        attach(contacts, c, touch);
        moved = true;
    }
    if (moved) renew_step(a, damping, dt);
    return moved;
}

std::vector<GrainPair> follow_faces(Assembly& a, double damping, double dt)
{
    const FacePairing pairing = pair_faces(a);
    if (pairing.empty()) return {};
    std::vector<GrainPair> changed;
    std::vector<NewContact> beginning;
    for (int c : pairing.ended)
        changed.push_back(a.contacts.pairs[c]);
    for (const FaceContact& face : pairing.contacts) {
        changed.push_back(face.pair);
        if (face.contact == FaceContact::none)
            beginning.push_back({ face.pair, &face });
        else
            shift_contact(a, face);
    }
    const int first_new = a.contacts.next_id;
    replace(a, pairing.ended, beginning);
    if (dt > 0.0) raise_masses(a, damping, dt);
    for (int c = 0; c < a.contacts.count; ++c)
        if (a.contacts.id[c] >= first_new)
            a.ledger.removed_friction -= sum_energy(a.contacts, c).elastic;
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    return changed;
}

void change_contacts(Assembly& a, const std::vector<int>& ended,
    const std::vector<GrainPair>& touching, double damping, double dt)
{
    if (ended.empty() && touching.empty()) return;
    std::vector<NewContact> beginning;
    for (const GrainPair& pair : touching)
        beginning.push_back({ pair });
    replace(a, ended, beginning);
    if (!touching.empty() && dt > 0.0) raise_masses(a, damping, dt);
}

}  // namespace flexpm
