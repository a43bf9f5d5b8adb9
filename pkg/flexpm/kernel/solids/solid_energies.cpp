// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_energies.hpp>

#include <flexpm/kernel/solids/tetrahedron_forces.hpp>

#include <numeric>

namespace flexpm {

namespace {

double strain_energy(const SolidState& s)
{
    double sum = 0.0;
    for (int block = 0; block < s.grains.blocks(); ++block) {
        if (s.grains.group(block).rigid) continue;
        const auto c = load_rows<PlaneStiffness>(
            &s.grains.stiffness[block * row_count<PlaneStiffness> * lanes], 0);
        for_each_tetrahedron(s, block, [&](const TetrahedronShape& t, std::array<int, 4> n) {
            const auto way = [&](int k) { return space_vector(s.grains.displacement, n[k]); };
            sum += tetrahedron_energy(t, c, way(0), way(1), way(2), way(3));
        });
    }
    return sum;
}

void add_points(const SolidState& s, Energies& e)
{
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const LawParameters& law = c.law_of(contact);
        for (int p = 0; p < c.points_of(contact); ++p) {
            const double area = c.area(contact, p);
            const FacePointState state = c.point_state(contact, p);
            e.elastic += area * law::elastic_energy(law, c.place_of(contact, p), state);
            e.damage += area * state.damage_energy;
            if (c.crack(contact, p).mode == intact) e.softened += area * state.damage_energy;
            e.friction += area * state.friction_energy;
        }
    }
}

/// First of each pair: what has been done up to the present places.
double sum_of_first(const Array<double>& pairs)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < pairs.size(); i += 2)
        sum += pairs[i];
    return sum;
}

}  // namespace

Energies energies(const SolidState& s)
{
    Energies e;
    e.kinetic = std::accumulate(s.ledger.kinetic.begin(), s.ledger.kinetic.end(), 0.0);
    e.elastic = strain_energy(s);
    add_points(s, e);
    e.drag = sum_of_first(s.ledger.drag_work);
    e.damping = sum_of_first(s.ledger.damping_work) - e.drag;
    e.boundary_work = sum_of_first(s.ledger.prescribed_work);
    e.initial = s.ledger.initial;
    return e;
}

CrackCount count_cracks(const SolidState& s)
{
    CrackCount count;
    for (int c = 0; c < s.contacts.count; ++c) {
        for (int p = 0; p < s.contacts.points_of(c); ++p) {
            count.tensile += s.contacts.crack(c, p).mode == tensile_crack;
            count.shear += s.contacts.crack(c, p).mode == shear_crack;
        }
    }
    return count;
}

}  // namespace flexpm
