// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies, `lanes` at a time.
#include <flexpm/kernel/measure/energy_sums.hpp>

#include <flexpm/kernel/assembly/law_rows.hpp>
#include <flexpm/kernel/assembly/triangle_rows.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/lane_sum.hpp>
#include <flexpm/kernel/core/simd.hpp>

#include <cmath>
#include <cstdint>

namespace flexpm {

namespace {

FLEXPM_INLINE void add_strain(const TriangleRows& b, LaneSum& energy)
{
    LaneSum sum = energy;  // a local, which no row aliases
    for (int t = 0; t < b.triangles; ++t) {
        const TriangleNodes n = nodes_of(b, t);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            sum.lane[l] += triangle_energy(load_shape(b.shape, t, l),
                load_rows<PlaneStiffness>(b.stiffness, l), displacement_of(b, n.n0, l),
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
        const double *a = area + p * lanes, *state = states + p * point_rows * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const PointState s = load_rows<PointState>(state, l);
            sum.lane[l] += a[l] * law::elastic_energy(load_rows<LawParameters>(law, l), s);
        }
    }
    energy = sum;
}

FLEXPM_INLINE void add_lost(
    const double* area, const double* states, int rows, LaneSum& damage, LaneSum& friction)
{
    LaneSum of_damage = damage, of_friction = friction;
    for (int r = 0; r < rows; ++r) {
        const double *a = area + r * lanes, *state = states + r * point_rows * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const PointState s = load_rows<PointState>(state, l);
            of_damage.lane[l] += a[l] * s.damage_energy;
            of_friction.lane[l] += a[l] * s.friction_energy;
        }
    }
    damage = of_damage;
    friction = of_friction;
}

FLEXPM_INLINE void add_softened(const double* area, const double* states,
    const std::uint8_t* crack_modes, int rows, LaneSum& energy)
{
    LaneSum sum = energy;
    for (int r = 0; r < rows; ++r) {
        const double* a = area + r * lanes;
        const double* lost = states + (r * point_rows + row_of<&PointState::damage_energy>)*lanes;
        const std::uint8_t* mode = crack_modes + r * lanes;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l)
            sum.lane[l] += mode[l] == intact ? a[l] * lost[l] : 0.0;
    }
    energy = sum;
}

/// Forces in records of contacts, `lanes` at a time.
FLEXPM_INLINE void add_forces(const double* forces, int contacts, LaneSum& total)
{
    LaneSum sum = total;
    for (int c = 0; c < contacts; c += lanes) {
        const double* f = forces + c * Contacts::force_values;
        alignas(64) double rows[4 * lanes];  // what acts on the first grain
        for (int l = 0; l < lanes; l += 4)
            transpose(f + l * Contacts::force_values, Contacts::force_values, rows + l, lanes);
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

double strain_energy(const Grains& grains)
{
    LaneSum sum;
    const auto add = variant_of<add_strain>();
    for (int block = 0; block < grains.blocks(); ++block)
        add(triangle_rows(grains, block), sum);
    return sum.total();
}

double contact_energy(const Contacts& contacts)
{
    LaneSum sum;
    LawRows law;
    const auto add = variant_of<add_stored>();
    for (int block = 0; block < contacts.blocks(); ++block) {
        const int points = contacts.points_in(block), first = block * lanes * points;
        law.fill(contacts, block);
        add(contacts.areas.data() + first, contacts.states.data() + first * point_rows, law.values,
            points, sum);
    }
    return sum.total();
}

ContactLoss contact_loss(const Contacts& contacts)
{
    LaneSum damage, friction;
    const auto add = variant_of<add_lost>();
    for (int block = 0; block < contacts.blocks(); ++block) {
        const int points = contacts.points_in(block), first = block * lanes * points;
        add(contacts.areas.data() + first, contacts.states.data() + first * point_rows, points,
            damage, friction);
    }
    return { damage.total(), friction.total() };
}

double softened_energy(const Contacts& contacts)
{
    LaneSum sum;
    const auto add = variant_of<add_softened>();
    for (int block = 0; block < contacts.blocks(); ++block) {
        const int points = contacts.points_in(block), first = block * lanes * points;
        add(contacts.areas.data() + first, contacts.states.data() + first * point_rows,
            contacts.crack_modes.data() + first, points, sum);
    }
    return sum.total();
}

double sum_of_forces(const Contacts& contacts)
{
    LaneSum sum;
    variant_of<add_forces>()(contacts.forces.data(), contacts.blocks() * lanes, sum);
    return sum.total();
}

}  // namespace flexpm
