// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies, `lanes` at a time.
#include <flexpm/kernel/measure/energy_sums.hpp>

#include <flexpm/kernel/assembly/contact_rows.hpp>
#include <flexpm/kernel/assembly/triangle_rows.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/simd.hpp>

#include <cmath>

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

FLEXPM_INLINE void add_strain(const TriangleRows& b, LaneSum& energy)
{
    LaneSum sum = energy;  // a local, which no row aliases
    for (int t = 0; t < b.triangles; ++t) {
        const TriangleNodes n = nodes_of(b, t);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            sum.lane[l] +=
                triangle_energy(shape_of(b, t, l), stiffness_of(b, l), displacement_of(b, n.n0, l),
                    displacement_of(b, n.n1, l), displacement_of(b, n.n2, l));
        }
    }
    energy = sum;
}

FLEXPM_INLINE void add_stored(
    const double* area, const double* states, const double* law, int points, LaneSum& energy)
{
    LaneSum sum = energy;
    for (int p = 0; p < points; ++p) {
        const double *a = area + p * lanes, *state = states + p * ContactRows::state * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const PointState s = load_state(state, l);
            sum.lane[l] += a[l] * law::elastic_energy(law_of(law, l), s);
        }
    }
    energy = sum;
}

FLEXPM_INLINE void add_lost(
    const double* area, const double* states, int rows, LaneSum& damage, LaneSum& friction)
{
    LaneSum of_damage = damage, of_friction = friction;
    for (int r = 0; r < rows; ++r) {
        const double *a = area + r * lanes, *state = states + r * ContactRows::state * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const PointState s = load_state(state, l);
            of_damage.lane[l] += a[l] * s.damage_energy;
            of_friction.lane[l] += a[l] * s.friction_energy;
        }
    }
    damage = of_damage;
    friction = of_friction;
}

/// Of records of contacts, `lanes` at a time.
FLEXPM_INLINE void add_forces(const double* forces, int contacts, LaneSum& total)
{
    LaneSum sum = total;
    for (int c = 0; c < contacts; c += lanes) {
        const double* f = forces + c * ContactRows::forces;
        alignas(64) double rows[4 * lanes];  // what acts on the first grain
        for (int l = 0; l < lanes; l += 4)
            transpose(f + l * ContactRows::forces, ContactRows::forces, rows + l, lanes);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const double x = rows[l] + rows[2 * lanes + l];
            const double y = rows[lanes + l] + rows[3 * lanes + l];
            sum.lane[l] += std::sqrt(x * x + y * y);
        }
    }
    total = sum;
}

}  // namespace

double strain_energy(const Assembly& a)
{
    LaneSum sum;
    const auto add = variant_of<add_strain>();
    for (int block = 0; block < a.blocks(); ++block)
        add(triangle_rows(a, block), sum);
    return sum.total();
}

double contact_energy(const Assembly& a)
{
    LaneSum sum;
    LawRows law;
    const auto add = variant_of<add_stored>();
    for (int block = 0; block < a.contact_blocks(); ++block) {
        const int first = block * lanes * a.points;
        law.fill(a, block);
        add(a.area.data() + first, a.point_state.data() + first * ContactRows::state, law.values,
            a.points, sum);
    }
    return sum.total();
}

ContactLoss contact_loss(const Assembly& a)
{
    LaneSum damage, friction;
    variant_of<add_lost>()(
        a.area.data(), a.point_state.data(), a.contact_blocks() * a.points, damage, friction);
    return { damage.total(), friction.total() };
}

double sum_of_forces(const Assembly& a)
{
    LaneSum sum;
    variant_of<add_forces>()(a.contact_force.data(), a.contact_blocks() * lanes, sum);
    return sum.total();
}

}  // namespace flexpm
