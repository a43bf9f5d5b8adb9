// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_softening.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/kernel/statics/unilateral_solve.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Tractions of a point, or what they grow by in a unit of time.
struct Tractions {
    double normal = 0.0;
    Point shear;
};

/// What is left of the strengths of a point.
struct Strengths {
    double tensile;   ///< [Pa]
    double cohesion;  ///< [Pa]
    double friction;  ///< [-]
};

/// Way to |shear| = c - mu normal: the least root above 0 of a quadratic equation in time.
Approach approach_in_shear(const Strengths& left, const Tractions& now, const Tractions& growth)
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

Approach approach(const Strengths& left, const Tractions& now, const Tractions& growth)
{
    Approach first;
    if (growth.normal > 0.0 && left.tensile > 0.0) {
        first = { (left.tensile - now.normal) / growth.normal, growth.normal / left.tensile };
    }
    return earlier(first, approach_in_shear(left, now, growth));
}

/// Growth of the tractions of a point whose places on both sides part like `jump`.
Tractions growth_of(const LawParameters& law, const FaceFrame& frame, Vector jump)
{
    return { law.normal_stiffness * dot(frame.normal, jump),
        law.shear_stiffness * Point { dot(frame.first, jump), dot(frame.second, jump) } };
}

/// Call use(contact, point, frame, jump) for all points, where velocity(grain, node) has the
/// motion.
template <class Velocity, class Use>
void for_each_point(const SolidState& s, const Velocity& velocity, const Use& use)
{
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const FaceFrame frame = bonded_frame(s, contact);
        const GrainPair pair = c.pairs[contact];
        std::vector<Vector> apart;
        for (int k = 0; k < c.corners_of(contact); ++k)
            apart.push_back(velocity(pair[1], c.node(contact, 1, k))
                - velocity(pair[0], c.node(contact, 0, k)));
        for (int p = 0; p < c.points_of(contact); ++p) {
            Vector jump;
            for (std::size_t k = 0; k < apart.size(); ++k)
                jump = jump + c.share(contact, p, static_cast<int>(k)) * apart[k];
            use(contact, p, frame, jump);
        }
    }
}

Vector arm_of(const SolidState& s, int grain, int node)
{
    return space_vector(s.grains.reference, node)
        - space_vector(s.grains.reference, s.grains.centre(grain));
}

/// Area of a cut through a cube as large as the specimen [m^2].
double cut_area(const SolidState& s)
{
    double volume = 0.0;
    for (double r : s.grains.radius)
        volume += 4.0 / 3.0 * pi * r * r * r;
    return std::pow(volume, 2.0 / 3.0);
}

}  // namespace

double elastic_strain(const SolidState& s, const SolidField& field, double sense)
{
    std::vector<int> first { 0 };
    for (int g = 0; g < s.grains.count; ++g)
        first.push_back(first.back() + s.grains.nodes_of(g));
    const auto way = [&](int grain, int node) {
        if (!field.turns.empty())
            return sense * (field.ways[grain] + cross(field.turns[grain], arm_of(s, grain, node)));
        const int from = s.grains.block_nodes[s.grains.block_of(grain)];
        return sense * field.ways[first[grain] + (node - from) / s.grains.layout.node_stride];
    };
    double least = Approach().time;
    for_each_point(s, way, [&](int contact, int, const FaceFrame& frame, Vector jump) {
        const LawParameters& law = s.contacts.law_of(contact);
        const Strengths whole = { law.tensile_strength, law.cohesion, law.friction };
        least = std::min(least, approach(whole, {}, growth_of(law, frame, jump)).time);
    });
    return least;
}

double factor_before_softening(const SolidState& s, double dt, const SofteningRule& rule)
{
    check_positive("growth of a traction in a crossing", rule.growth, "");
    check_positive("steps of a crossing", rule.crossing, "");
    const FaceContacts& c = s.contacts;
    const GrainMotion& motion = s.loading.grains;
    const auto velocity = [&](int grain, int node) {
        if (s.bodies.empty()) return space_vector(motion.velocity, node);
        return space_vector(motion.velocity, s.grains.centre(grain))
            + cross(spin_in(motion, grain), arm_of(s, grain, node));
    };
    std::vector<SofteningBound> bounds;
    for_each_point(s, velocity, [&](int contact, int p, const FaceFrame& frame, Vector jump) {
        const LawParameters& law = c.law_of(contact);
        const FaceTraction on = traction_of(s, contact, p);
        const Tractions now { on.normal, on.shear };
        const bool cracked = on.damage >= 1.0;
        const bool slides = !(norm(now.shear) < -sliding_share * law.friction * now.normal);
        if (cracked ? slides : on.damage > 0.0) return;
        const double whole = 1.0 - on.damage;
        const Strengths left { whole * law.tensile_strength, whole * law.cohesion, law.friction };
        bounds.push_back(
            softening_bound(approach(left, now, growth_of(law, frame, jump)), c.area(contact, p),
                cracked ? 1.0 : damage_share(law), rule.crossing * dt, rule.growth));
    });
    return factor_of(std::move(bounds), cut_area(s));
}

}  // namespace flexpm
