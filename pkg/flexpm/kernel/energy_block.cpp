// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies, `lanes` at a time.
#include <flexpm/kernel/energy_block.hpp>

#include <flexpm/kernel/contact_rows.hpp>
#include <flexpm/kernel/simd.hpp>
#include <flexpm/kernel/triangle_rows.hpp>

namespace flexpm {

namespace {

/// One sum a lane.
struct LaneSum {
    alignas(64) double lane[lanes] = {};

    double total() const
    {
        double sum = 0.0;
        for (double part : lane)
            sum += part;
        return sum;
    }
};

FLEXPM_MULTIVERSION void add_strain(const TriangleRows& b, LaneSum& energy)
{
    LaneSum sum = energy;  // a local, which no row aliases
    for (int t = 0; t < b.triangles; ++t) {
        const TriangleNodes n = nodes_of(b, t);
#pragma GCC ivdep
        for (int l = 0; l < lanes; ++l) {
            sum.lane[l] +=
                triangle_energy(shape_of(b, t, l), stiffness_of(b, l), displacement_of(b, n.n0, l),
                    displacement_of(b, n.n1, l), displacement_of(b, n.n2, l));
        }
    }
    energy = sum;
}

struct ContactSums {
    LaneSum elastic, damage, friction;
};

FLEXPM_MULTIVERSION void add_contacts(
    const double* area, const double* states, const double* law, int points, ContactSums& total)
{
    ContactSums sums = total;
    for (int p = 0; p < points; ++p) {
        const double *a = area + p * lanes, *state = states + p * ContactRows::state * lanes;
#pragma GCC ivdep
        for (int l = 0; l < lanes; ++l) {
            const PointState s = load_state(state, l);
            sums.elastic.lane[l] += a[l] * law::elastic_energy(law_of(law, l), s);
            sums.damage.lane[l] += a[l] * s.damage_energy;
            sums.friction.lane[l] += a[l] * s.friction_energy;
        }
    }
    total = sums;
}

}  // namespace

double strain_energy(const Assembly& a)
{
    LaneSum sum;
    for (int block = 0; block < a.blocks(); ++block)
        add_strain(triangle_rows(a, block), sum);
    return sum.total();
}

ContactEnergy contact_energy(const Assembly& a)
{
    ContactSums sums;
    LawRows law;
    for (int block = 0; block < a.contact_blocks(); ++block) {
        const int first = block * lanes * a.points;
        law.fill(a, block);
        add_contacts(a.area.data() + first, a.point_state.data() + first * ContactRows::state,
            law.values, a.points, sums);
    }
    return { sums.elastic.total(), sums.damage.total(), sums.friction.total() };
}

}  // namespace flexpm
