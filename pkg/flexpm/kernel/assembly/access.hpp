// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One grain, triangle or contact of the packed arrays at a time, for all that is not a
/// step.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/triangle_rows.hpp>
#include <flexpm/kernel/core/mean.hpp>

#include <algorithm>
#include <array>
#include <type_traits>

namespace flexpm {

/// Node numbers of a grain's triangle.
inline std::array<int, 3> triangle_nodes(const Grains& grains, int grain, int triangle)
{
    const int* t = &grains.group_of(grain).triangles[3 * triangle];
    return { t[0], t[1], t[2] };
}

inline int triangles_of(const Grains& grains, int grain)
{
    return grains.group_of(grain).triangle_count();
}

inline TriangleShape shape_of(const Grains& grains, int grain, int triangle)
{
    return load_shape(&grains.shape[grains.block_triangles[grains.block_of(grain)]], triangle,
        grains.lane_of(grain));
}

inline PlaneStiffness stiffness_of(const Grains& grains, int grain)
{
    return load_rows<PlaneStiffness>(
        &grains.stiffness[stiffness_rows * lanes * grains.block_of(grain)], grains.lane_of(grain));
}

/// A node of a grain, by the grain and its number in it.
struct GrainNode {
    int grain = -1;  ///< -1 in a padded lane
    int number = 0;
};

inline GrainNode grain_node(const Grains& grains, int node)
{
    const auto& first = grains.block_nodes;
    const auto next = std::upper_bound(first.begin(), first.end(), node);
    const int block = static_cast<int>(next - first.begin()) - 1, within = node - first[block];
    const int stride = grains.layout.node_stride;
    return { grains.in_slot[block * lanes + within % stride], within / stride };
}

/// Law of a contact between two grains of the material of `grain`.
template <class State> const LawParameters& own_law(const State& s, int grain)
{
    return s.contacts.laws[s.grains.law_index(grain, grain)];
}

/// Mean of value(grain) over all grains. Equal values give exactly that value.
template <class Value> double grain_mean(const Grains& grains, Value value)
{
    return mean_of(grains.count, value);
}

/// Mean diameter of the discs or spheres of all grains [m].
inline double mean_diameter(const Grains& grains)
{
    return grain_mean(grains, [&](int g) { return 2.0 * grains.radius[g]; });
}

/// Call visit(index) for each component of each node of a grain.
template <class Visit> void for_each_component(const Grains& grains, int grain, Visit visit)
{
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        for (int axis = 0; axis < grains.layout.dimension; ++axis)
            visit(grains.component(grains.node(grain, n), axis));
    }
}

/// The same for all grains that are there, not for padded lanes.
template <class Visit> void for_each_component(const Grains& grains, Visit visit)
{
    for (int g = 0; g < grains.count; ++g)
        if (!grains.erased[g]) for_each_component(grains, g, visit);
}

/// Sum of the forces on the nodes of a grain [N], and their moment about its centre [N m]: in 2D
/// about z.
struct Resultant {
    Vector force;
    Vector moment;
};
inline Resultant resultant_on(const Grains& grains, int grain)
{
    const int centre = grains.centre(grain);
    // in 3D the centre of a rigid grain holds the sum, and the state its moment
    if (grains.layout.dimension == 3 && grains.is_rigid(grain))
        return { grains.vector(grains.force, centre), {} };
    const Vector middle = grains.position(centre);
    Resultant sum;
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        const Vector force = grains.vector(grains.force, node);
        sum.force = sum.force + force;
        sum.moment = sum.moment + cross(grains.position(node) - middle, force);
    }
    return sum;
}

/// The same of a state.
template <class State> Resultant resultant_on(const State& s, int grain)
{
    Resultant on = resultant_on(s.grains, grain);
    if constexpr (!std::is_same_v<State, Assembly>)
        if (s.grains.is_rigid(grain)) on.moment = s.bodies[grain].moment;
    return on;
}

/// Forces on nodes, with those of contacts, as show_nodes() has left them for rigid grains in 3D.
template <class State> const Array<double>& node_forces(const State& s)
{
    if constexpr (!std::is_same_v<State, Assembly>)
        if (!s.plan.shown_forces.empty()) return s.plan.shown_forces;
    return s.grains.force;
}

/// Numbers of contacts, without erased ones.
struct ContactCount {
    int between = 0;   ///< bonds of grains of the rock, those that have ended included
    int within = 0;    ///< bonds of one's inner particles, likewise
    int touching = 0;  ///< discs that have come to touch
};

inline ContactCount count_contacts(const Assembly& a)
{
    ContactCount count;
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.erased[c]) continue;
        const GrainPair pair = a.contacts.pairs[c];
        const bool inner = a.grains.parent[pair[0]] == a.grains.parent[pair[1]];
        ++(!a.contacts.bonded[c] ? count.touching : inner ? count.within : count.between);
    }
    return count;
}

/// Numbers of grains, nodes and triangles, without those that have been erased.
struct GrainCount {
    int grains = 0;     ///< of the rock
    int particles = 0;  ///< what moves: grains or inner particles
    int nodes = 0;
    int triangles = 0;
};

inline GrainCount count_grains(const Grains& grains)
{
    GrainCount count;
    std::vector<int> rock;
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        rock.push_back(grains.parent[g]);
        count.nodes += grains.nodes_of(g);
        count.triangles += triangles_of(grains, g);
    }
    count.particles = static_cast<int>(rock.size());
    std::sort(rock.begin(), rock.end());
    count.grains = static_cast<int>(std::unique(rock.begin(), rock.end()) - rock.begin());
    return count;
}

/// Number of facets of grains that are there.
inline int count_facets(const Assembly& a)
{
    return static_cast<int>(std::count_if(a.facets.grain.begin(), a.facets.grain.end(),
        [&](int grain) { return a.grains.erased[grain] == 0; }));
}

/// A facet of the boundary where it was bonded, and its area [m^2].
inline FacetPlace facet_place(const Assembly& a, int facet)
{
    return facet_place(a.grains, a.facets, facet);
}
inline double facet_area(const Assembly& a, int facet)
{
    return a.area_of(facet_place(a, facet).length());
}

/// Place of the contact with a lasting number; -1 if there is none, or none any more.
inline int contact_with_id(const Assembly& a, int id)
{
    const auto& ids = a.contacts.id;
    const auto& order = a.plan.contacts_by_id;
    const auto found = std::lower_bound(order.begin(), order.end(), id,
        [&](int contact, int value) { return ids[contact] < value; });
    return found != order.end() && ids[*found] == id ? *found : -1;
}

/// Area of a contact when bonded [m^2]. `List` is Contacts or FaceContacts.
template <class List> double contact_area(const List& contacts, int contact)
{
    double area = 0.0;
    for (int p = 0; p < contacts.points_of(contact); ++p)
        area += contacts.area(contact, p);
    return area;
}

/// Stiffnesses of a bond as a whole while it is intact [N/m].
struct BondStiffness {
    double normal = 0.0;
    double shear = 0.0;
};

template <class List> BondStiffness bond_stiffness(const List& contacts, int contact)
{
    const LawParameters& law = contacts.law_of(contact);
    const double area = contact_area(contacts, contact);
    return { law.normal_stiffness * area, law.shear_stiffness * area };
}

// what the state of a point means: all that is no lane reads it by these

/// Opening of a point [m], relative to the bonded state; compression < 0.
inline double opening_of(const Contacts& contacts, int contact, int point)
{
    return contacts.state(contact, point, &PointState::opening);
}

/// Its opening less what dilation has made of it [m].
inline double gap_of(const Contacts& contacts, int contact, int point)
{
    return law::gap(contacts.law_of(contact), contacts.point_state(contact, point));
}

/// Slip of a point along the tangent [m], relative to the bonded state.
inline double slip_of(const Contacts& contacts, int contact, int point)
{
    return contacts.state(contact, point, &PointState::slip);
}

/// Distance along the tangent between its places on the two edges [m].
inline double apart_along(const Contacts& contacts, int contact, int point)
{
    return slip_of(contacts, contact, point) - contacts.paired_slip(contact, point);
}

inline double damage_of(const Contacts& contacts, int contact, int point)
{
    const PointState s = contacts.point_state(contact, point);
    return law::damage(contacts.law_of(contact), s.max_opening, s.shear_damage);
}

/// Normal and shear traction of a point, tension positive.
struct PointTraction {
    double normal = 0.0;  ///< [Pa]
    double shear = 0.0;   ///< along the tangent [Pa]
};

/// The traction that its law gives to the state of a point, also of a contact that has ended.
inline PointTraction traction_of_state(const Contacts& contacts, int contact, int point)
{
    const PointState s = contacts.point_state(contact, point);
    const LawParameters& law = contacts.law_of(contact);
    const double damage = law::damage(law, s.max_opening, s.shear_damage);
    return { law::normal_traction(law, law::gap(law, s), s.max_opening, damage), s.shear_traction };
}

/// The traction of a point; 0 of a contact that has ended.
inline PointTraction traction_of(const Contacts& contacts, int contact, int point)
{
    if (contacts.area(contact, point) == 0.0) return {};
    return traction_of_state(contacts, contact, point);
}

/// What a point stores and has dissipated [J/m^2].
struct PointEnergy {
    double elastic = 0.0, damage = 0.0, friction = 0.0;
};

inline PointEnergy energy_of(const Contacts& contacts, int contact, int point)
{
    const PointState s = contacts.point_state(contact, point);
    return { law::elastic_energy(contacts.law_of(contact), s), s.damage_energy, s.friction_energy };
}

/// Let a point have dissipated so much [J/m^2].
inline void set_dissipated(
    Contacts& contacts, int contact, int point, double damage, double friction)
{
    contacts.state(contact, point, &PointState::damage_energy) = damage;
    contacts.state(contact, point, &PointState::friction_energy) = friction;
}

/// Friction of a point, which falls after a crack [-].
inline double friction_of(const Contacts& contacts, int contact, int point)
{
    return law::friction_after(contacts.law_of(contact), contacts.crack_slip(contact, point));
}

/// Leave no strength to a point that a load could take: it never counts as a crack.
inline void take_strength(Contacts& contacts, int contact, int point)
{
    contacts.state(contact, point, &PointState::shear_damage) = 1.0;
}

/// Mean opening of a contact's points, weighted by their areas [m]; 0 of one that has none.
inline double mean_opening(const Contacts& contacts, int contact)
{
    double sum = 0.0, area = 0.0;
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        sum += contacts.area(contact, p) * opening_of(contacts, contact, p);
        area += contacts.area(contact, p);
    }
    return area > 0.0 ? sum / area : 0.0;
}

/// Force of a contact on its second grain; that on the first is the opposite [N].
inline Point contact_force(const Contacts& contacts, int contact)
{
    Point sum;
    for (int corner = 0; corner < contacts.corners_of(contact); ++corner)
        sum = sum + contacts.force(contact, 1, corner);
    return sum;
}

/// Relative velocity of a contact point, b to a, at its bonded place, Eqs. 9-10 [m/s]; of
/// displacements the way [m].
inline Point relative_velocity(
    const Contacts& contacts, int contact, int point, const Array<double>& velocity)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? -1.0 : 1.0;
        const auto parts = facet_parts(contacts.weight(contact, point, side));
        for (int corner = 0; corner < contacts.corners_of(contact); ++corner) {
            const double part = sign * parts[corner];
            sum = sum + part * vector_at(velocity, contacts.node(contact, side, corner));
        }
    }
    return sum;
}

/// Shares of an edge's second node between which a contact acts: the whole edge, but a part where
/// the faces of a joint have slid.
inline std::array<double, 2> acting_part(const Assembly& a, int contact, int side)
{
    const Contacts& contacts = a.contacts;
    if (contacts.joint[contact] < 0) return { 0.0, 1.0 };
    const int last = contacts.points_of(contact) - 1;
    if (last > 0)
        return { contacts.weight(contact, 0, side), contacts.weight(contact, last, side) };
    const auto [from, to] = contacts.edge(contact, side);
    const double length = norm(a.grains.reference_at(to) - a.grains.reference_at(from));
    const double half = 0.5 * contacts.area(contact, 0) / a.area_of(length);
    const double middle = contacts.weight(contact, 0, side);
    return { middle - half, middle + half };
}

/// Unit normal of a contact when it was bonded, from a to b: along the centres, or across the edge
/// of a contact without a branch.
inline Point bonded_normal(const Assembly& a, int contact)
{
    Point along = a.contacts.branch(contact);
    if (along.x == 0.0 && along.y == 0.0) {
        const Point from = a.grains.reference_at(a.contacts.node(contact, 0, 0));
        const Point to = a.grains.reference_at(a.contacts.node(contact, 0, 1));
        along = { to.y - from.y, from.x - to.x };
    }
    const double length = norm(along);
    return { along.x / length, along.y / length };
}

}  // namespace flexpm
