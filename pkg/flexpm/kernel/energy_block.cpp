// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies, `lanes` at a time.
#include <flexpm/kernel/energy_block.hpp>

#include <flexpm/kernel/contact_rows.hpp>
#include <flexpm/kernel/simd.hpp>

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

struct GrainRows {
    int triangles;
    const int* connectivity;
    const double* shape;
    const double* stiffness;
    const double* displacement;
};

FLEXPM_MULTIVERSION void add_strain(const GrainRows& b, LaneSum& energy)
{
    const double* u = b.displacement;
    LaneSum sum = energy;  // a local, which no row aliases
    for (int t = 0; t < b.triangles; ++t) {
        const int n0 = 2 * lanes * b.connectivity[3 * t];
        const int n1 = 2 * lanes * b.connectivity[3 * t + 1];
        const int n2 = 2 * lanes * b.connectivity[3 * t + 2];
        const double* s = b.shape + 5 * lanes * t;
#pragma GCC ivdep
        for (int l = 0; l < lanes; ++l) {
            const TriangleShape shape = { s[l], s[lanes + l], s[2 * lanes + l], s[3 * lanes + l],
                s[4 * lanes + l] };
            const PlaneStiffness c = { b.stiffness[l], b.stiffness[lanes + l],
                b.stiffness[2 * lanes + l] };
            sum.lane[l] += triangle_energy(shape, c, { u[n0 + l], u[n0 + lanes + l] },
                { u[n1 + l], u[n1 + lanes + l] }, { u[n2 + l], u[n2 + lanes + l] });
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
    for (int block = 0; block < a.blocks(); ++block) {
        const MeshGroup& group = a.group(block);
        add_strain(
            { static_cast<int>(group.triangles.size()) / 3, group.triangles.data(),
                a.shape.data() + a.block_triangles[block], a.stiffness.data() + 3 * lanes * block,
                a.displacement.data() + a.block_nodes[block] },
            sum);
    }
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
