// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Stiffness of triangles, contact points and plates, term by term.
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>

#include <array>

namespace flexpm {

namespace {

void add_block(std::vector<StiffnessEntry>& entries, int row, int column, const StiffnessBlock& k)
{
    entries.push_back({ row, column, k.xx });
    entries.push_back({ row, column + lanes, k.xy });
    entries.push_back({ row + lanes, column, k.yx });
    entries.push_back({ row + lanes, column + lanes, k.yy });
}

void add_grain(const Assembly& a, int grain, std::vector<StiffnessEntry>& entries)
{
    const PlaneStiffness c = stiffness_of(a, grain);
    for (int t = 0; t < triangles_of(a, grain); ++t) {
        const auto n = triangle_nodes(a, grain, t);
        const TriangleShape s = shape_of(a, grain, t);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                add_block(
                    entries, a.node(grain, n[i]), a.node(grain, n[j]), stiffness_block(s, c, i, j));
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

/// Springs k_n along the bonded normal and k_s across it, between the points of the two edges.
void add_contact(const Assembly& a, int contact, std::vector<StiffnessEntry>& entries)
{
    const Point n = bonded_normal(a, contact);
    // share[i][j]: sum over points of area times the parts of nodes i and j in the relative motion
    std::array<std::array<double, 4>, 4> share = {};
    for (int p = 0; p < a.points; ++p) {
        const double area = a.area[row_index(contact, p, a.points)];
        const double wa = a.weight[row_index(contact, 2 * p, 2 * a.points)];
        const double wb = a.weight[row_index(contact, 2 * p + 1, 2 * a.points)];
        const std::array<double, 4> part = { wa - 1.0, -wa, 1.0 - wb, wb };
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j)
                share[i][j] += area * part[i] * part[j];
        }
    }
    const LawParameters& law = a.laws[a.contact_law[contact]];
    const double kn = law.normal_stiffness, ks = law.shear_stiffness;
    const StiffnessBlock k = spring_block(n, kn, ks);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double s = share[i][j];
            add_block(entries, a.contact_nodes[row_index(contact, i, ContactRows::nodes)],
                a.contact_nodes[row_index(contact, j, ContactRows::nodes)],
                { s * k.xx, s * k.xy, s * k.yx, s * k.yy });
        }
    }
}

/// Springs of a plate's points to where the plate is.
void add_plate(const Assembly& a, const Plate& plate, std::vector<StiffnessEntry>& entries)
{
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const StiffnessBlock k = plate_springs(plate, i);
        const auto n = edge_nodes(a, p.edge);
        const double part[] = { 1.0 - p.weight, p.weight };
        for (int r = 0; r < 2; ++r) {
            for (int c = 0; c < 2; ++c) {
                const double s = part[r] * part[c];
                add_block(entries, n[r], n[c], { s * k.xx, s * k.xy, s * k.yx, s * k.yy });
            }
        }
    }
}

}  // namespace

StiffnessBlock plate_springs(const Plate& plate, int point)
{
    const PlatePoint p = plate_point(plate, point);
    return spring_block(plate.normal, p.stiffness, p.shear_stiffness);
}

std::vector<StiffnessEntry> stiffness_entries(const Assembly& a)
{
    std::vector<StiffnessEntry> entries;
    for (int g = 0; g < a.grains; ++g)
        add_grain(a, g, entries);
    for (int c = 0; c < a.contacts; ++c)
        add_contact(a, c, entries);
    for (const Plate& p : a.plates)
        add_plate(a, p, entries);
    return entries;
}

}  // namespace flexpm
