// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/crack_faces.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/fem/edge_points.hpp>
#include <flexpm/kernel/plane_lanes/bond_faces.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

// parts of the sum of two radii: how near faces are
constexpr double kept_within = 0.2;
constexpr double found_within = 0.15;
constexpr double largest_turn =
    0.1;                       // of the normal of a contact that bears something, at once [rad]
constexpr double again = 0.9;  // of the limits of facing: a crack that acts again

Point between_bonded_centres(const Grains& grains, GrainPair pair)
{
    return vector_at(grains.reference, grains.centre(pair[1]))
        - vector_at(grains.reference, grains.centre(pair[0]));
}

double elastic_energy(const Contacts& contacts, int contact)
{
    double sum = 0.0;
    for (int p = 0; p < contacts.points_of(contact); ++p)
        sum += contacts.area(contact, p) * energy_of(contacts, contact, p).elastic;
    return sum;
}

Point unit_along(Point p) { return (1.0 / norm(p)) * p; }

Point turned(Point p, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return { c * p.x - s * p.y, s * p.x + c * p.y };
}

/// State of a point that bears nothing, at its place between the faces. Where these lie on each
/// other already it begins to bear there.
PointState open_state(PointState s, const LawParameters& law, Point apart, Point normal)
{
    s.shear_traction = 0.0;
    s.slip = dot(apart, tangent_of(normal));
    s.opening = std::max(dot(apart, normal), 0.0) + law::dilated(law, s.slip, 0.0);
    s.max_opening = std::max(s.max_opening, law::gap(law, s));
    return s;
}

/// State of a point whose traction, a vector, goes over from one normal to another. It falls where
/// it would store more.
PointState turned_state(PointState s, const LawParameters& law, Point from, Point to)
{
    const double before = law::elastic_energy(law, s);
    const Point traction =
        (law.normal_stiffness * law::gap(law, s)) * from + s.shear_traction * tangent_of(from);
    const double normal = std::min(dot(traction, to), 0.0);
    const double shear = normal < 0.0 ? dot(traction, tangent_of(to)) : 0.0;
    const double stored =
        0.5 * normal * normal / law.normal_stiffness + 0.5 * shear * shear / law.shear_stiffness;
    const double part = stored > before ? std::sqrt(before / stored) : 1.0;
    s.shear_traction = part * shear;
    s.opening = part * normal / law.normal_stiffness + law::dilated(law, s.slip, s.shear_traction);
    return s;
}

/// The vector between the two places of a point.
Point apart_at(const Contacts& contacts, int contact, int point, const BondFaces& faces)
{
    return faces.apart(contacts.weight(contact, point, 0), contacts.weight(contact, point, 1));
}

/// Whether a place on the faces of a crack, or the discs, are less than a part of both radii from
/// touching, or the centres from where they were bonded.
bool is_near(const Assembly& a, int contact, const BondFaces& faces, double part)
{
    const GrainPair pair = a.contacts.pairs[contact];
    const double radii = a.grains.radius[pair[0]] + a.grains.radius[pair[1]];
    const double margin = part * radii;
    if (centre_distance(a.grains, pair)
        < std::max(radii, bonded_distance(a.grains, pair)) + margin) {
        return true;
    }
    for (int p = 0; p < a.contacts.points_of(contact); ++p)
        if (dot(apart_at(a.contacts, contact, p, faces), faces.normal) < margin) return true;
    return false;
}

/// Bring the points of a crack to their places about a normal; what they bear goes over.
void set_points(Assembly& a, int contact, const BondFaces& faces, Point normal)
{
    Contacts& contacts = a.contacts;
    const LawParameters& law = contacts.law_of(contact);
    const double before = elastic_energy(contacts, contact);
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const PointState s = contacts.point_state(contact, p);
        contacts.set_point_state(contact, p,
            law::gap(law, s) < 0.0
                ? turned_state(s, law, contacts.normal(contact), normal)
                : open_state(s, law, apart_at(contacts, contact, p, faces), normal));
    }
    contacts.set_normal(contact, normal);
    a.ledger.removed_friction += before - elastic_energy(contacts, contact);
}

/// Length along the tangent over which the edges of a contact carry the couple of its gap.
void set_couple(Contacts& contacts, int contact, const BondFaces& faces)
{
    const Point mean = 0.5 * (faces.along[0] + faces.along[1]);
    const double along = cross(contacts.normal(contact), mean);
    // an edge across the tangent cannot carry it
    const double inverse = std::fabs(along) > 0.5 * norm(mean) ? 1.0 / along : 0.0;
    for (int side = 0; side < 2; ++side)
        contacts.inverse_edge_length(contact, side) = inverse;
}

/// Let the normal of a crack be `normal` now, and turn with the line of the centres from there;
/// across its faces where these face each other.
void set_branch(Assembly& a, int contact, Point normal, bool between_faces)
{
    const GrainPair pair = a.contacts.pairs[contact];
    const Point bonded = between_bonded_centres(a.grains, pair),
                now = between_centres(a.grains, pair);
    a.contacts.set_branch(contact, between_faces ? Point {} : norm(now) * normal - (now - bonded));
}

/// Normal that a crack should have: across its faces while these lie as they did, then turning to
/// the line of the centres the further they part.
Point wanted_normal(const Assembly& a, int contact, const BondFaces& faces, double parted)
{
    const Point between = between_centres(a.grains, a.contacts.pairs[contact]);
    const Point of_centres = unit_along(between);
    if (parted == 0.0) return faces.normal;
    if (parted == 1.0) return of_centres;
    return unit_along((1.0 - parted) * faces.normal + parted * of_centres);
}

/// Let a crack that acts follow what its faces do. Returns whether it has another normal by that.
bool follow(Assembly& a, int contact)
{
    const BondFaces faces = bond_faces(a, contact);
    const double parted = parting(faces);
    const bool between_faces = is_between_faces(a.contacts, contact);
    const bool bears = presses(a.contacts, contact);
    if (parted == 0.0 && !bears) {  // its opening is measured anew
        a.contacts.set_branch(contact, {});
        set_points(a, contact, faces, faces.normal);
        if (!between_faces) set_couple(a.contacts, contact, faces);
        return !between_faces;
    }
    if (parted == 0.0 && between_faces) return false;
    const Point now = a.contacts.normal(contact);
    const Point wanted = wanted_normal(a, contact, faces, parted);
    const double angle = std::atan2(cross(now, wanted), dot(now, wanted));
    if (!between_faces && angle == 0.0) return false;
    const bool arrives = !bears || std::fabs(angle) <= largest_turn;
    const double turn = std::min(std::max(angle, -largest_turn), largest_turn);
    const Point normal = arrives ? wanted : turned(now, turn);
    set_branch(a, contact, normal, arrives && parted == 0.0);
    if (bears)
        set_points(a, contact, faces, normal);
    else
        a.contacts.set_normal(contact, normal);
    set_couple(a.contacts, contact, faces);
    return true;
}

/// Whether a crack that has ended may act again.
bool may_act(const Assembly& a, int contact)
{
    const BondFaces faces = bond_faces(a, contact);
    return is_facing(faces, again) && is_near(a, contact, faces, found_within);
}

/// The touch of a pair that has no bond any more; -1: none.
int touch_of(const Contacts& contacts, GrainPair pair)
{
    const auto all = std::equal_range(contacts.pairs.begin(), contacts.pairs.end(), pair);
    for (auto one = all.first; one != all.second; ++one) {
        const int c = static_cast<int>(one - contacts.pairs.begin());
        if (!contacts.bonded[c] && contacts.joint[c] < 0) return c;
    }
    return -1;
}

/// Let a crack that has ended act again. What it has dissipated was booked when it ended.
void restore(Assembly& a, int contact)
{
    Contacts& contacts = a.contacts;
    const auto [from, to] = contacts.edge(contact, 0);
    const double area = a.area_of(norm(a.grains.reference_at(to) - a.grains.reference_at(from)));
    const EdgePoints places = edge_points(contacts.points_of(contact));
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        PointState s = contacts.point_state(contact, p);
        s.opening = std::max(s.opening, 0.0);
        s.shear_traction = s.damage_energy = s.friction_energy = 0.0;
        contacts.set_point_state(contact, p, s);
        contacts.area(contact, p) = places.share[p] * area;
    }
    const BondFaces faces = bond_faces(a, contact);
    contacts.set_branch(contact, {});
    set_points(a, contact, faces, faces.normal);
    set_couple(contacts, contact, faces);
}

}  // namespace

bool is_crack(const Contacts& contacts, int contact)
{
    if (!contacts.bonded[contact] || contacts.erased[contact] || contacts.joint[contact] >= 0)
        return false;
    for (int p = 0; p < contacts.points_of(contact); ++p)
        if (damage_of(contacts, contact, p) < 1.0) return false;
    return true;
}

bool is_between_faces(const Contacts& contacts, int contact)
{
    const Point branch = contacts.branch(contact);
    return branch.x == 0.0 && branch.y == 0.0;
}

double bonded_distance(const Grains& grains, GrainPair pair)
{
    return norm(between_bonded_centres(grains, pair));
}

bool presses(const Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        if (gap_of(contacts, contact, p) < 0.0) return true;
    }
    return false;
}

bool is_watched(const Assembly& a, int contact)
{
    return is_near(a, contact, bond_faces(a, contact), kept_within);
}

bool has_parted(const Assembly& a, int contact)
{
    return !presses(a.contacts, contact) && parting(bond_faces(a, contact)) == 1.0;
}

CrackChanges follow_cracks(Assembly& a, double damping, double dt)
{
    CrackChanges changes;
    std::vector<int> ended;
    for (int c = 0; c < a.contacts.count; ++c) {
        if (!is_crack(a.contacts, c)) continue;
        if (is_active(a.contacts, c)) {
            changes.any = follow(a, c) || changes.any;
            continue;
        }
        if (!may_act(a, c)) continue;
        const int touch = touch_of(a.contacts, a.contacts.pairs[c]);
        if (touch >= 0 && presses(a.contacts, touch)) continue;
        restore(a, c);
        changes.pairs.push_back(a.contacts.pairs[c]);
        if (touch >= 0) ended.push_back(touch);
    }
    std::sort(ended.begin(), ended.end());
    ended.erase(std::unique(ended.begin(), ended.end()), ended.end());
    auto& pairs = changes.pairs;
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    changes.any = changes.any || !pairs.empty();
    if (!changes.any) return changes;
    change_contacts(a, ended, {}, damping, dt);
    renew_step(a, damping, dt);
    return changes;
}

}  // namespace flexpm
