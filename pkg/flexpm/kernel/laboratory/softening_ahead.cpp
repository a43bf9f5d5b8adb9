// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/softening_ahead.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/statics/unilateral_solve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace flexpm {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Damage up to which a joint's point has only begun to soften: a plane of such points still bears
/// nearly its strength. What a joint takes that is weaker than the rock tells too little; points of
/// rock tell by themselves that they soften (crack_wait.hpp).
constexpr double begun = 0.1;

/// Points that may come to their strengths faster, over the cut through a square as large as the
/// specimen [-].
constexpr double few = 0.05;

/// Growth of a point's tractions along its elastic branch at a velocity of all nodes, in a unit of
/// time.
PointTraction growth_of(
    const Contacts& contacts, const Array<double>& velocity, int c, int p, Point n)
{
    const LawParameters& law = contacts.law_of(c);
    const Point v = relative_velocity(contacts, c, p, velocity);
    return { law.normal_stiffness * dot(v, n), law.shear_stiffness * (v.y * n.x - v.x * n.y) };
}

/// What is left of the strengths of a point [Pa].
struct Strengths {
    double tensile;
    double cohesion;
    double friction;  ///< [-]
};

/// How a point comes to its strengths at a steady growth of its tractions: to that in tension or,
/// in either sense, to |shear| = c - mu normal.
Approach approach(const Strengths& left, const PointTraction& now, const PointTraction& growth)
{
    Approach first;
    if (growth.normal > 0.0 && left.tensile > 0.0) {
        first = { (left.tensile - now.normal) / growth.normal, growth.normal / left.tensile };
    }
    for (const double sense : { -1.0, 1.0 }) {
        const double towards = sense * growth.shear + left.friction * growth.normal;
        if (!(towards > 0.0)) continue;
        const double missing = left.cohesion - left.friction * now.normal - sense * now.shear;
        const double time = missing / towards;
        const double borne = std::fabs(now.shear + time * growth.shear);
        first = earlier(first, { time, std::max(towards, std::fabs(growth.shear)) / borne });
    }
    return first;
}

/// Way of a point of the specimen as it is; none of one that has softened, is open, or slides.
Approach approach_of(const Assembly& a, const Array<double>& velocity, int c, int p, Point n)
{
    const Contacts& contacts = a.contacts;
    const LawParameters& law = contacts.law_of(c);
    const double damage = damage_of(contacts, c, p);
    const PointTraction now = traction_of_state(contacts, c, p);
    const bool slides = !(std::fabs(now.shear) < -sliding_share * law.friction * now.normal);
    const double most = contacts.joint[c] < 0 ? 0.0 : begun;
    if (damage >= 1.0 ? slides : damage > most) return {};
    const double whole = 1.0 - damage;
    const Strengths left = { whole * law.tensile_strength, whole * law.cohesion, law.friction };
    return approach(left, now, growth_of(contacts, velocity, c, p, n));
}

/// Call `use(contact, point, normal)` for each point that is there.
template <class Use>
void for_each_point(const Contacts& contacts, const Assembly& a, const Use& use)
{
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.erased[c]) continue;
        const Point n = bonded_normal(a, c);
        for (int p = 0; p < contacts.points_of(c); ++p)
            use(c, p, n);
    }
}

/// Area of a cut through a square as large as the specimen [m^2].
double cut_area(const Assembly& a)
{
    double area = 0.0;
    for (double r : a.grains.radius)
        area += pi * r * r;
    return a.area_of(std::sqrt(area));
}

}  // namespace

Approach earlier(const Approach& one, const Approach& other)
{
    return other.time < one.time ? other : one;
}

SofteningBound softening_bound(
    const Approach& to, double area, double telling, double crossing, double growth)
{
    const double slow = growth / (to.growth * crossing);
    return { std::max(slow, to.time / crossing), area / telling };
}

double factor_of(std::vector<SofteningBound> bounds, double cut)
{
    const auto free = [](const SofteningBound& bound) { return !std::isfinite(bound.factor); };
    bounds.erase(std::remove_if(bounds.begin(), bounds.end(), free), bounds.end());
    std::sort(
        bounds.begin(), bounds.end(), [](const SofteningBound& one, const SofteningBound& other) {
            return one.factor < other.factor;
        });
    double left = few * cut;
    for (const SofteningBound& bound : bounds) {
        left -= bound.untold;
        if (left <= 0.0) return bound.factor;
    }
    return infinite;
}

double elastic_time(const Assembly& a, const Array<double>& velocity)
{
    double least = infinite;
    for_each_point(a.contacts, a, [&](int c, int p, Point n) {
        if (damage_of(a.contacts, c, p) >= 1.0) return;
        const LawParameters& law = a.contacts.law_of(c);
        const PointTraction growth = growth_of(a.contacts, velocity, c, p, n);
        const Strengths whole = { law.tensile_strength, law.cohesion, law.friction };
        least = std::min(least, approach(whole, {}, growth).time);
    });
    return least;
}

double factor_before_softening(
    const Assembly& a, const Array<double>& velocity, double dt, const SofteningRule& rule)
{
    check_positive("growth of a traction in a crossing", rule.growth, "");
    check_positive("steps of a crossing", rule.crossing, "");
    const double crossing = rule.crossing * dt;
    std::vector<SofteningBound> bounds;
    for_each_point(a.contacts, a, [&](int c, int p, Point n) {
        const Approach to = approach_of(a, velocity, c, p, n);
        // a crack that slides releases nothing at once
        const bool cracked = damage_of(a.contacts, c, p) >= 1.0;
        const double telling = cracked ? 1.0 : damage_share(a.contacts.law_of(c));
        bounds.push_back(
            softening_bound(to, a.contacts.area(c, p), telling, crossing, rule.growth));
    });
    return factor_of(std::move(bounds), cut_area(a));
}

}  // namespace flexpm
