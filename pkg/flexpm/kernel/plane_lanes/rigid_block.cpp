// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rigid grains, `lanes` at a time.
#include <flexpm/kernel/plane_lanes/rigid_block.hpp>

#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>

namespace flexpm {

namespace {

/// A rotation by a small angle: what turning by it adds to a vector.
struct Turn {
    double along;   ///< cos - 1
    double across;  ///< sin
};

/// By tan(angle / 2): a rotation to round-off for any value of it, free of branches. The series is
/// exact to round-off up to a tenth of a turn in one step.
FLEXPM_INLINE Turn turn_by(double angle)
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

/// Forces and moments of a block's grains about their centres, and for the unbalanced ratio the
/// squares of the longest arms.
struct Resultants {
    alignas(64) double x[lanes], y[lanes], moment[lanes], square_arm[lanes];
};

FLEXPM_INLINE void move_centres(const RigidRows& b, int centre, double dt)
{
    double* along = b.rotation + RotationRow::cosine_less_one * lanes;
    double* across = b.rotation + RotationRow::sine * lanes;
    double* angle = b.rotation + RotationRow::angle * lanes;
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Turn turn = turn_by(dt * b.spin[l]);
        const double k = along[l] + turn.along * (1.0 + along[l]) - turn.across * across[l];
        const double s = across[l] + turn.along * across[l] + turn.across * (1.0 + along[l]);
        // keep cos^2 + sin^2 = 1 against the growth of round-off
        const double excess = 0.5 * (2.0 * k + k * k + s * s);
        along[l] = k - excess * (1.0 + k);
        across[l] = s - excess * s;
        angle[l] += dt * b.spin[l];
        const int x = component(centre + l, 0), y = component(centre + l, 1);
        b.displacement[x] += dt * b.velocity[x];
        b.displacement[y] += dt * b.velocity[y];
    }
}

/// Move the outer nodes with the grains and sum the forces there. With `Move` false nodes stay
/// where they are. Arms about the centres are left in the place of the nodes' velocities.
template <bool Move, bool Measure>
FLEXPM_INLINE void find_arms(const RigidRows& b, int centre, Resultants& sum)
{
    const double* along = b.rotation + RotationRow::cosine_less_one * lanes;
    const double* across = b.rotation + RotationRow::sine * lanes;
    const double *origin = b.reference + centre, *way = b.displacement + centre;
    for (int i = 0; i < centre; i += node_stride) {
        const double *reference = b.reference + i, *force = b.force + i;
        double *u = b.displacement + i, *arm = b.velocity + i;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const int y = component(l, 1);
            const double x0 = reference[l] - origin[l], y0 = reference[y] - origin[y];
            if (Move) {
                u[l] = way[l] + (along[l] * x0 - across[l] * y0);
                u[y] = way[y] + (across[l] * x0 + along[l] * y0);
            }
            const double rx = x0 + (u[l] - way[l]), ry = y0 + (u[y] - way[y]);
            arm[l] = rx;
            arm[y] = ry;
            sum.x[l] += force[l];
            sum.y[l] += force[y];
            sum.moment[l] += rx * force[y] - ry * force[l];
            if (Measure) sum.square_arm[l] = std::max(sum.square_arm[l], rx * rx + ry * ry);
        }
    }
}

/// Velocities of the outer nodes, of the arms that are in their place.
FLEXPM_INLINE void spread_lanes(const RigidRows& b, int centre, double dt)
{
    alignas(64) double along[lanes], across[lanes];
    for (int l = 0; l < lanes; ++l) {
        const Turn turn = turn_by(dt * b.spin[l]);
        along[l] = turn.along / dt;
        across[l] = turn.across / dt;
    }
    const double* of_centre = b.velocity + centre;
    for (int i = 0; i < centre; i += node_stride) {
        double* v = b.velocity + i;
        FLEXPM_INDEPENDENT
#pragma GCC unroll 1  // unrolled, the compiler takes the nodes for lanes
        for (int l = 0; l < lanes; ++l) {
            const int y = component(l, 1);
            const double rx = v[l], ry = v[y];
            v[l] = of_centre[l] + (along[l] * rx - across[l] * ry);
            v[y] = of_centre[y] + (across[l] * rx + along[l] * ry);
        }
    }
}

bool prescribes_any(const RigidRows& b)
{
    std::uint8_t any = 0;
    for (int i = 0; i < node_stride; ++i)
        any |= b.prescribed[i];
    for (int l = 0; l < lanes; ++l)
        any |= b.spin_prescribed[l];
    return any != 0;
}

template <bool Measure, bool Prescribed>
FLEXPM_INLINE void integrate_lanes(
    const RigidRows& b, int centre, const Resultants& f, double dt, double damping, StepSums& total)
{
    StepSums sums;  // a local, which no row aliases
    // bytes and doubles in one loop are not vectorised
    alignas(64) double prescribed[node_stride] = {}, spin_prescribed[lanes] = {};
    if (Prescribed) {
        std::copy_n(b.prescribed, node_stride, prescribed);
        std::copy_n(b.spin_prescribed, lanes, spin_prescribed);
    }
    double* v = b.velocity + centre;
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const int y = component(l, 1);
        const Freedom along_x = { f.x[l], b.inverse_mass[l], prescribed[l],
            b.undamped_velocity[l] };
        const Freedom along_y = { f.y[l], b.inverse_mass[l], prescribed[y],
            b.undamped_velocity[y] };
        const Freedom turn = { f.moment[l], b.inverse_inertia[l], spin_prescribed[l],
            b.undamped_spin[l], Measure ? std::sqrt(f.square_arm[l]) : 1.0 };
        integrate_one<Measure, Prescribed>(along_x, dt, damping, v[l], sums, l);
        integrate_one<Measure, Prescribed>(along_y, dt, damping, v[y], sums, l);
        integrate_one<Measure, Prescribed>(turn, dt, damping, b.spin[l], sums, l);
    }
    sums.copy_to(total);
}

template <bool Measure>
FLEXPM_INLINE void step_lanes(const RigidRows& b, double dt, double damping, StepSums& sums)
{
    const int centre = node_stride * (b.nodes - 1);
    move_centres(b, centre, dt);
    Resultants f;
    for (int l = 0; l < lanes; ++l) {
        f.x[l] = b.force[centre + l];
        f.y[l] = b.force[component(centre + l, 1)];
        f.moment[l] = f.square_arm[l] = 0.0;
    }
    find_arms<true, Measure>(b, centre, f);
    if (prescribes_any(b)) {
        integrate_lanes<Measure, true>(b, centre, f, dt, damping, sums);
    } else {
        integrate_lanes<Measure, false>(b, centre, f, dt, damping, sums);
    }
    spread_lanes(b, centre, dt);
}

}  // namespace

void step_rigid(const RigidRows& b, double dt, double damping, bool measure, StepSums& sums)
{
    const auto step = measure ? variant_of<step_lanes<true>>() : variant_of<step_lanes<false>>();
    step(b, dt, damping, sums);
}

void spread_velocities(const RigidRows& b, double dt)
{
    const int centre = node_stride * (b.nodes - 1);
    Resultants unused = {};
    find_arms<false, false>(b, centre, unused);
    spread_lanes(b, centre, dt);
}

}  // namespace flexpm
