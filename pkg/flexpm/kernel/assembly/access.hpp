// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One grain, triangle or contact of the packed arrays at a time, for all that is not a step.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace flexpm {

inline int triangles_of(const Assembly& a, int grain)
{
    return static_cast<int>(a.group(a.grain_slot[grain] / lanes).triangles.size()) / 3;
}

/// Node numbers of a grain's triangle.
inline std::array<int, 3> triangle_nodes(const Assembly& a, int grain, int triangle)
{
    const int* t = &a.group(a.grain_slot[grain] / lanes).triangles[3 * triangle];
    return { t[0], t[1], t[2] };
}

inline TriangleShape shape_of(const Assembly& a, int grain, int triangle)
{
    const int slot = a.grain_slot[grain];
    const double* s =
        &a.shape[a.block_triangles[slot / lanes] + 5 * lanes * triangle + slot % lanes];
    return { s[0], s[lanes], s[2 * lanes], s[3 * lanes], s[4 * lanes] };
}

inline PlaneStiffness stiffness_of(const Assembly& a, int grain)
{
    const int slot = a.grain_slot[grain];
    const double* c = &a.stiffness[3 * lanes * (slot / lanes) + slot % lanes];
    return { c[0], c[lanes], c[2 * lanes] };
}

inline Point displacement_of(const Assembly& a, int node)
{
    return { a.displacement[node], a.displacement[node + lanes] };
}

inline Point force_of(const Assembly& a, int node)
{
    return { a.force[node], a.force[node + lanes] };
}

/// Law of a contact between two grains of the material of `grain`.
inline const LawParameters& own_law(const Assembly& a, int grain)
{
    return a.laws[a.grain_material[grain] * (a.elastic.size() + 1)];
}

/// Mean of value(grain) over all grains. Equal values give exactly that value.
template <class Value> double grain_mean(const Assembly& a, Value value)
{
    const double first = value(0);
    double excess = 0.0;
    for (int g = 1; g < a.grains; ++g)
        excess += value(g) - first;
    return first + excess / a.grains;
}

/// State of point `point` of a contact.
inline PointState point_state(const Assembly& a, int contact, int point)
{
    const double* s = &a.point_state[row_index(
        contact, point * ContactRows::state, a.points * ContactRows::state)];
    return { s[0], s[lanes], s[2 * lanes], s[3 * lanes], s[4 * lanes], s[5 * lanes], s[6 * lanes] };
}

/// Contacts of the bonded specimen, those that have ended included.
struct BondedContacts {
    int between = 0;  ///< grains of the rock
    int within = 0;   ///< one, between its inner particles
};

inline BondedContacts bonded_contacts(const Assembly& a)
{
    BondedContacts count;
    for (int c = 0; c < a.contacts; ++c) {
        if (!a.contact_bonded[c]) continue;
        const int* pair = &a.contact_grains[2 * c];
        ++(a.aggregate[pair[0]] == a.aggregate[pair[1]] ? count.within : count.between);
    }
    return count;
}

inline double damage_of(const Assembly& a, int contact, int point)
{
    const PointState s = point_state(a, contact, point);
    return law::damage(a.laws[a.contact_law[contact]], s.max_opening, s.shear_damage);
}

inline Point normal_of(const Assembly& a, int contact)
{
    return { a.normal[row_index(contact, 0, 2)], a.normal[row_index(contact, 1, 2)] };
}

/// Unit normal of a contact when it was bonded, from a to b: along the centres, or across the edge of
/// a contact without a span.
inline Point bonded_normal(const Assembly& a, int contact)
{
    double x = a.span[row_index(contact, 0, 2)], y = a.span[row_index(contact, 1, 2)];
    if (x == 0.0 && y == 0.0) {
        const int n0 = a.contact_nodes[row_index(contact, 0, ContactRows::nodes)];
        const int n1 = a.contact_nodes[row_index(contact, 1, ContactRows::nodes)];
        x = a.reference[n1 + lanes] - a.reference[n0 + lanes];
        y = a.reference[n0] - a.reference[n1];
    }
    const double length = std::hypot(x, y);
    return { x / length, y / length };
}

/// Nodes of a boundary edge: offsets of its start and end.
inline std::array<int, 2> edge_nodes(const Assembly& a, int edge)
{
    return { a.edge_nodes[row_index(edge, 0, 2)], a.edge_nodes[row_index(edge, 1, 2)] };
}

}  // namespace flexpm
