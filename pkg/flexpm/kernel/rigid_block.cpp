// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rigid grains, `lanes` at a time.
#include <flexpm/kernel/rigid_block.hpp>

#include <flexpm/kernel/simd.hpp>

namespace flexpm {

namespace {

/// A rotation by a small angle: what turning by it adds to a vector.
struct Turn {
    double along;   ///< cos - 1
    double across;  ///< sin
};

/// By tan(angle / 2): a rotation to round-off for any value of it, free of branches. The series is
/// exact to round-off up to a tenth of a turn in one step.
__attribute__((always_inline)) inline Turn turn_by(double angle)
{
    const double h = 0.5 * angle, q = h * h;
    const double t = h
        * (1.0
            + q
                * (1.0 / 3.0
                    + q
                        * (2.0 / 15.0
                            + q * (17.0 / 315.0 + q * (62.0 / 2835.0 + q * (1382.0 / 155925.0))))));
    const double scale = 2.0 * t / (1.0 + t * t);
    return { -t * scale, scale };
}

/// Moments need the arms at the end of the step; nodes are there when forces are known.
__attribute__((always_inline)) inline void spread_lanes(const RigidRows& b, double dt)
{
    const int centre = 2 * (b.nodes - 1) * lanes;
    alignas(64) double along[lanes], across[lanes];
    for (int l = 0; l < lanes; ++l) {
        const Turn turn = turn_by(dt * b.spin[l]);
        along[l] = turn.along / dt;
        across[l] = turn.across / dt;
    }
    for (int n = 0; n + 1 < b.nodes; ++n) {
        const int i = 2 * n * lanes;
#pragma GCC ivdep
        for (int l = 0; l < lanes; ++l) {
            const double rx = (b.reference[i + l] - b.reference[centre + l])
                + (b.displacement[i + l] - b.displacement[centre + l]);
            const double ry = (b.reference[i + lanes + l] - b.reference[centre + lanes + l])
                + (b.displacement[i + lanes + l] - b.displacement[centre + lanes + l]);
            b.velocity[i + l] = b.velocity[centre + l] + (along[l] * rx - across[l] * ry);
            b.velocity[i + lanes + l] =
                b.velocity[centre + lanes + l] + (across[l] * rx + along[l] * ry);
        }
    }
}

template <bool Measure>
__attribute__((always_inline)) inline void integrate_lanes(
    const RigidRows& b, double dt, double damping, StepSums& total)
{
    const int centre = 2 * (b.nodes - 1) * lanes;
    StepSums sums;                       // a local, which no row aliases
    alignas(64) double held[3 * lanes];  // bytes and doubles in one loop are not vectorised
    std::copy_n(b.held, 2 * lanes, held);
    std::copy_n(b.spin_held, lanes, held + 2 * lanes);
    alignas(64) double fx[lanes], fy[lanes], moment[lanes] = {}, reach[lanes] = {};
    for (int l = 0; l < lanes; ++l) {
        fx[l] = b.force[centre + l];
        fy[l] = b.force[centre + lanes + l];
    }
    for (int n = 0; n + 1 < b.nodes; ++n) {
        const int i = 2 * n * lanes;
#pragma GCC ivdep
        for (int l = 0; l < lanes; ++l) {
            const double rx = (b.reference[i + l] - b.reference[centre + l])
                + (b.displacement[i + l] - b.displacement[centre + l]);
            const double ry = (b.reference[i + lanes + l] - b.reference[centre + lanes + l])
                + (b.displacement[i + lanes + l] - b.displacement[centre + lanes + l]);
            const double x = b.force[i + l], y = b.force[i + lanes + l];
            fx[l] += x;
            fy[l] += y;
            moment[l] += rx * y - ry * x;
            reach[l] = std::max(reach[l], rx * rx + ry * ry);
        }
    }
#pragma GCC ivdep
    for (int l = 0; l < lanes; ++l) {
        integrate_one<Measure>(
            fx[l], held[l], b.inverse_mass[l], 1.0, dt, damping, b.velocity[centre + l], sums, l);
        integrate_one<Measure>(fy[l], held[lanes + l], b.inverse_mass[l], 1.0, dt, damping,
            b.velocity[centre + lanes + l], sums, l);
        integrate_one<Measure>(moment[l], held[2 * lanes + l], b.inverse_inertia[l],
            std::sqrt(reach[l]), dt, damping, b.spin[l], sums, l);
    }
    sums.copy_to(total);
    spread_lanes(b, dt);
}

}  // namespace

FLEXPM_MULTIVERSION void move_rigid(const RigidRows& b, double dt)
{
    const int centre = 2 * (b.nodes - 1) * lanes;
    double *along = b.rotation, *across = b.rotation + lanes, *angle = b.rotation + 2 * lanes;
    for (int l = 0; l < lanes; ++l) {
        const Turn turn = turn_by(dt * b.spin[l]);
        const double k = along[l] + turn.along * (1.0 + along[l]) - turn.across * across[l];
        const double s = across[l] + turn.along * across[l] + turn.across * (1.0 + along[l]);
        // keep cos^2 + sin^2 = 1 against the growth of round-off
        const double excess = 0.5 * (2.0 * k + k * k + s * s);
        along[l] = k - excess * (1.0 + k);
        across[l] = s - excess * s;
        angle[l] += dt * b.spin[l];
        b.displacement[centre + l] += dt * b.velocity[centre + l];
        b.displacement[centre + lanes + l] += dt * b.velocity[centre + lanes + l];
    }
    for (int n = 0; n + 1 < b.nodes; ++n) {
        const int i = 2 * n * lanes;
#pragma GCC ivdep
        for (int l = 0; l < lanes; ++l) {
            const double rx = b.reference[i + l] - b.reference[centre + l];
            const double ry = b.reference[i + lanes + l] - b.reference[centre + lanes + l];
            b.displacement[i + l] = b.displacement[centre + l] + (along[l] * rx - across[l] * ry);
            b.displacement[i + lanes + l] =
                b.displacement[centre + lanes + l] + (across[l] * rx + along[l] * ry);
        }
    }
}

FLEXPM_MULTIVERSION void integrate_rigid(
    const RigidRows& b, double dt, double damping, StepSums& sums)
{
    integrate_lanes<false>(b, dt, damping, sums);
}

FLEXPM_MULTIVERSION void integrate_rigid_measured(
    const RigidRows& b, double dt, double damping, StepSums& sums)
{
    integrate_lanes<true>(b, dt, damping, sums);
}

void spread_velocities(const RigidRows& b, double dt) { spread_lanes(b, dt); }

}  // namespace flexpm
