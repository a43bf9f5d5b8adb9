// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/softening_ahead.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
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

/// Points that may come to their strengths faster, over the cut through a square or a cube as large
/// as the specimen [-].
constexpr double few = 0.05;

/// Way of a point to its strength.
struct Approach {
    double time = infinite;  ///< until it is reached [s]
    double growth = 0.0;     ///< of the traction in a unit of time, over that at the strength [1/s]
};

/// The earlier of two.
Approach earlier(const Approach& one, const Approach& other)
{
    return other.time < one.time ? other : one;
}

/// Tractions of a point [Pa], or their growth in a unit of time. The shear is a number in 2D and
/// has two components in 3D.
template <class Shear> struct Tractions {
    double normal = 0.0;
    Shear shear {};
};

double size_of(double shear) { return std::fabs(shear); }
double size_of(Point shear) { return norm(shear); }

/// What is left of the strengths of a point.
struct Strengths {
    double tensile;   ///< [Pa]
    double cohesion;  ///< [Pa]
    double friction;  ///< [-]
};

/// Way of a point to |shear| = c - mu normal, in either sense.
Approach approach_in_shear(
    const Strengths& left, const Tractions<double>& now, const Tractions<double>& growth)
{
    Approach first;
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

/// The same in 3D: the least root above 0 of a quadratic equation in time.
Approach approach_in_shear(
    const Strengths& left, const Tractions<Point>& now, const Tractions<Point>& growth)
{
    const double missing = left.cohesion - left.friction * now.normal;
    const double falling = left.friction * growth.normal;
    const double a = dot(growth.shear, growth.shear) - falling * falling;
    const double b = dot(now.shear, growth.shear) + missing * falling;
    const double c = dot(now.shear, now.shear) - missing * missing;
    const double square = b * b - a * c;
    Approach first;
    if (!(square >= 0.0)) return first;
    const double root = std::sqrt(square);
    // both roots without loss of digits
    const double q = -(b + std::copysign(root, b));
    for (const double time : { q / a, c / q }) {
        if (!(time >= 0.0 && missing - time * falling >= 0.0)) continue;
        const double borne = norm(now.shear + time * growth.shear);
        if (!(borne > 0.0)) continue;
        const double towards = dot(now.shear + time * growth.shear, growth.shear) / borne + falling;
        first = earlier(first, { time, std::max(towards, norm(growth.shear)) / borne });
    }
    return first;
}

/// How a point comes to its strengths at a steady growth of its tractions: to that in tension or to
/// that in shear.
template <class Shear>
Approach approach(
    const Strengths& left, const Tractions<Shear>& now, const Tractions<Shear>& growth)
{
    Approach first;
    if (growth.normal > 0.0 && left.tensile > 0.0) {
        first = { (left.tensile - now.normal) / growth.normal, growth.normal / left.tensile };
    }
    return earlier(first, approach_in_shear(left, now, growth));
}

/// What a point on its way asks of the loading.
struct SofteningBound {
    double factor;  ///< on the velocity, at most [-]
    double untold;  ///< area, the larger the less its damage tells [m^2]
};

/// Bound of a point whose damage tells a share of what it dissipates.
SofteningBound softening_bound(
    const Approach& to, double area, double telling, double crossing, double growth)
{
    const double slow = growth / (to.growth * crossing);
    return { std::max(slow, to.time / crossing), area / telling };
}

/// Factor that all bounds allow but those of few points.
/// @param cut  area of a cut through the specimen [m^2]
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

/// Call use(contact, point, growth) for each point that is there, with the growth of its tractions
/// along its elastic branch at a velocity of all nodes.
template <class Use>
void for_each_growth(const Assembly& a, const Array<double>& velocity, const Use& use)
{
    const Contacts& contacts = a.contacts;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.erased[c]) continue;
        const Point n = bonded_normal(a, c);
        const LawParameters& law = contacts.law_of(c);
        for (int p = 0; p < contacts.points_of(c); ++p) {
            const Point v = relative_velocity(contacts, c, p, velocity);
            use(c, p,
                Tractions<double> { law.normal_stiffness * dot(v, n),
                    law.shear_stiffness * (v.y * n.x - v.x * n.y) });
        }
    }
}

/// The same in 3D, where velocity(grain, node) has the motion.
template <class Velocity, class Use>
void for_each_growth(const SolidState& s, const Velocity& velocity, const Use& use)
{
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const FaceFrame frame = bonded_frame(s, contact);
        const GrainPair pair = c.pairs[contact];
        const LawParameters& law = c.law_of(contact);
        std::vector<Vector> apart;
        for (int k = 0; k < c.corners_of(contact); ++k)
            apart.push_back(velocity(pair[1], c.node(contact, 1, k))
                - velocity(pair[0], c.node(contact, 0, k)));
        for (int p = 0; p < c.points_of(contact); ++p) {
            Vector jump;
            for (std::size_t k = 0; k < apart.size(); ++k)
                jump = jump + c.share(contact, p, static_cast<int>(k)) * apart[k];
            use(contact, p,
                Tractions<Point> { law.normal_stiffness * dot(frame.normal, jump),
                    law.shear_stiffness
                        * Point { dot(frame.first, jump), dot(frame.second, jump) } });
        }
    }
}

/// A point as it is.
template <class Shear> struct PointNow {
    Tractions<Shear> tractions;
    double damage;  ///< [-]
};

PointNow<double> point_now(const Assembly& a, int contact, int point)
{
    const PointTraction t = traction_of_state(a.contacts, contact, point);
    return { { t.normal, t.shear }, damage_of(a.contacts, contact, point) };
}

PointNow<Point> point_now(const SolidState& s, int contact, int point)
{
    const FaceTraction t = traction_of(s, contact, point);
    return { { t.normal, t.shear }, t.damage };
}

/// Damage from which on a contact's point that has not cracked is past its strength [-].
double most_damage(const Assembly& a, int contact)
{
    return a.contacts.joint[contact] < 0 ? 0.0 : begun;
}
double most_damage(const SolidState&, int) { return 0.0; }

/// Area of a cut through a square as large as the specimen [m^2].
double cut_area(const Assembly& a)
{
    double area = 0.0;
    for (double r : a.grains.radius)
        area += pi * r * r;
    return a.area_of(std::sqrt(area));
}

/// Area of a cut through a cube as large as the specimen [m^2].
double cut_area(const SolidState& s)
{
    double volume = 0.0;
    for (double r : s.grains.radius)
        volume += 4.0 / 3.0 * pi * r * r * r;
    return std::pow(volume, 2.0 / 3.0);
}

/// Where the loading of a specimen begins.
enum class StartState { unloaded, present };

/// Time after which the first point leaves its elastic branch: of an unloaded specimen, without
/// the points that are cracked; from the present state on 0 if a point has left the branch.
template <class State, class Velocity>
double time_to_strength(const State& s, const Velocity& velocity, StartState from)
{
    double least = infinite;
    for_each_growth(s, velocity, [&](int c, int p, auto growth) {
        const auto [now, damage] = point_now(s, c, p);
        const bool loaded = from == StartState::present;
        if (!loaded && damage >= 1.0) return;
        const LawParameters& law = s.contacts.law_of(c);
        const Strengths whole = { law.tensile_strength, law.cohesion, law.friction };
        const double time = approach(whole, loaded ? now : decltype(growth) {}, growth).time;
        least = loaded && damage > 0.0 ? 0.0 : std::min(least, time);
    });
    return least;
}

template <class State, class Velocity>
double factor_along(const State& s, const Velocity& velocity, double dt, const SofteningRule& rule)
{
    check_positive("growth of a traction in a crossing", rule.growth, "");
    check_positive("steps of a crossing", rule.crossing, "");
    const double crossing = rule.crossing * dt;
    std::vector<SofteningBound> bounds;
    for_each_growth(s, velocity, [&](int c, int p, const auto& growth) {
        const LawParameters& law = s.contacts.law_of(c);
        const auto [now, damage] = point_now(s, c, p);
        // one that has softened or is open is past its strength, one that slides releases nothing at
        // once
        const bool cracked = damage >= 1.0;
        const double friction = friction_of(s.contacts, c, p);
        const bool slides = !(size_of(now.shear) < -sliding_share * friction * now.normal);
        if (cracked ? slides : damage > most_damage(s, c)) return;
        const double whole = 1.0 - damage;
        const Strengths left = { whole * law.tensile_strength, whole * law.cohesion, friction };
        const double telling = cracked ? 1.0 : damage_share(law);
        bounds.push_back(softening_bound(
            approach(left, now, growth), s.contacts.area(c, p), telling, crossing, rule.growth));
    });
    return factor_of(std::move(bounds), cut_area(s));
}

Vector arm_of(const SolidState& s, int grain, int node)
{
    return s.grains.vector(s.grains.reference, node)
        - s.grains.vector(s.grains.reference, s.grains.centre(grain));
}

/// Motion of the nodes along `sense` times a field, by grain and node.
auto nodes_along(const SolidState& s, const SolidField& field, double sense)
{
    std::vector<int> first { 0 };
    for (int g = 0; g < s.grains.count; ++g)
        first.push_back(first.back() + s.grains.nodes_of(g));
    return [&s, &field, sense, first](int grain, int node) {
        if (!field.turns.empty())
            return sense * (field.ways[grain] + cross(field.turns[grain], arm_of(s, grain, node)));
        const int from = s.grains.block_nodes[s.grains.block_of(grain)];
        return sense * field.ways[first[grain] + (node - from) / s.grains.layout.node_stride];
    };
}

}  // namespace

double elastic_time(const Assembly& a, const Array<double>& velocity)
{
    return time_to_strength(a, velocity, StartState::unloaded);
}

double elastic_strain(const SolidState& s, const SolidField& field, double sense)
{
    return time_to_strength(s, nodes_along(s, field, sense), StartState::unloaded);
}

double elastic_strain_left(const SolidState& s, const SolidField& field, double sense)
{
    return time_to_strength(s, nodes_along(s, field, sense), StartState::present);
}

double factor_before_softening(
    const Assembly& a, const Array<double>& velocity, double dt, const SofteningRule& rule)
{
    return factor_along(a, velocity, dt, rule);
}

double factor_before_softening(const SolidState& s, double dt, const SofteningRule& rule)
{
    const GrainMotion& motion = s.loading.grains;
    const auto velocity = [&](int grain, int node) {
        if (s.bodies.empty()) return s.grains.vector(motion.velocity, node);
        return s.grains.vector(motion.velocity, s.grains.centre(grain))
            + cross(spin_in(motion, grain), arm_of(s, grain, node));
    };
    return factor_along(s, velocity, dt, rule);
}

}  // namespace flexpm
