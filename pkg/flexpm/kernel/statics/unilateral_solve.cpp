// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/unilateral_solve.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <cmath>
#include <limits>

namespace flexpm {

namespace {

/// Part of its stiffness that a contact keeps which bears nothing. It keeps loose grains in their
/// place.
constexpr double loose = 1e-6;

/// Damage from which on a point counts as a crack for the motion that the loading gives.
constexpr double softened = 0.5;

/// Solutions after which points that open or lift off are not looked for any more.
constexpr int most_lifts = 5;

/// Opening of a plate's point, or damage of a crack's, that marks it as loosened in a copy of the
/// state.
constexpr double loosened = std::numeric_limits<double>::max();

/// Pressure between the faces of a point [Pa]; below 0: they are apart, and it would be there had
/// they stuck.
double pressure_of(const Contacts& contacts, int contact, int point)
{
    return -contacts.law_of(contact).normal_stiffness * gap_of(contacts, contact, point);
}

/// Whether all of a contact is cracked and its faces slide past each other.
bool slides(const Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const double shear = traction_of_state(contacts, contact, p).shear;
        const double pressure = pressure_of(contacts, contact, p);
        const double limit = sliding_share * friction_of(contacts, contact, p) * pressure;
        if (damage_of(contacts, contact, p) < softened) return false;
        if (pressure > 0.0 && std::fabs(shear) < limit) return false;
    }
    return true;
}

/// Whether the faces of a contact bear on each other anywhere.
bool is_pressed(const Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        if (pressure_of(contacts, contact, p) > 0.0) return true;
    }
    return false;
}

/// Loosen the points of cracks that a motion opens and that nothing presses together now (deviation
/// D45), and the shear of cracks that slide; returns whether there are any.
///
/// @param laws  number of laws before cracks got theirs
bool loosen_cracks(Assembly& a, int laws, const Array<double>& velocity)
{
    Contacts& contacts = a.contacts;
    bool any = false;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.erased[c]) continue;
        const Point n = bonded_normal(a, c);
        for (int p = 0; p < contacts.points_of(c); ++p) {
            double& mark = contacts.state(c, p, &PointState::shear_damage);
            if (damage_of(contacts, c, p) < softened || mark == loosened) continue;
            if (pressure_of(contacts, c, p) > 0.0) continue;
            if (!(dot(n, relative_velocity(contacts, c, p, velocity)) > 0.0)) continue;
            contacts.area(c, p) *= loose;
            mark = loosened;
            any = true;
        }
        if (contacts.law[c] >= laws || !slides(contacts, c)) continue;
        any = true;
        LawParameters law = contacts.law_of(c);
        law.shear_stiffness *= loose;
        contacts.law[c] = static_cast<int>(contacts.laws.size());
        contacts.laws.push_back(law);
    }
    return any;
}

/// Loosen the points of plates that do not press and that a motion takes off; returns whether there
/// are any.
bool loosen_plates(Assembly& a, const Array<double>& velocity)
{
    bool any = false;
    for (Plate& plate : a.plates) {
        if (plate.bonded) continue;
        const PlateLag lag = plate_lag(a, plate, plate.displacement, &velocity);
        for (int i = 0; i < plate_points(plate); ++i) {
            const EdgePoint p = edge_point(plate, i);
            const Point v = vector_on_edge(velocity, a.facets.nodes(p.facet), p.weight);
            const Vector way = point_way(plate, i, plate.displacement, lag);
            const bool leaves = dot(point_normal(plate, i), v - way) > 0.0;
            if (plate.points[i].opening < 0.0 || !leaves || plate.points[i].opening == loosened)
                continue;
            plate.points[i].area *= loose;
            plate.points[i].opening = loosened;
            any = true;
        }
    }
    return any;
}

}  // namespace

StaticSolution solve_unilateral(Assembly& a, const std::vector<Prescribed>& prescribed)
{
    StaticSolution found = solve_static(a, prescribed);
    const int laws = static_cast<int>(a.contacts.laws.size());
    // what one point lets go may take off the next one
    for (int i = 0; i < most_lifts; ++i) {
        const bool cracks = loosen_cracks(a, laws, found.displacement);
        const bool plates = loosen_plates(a, found.displacement);
        if (!cracks && !plates) break;
        found = solve_static(a, prescribed);
    }
    return found;
}

int count_softened(const Assembly& a)
{
    int count = 0;
    for (int c = 0; c < a.contacts.count; ++c) {
        for (int p = 0; p < a.contacts.points_of(c); ++p)
            count += damage_of(a.contacts, c, p) >= softened;
    }
    return count;
}

int count_sliding_joints(const Assembly& a)
{
    int count = 0;
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.joint[c] < 0 || a.contacts.erased[c]) continue;
        count += is_pressed(a.contacts, c) && slides(a.contacts, c);
    }
    return count;
}

}  // namespace flexpm
