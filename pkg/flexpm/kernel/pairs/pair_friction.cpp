// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/pairs/pair_friction.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Moment of a disc that slips about its axis under even pressure: 2/3 mu N R, over mu N r.
const double twist_limit = 2.0 / 3.0 * std::sqrt(2.0);

/// A vector along the surface, turned with the normal: its length stays.
Vector along_surface(Vector v, Vector normal)
{
    const double size = norm(v);
    if (size == 0.0) return {};
    const Vector flat = v - dot(v, normal) * normal;
    const double left = norm(flat);
    return left > 0.0 ? (size / left) * flat : Vector {};
}

}  // namespace

double polar_radius(double area) { return std::sqrt(area / (2.0 * pi)); }

double spring_energy(const PairContact& pair, double shear_stiffness)
{
    const double k = shear_stiffness * pair.area, r = polar_radius(pair.area);
    return 0.5 * k * dot(pair.slip, pair.slip) + 0.5 * k * r * r * pair.twist * pair.twist;
}

PairFriction advance_friction(PairContact& pair, const PairPress& press, const PairWay& way,
    double shear_stiffness, double friction)
{
    const double stored = spring_energy(pair, shear_stiffness);
    if (press.area > pair.area) {
        const double share = pair.area / press.area;
        pair.slip = share * pair.slip;
        pair.twist *= share * share;
    }
    pair.slip = along_surface(pair.slip, press.normal);
    pair.normal = press.normal;
    pair.area = press.area;
    pair.friction_energy += stored - spring_energy(pair, shear_stiffness);

    const double k = shear_stiffness * press.area, r = polar_radius(press.area);
    const double turning = k * r * r;
    const Vector force_before = k * pair.slip;
    const double moment_before = turning * pair.twist;
    pair.slip = pair.slip + (way.slip - dot(way.slip, press.normal) * press.normal);
    pair.twist += way.twist;

    PairFriction now;
    const double limit = friction * press.force;
    const double size = norm(pair.slip);
    // what sticks keeps its digits
    const double held = k * size > limit ? limit / k : size;
    const Vector plastic = size > held ? ((size - held) / size) * pair.slip : Vector {};
    pair.slip = pair.slip - plastic;
    now.force = k * pair.slip;
    now.slid = norm(plastic);
    pair.friction_energy += std::max(0.5 * dot(force_before + now.force, plastic), 0.0);

    const double most = twist_limit * limit * r;
    const double twist = std::fabs(turning * pair.twist) > most
        ? std::copysign(most / turning, pair.twist)
        : pair.twist;
    const double turned = pair.twist - twist;
    pair.twist = twist;
    now.moment = turning * twist;
    pair.friction_energy += std::max(0.5 * (moment_before + now.moment) * turned, 0.0);
    return now;
}

double friction_of(const PairContact& pair, const LawParameters& law)
{
    return pair.face < 0 ? law.residual_friction : law::friction_after(law, pair.crack_slip);
}

void release_friction(PairContact& pair, double shear_stiffness)
{
    pair.friction_energy += spring_energy(pair, shear_stiffness);
    pair.slip = {};
    pair.twist = 0.0;
    pair.area = 0.0;
    pair.normal = {};
}

}  // namespace flexpm
