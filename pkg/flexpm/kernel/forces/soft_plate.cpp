// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/forces/soft_plate.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexpm {

namespace {

/// Energy of a plate's springs over two motions of it: a give along its normal, against the spring
/// of its machine, and a turn on its seat. It is convex, in pieces of second order.
class SoftPlate {
public:
    SoftPlate(const Assembly& a, const Plate& plate, double dt) :
        machine(plate.loaded ? 0.0 : plate.machine_stiffness),
        give_before(plate.machine_give)
    {
        for (int i = 0; i < plate_points(plate); ++i) {
            const PlatePoint p = plate_point(plate, i);
            const auto nodes = a.facets.nodes(p.facet);
            const Vector way = vector_on_edge(a.grains.displacement, nodes, p.weight)
                + dt * vector_on_edge(a.grains.velocity, nodes, p.weight) - plate.displacement;
            const Vector along = point_normal(plate, i);
            const double arm = point_arm(plate, i);
            points.push_back({ plate.gap[i] + dot(along, way) - arm * plate.angle, p.stiffness,
                machine > 0.0 ? dot(plate.normal, along) : 0.0, -arm });
        }
        bonded = plate.bonded;
    }

    /// Give and turn of least energy, from none, by Newton's method. A full step ends on its piece;
    /// one beyond the least energy along it would go to and fro, as points that it has left do not
    /// bear: it ends there.
    Point least() const
    {
        Point x;
        std::vector<char> bearing, before;
        const int most = 2 * static_cast<int>(points.size()) + 30;
        for (int look = 0; look < most; ++look) {
            bearing.clear();
            const Point step = newton_step(x, bearing);
            if (bearing == before) break;
            const bool whole = !(slope(x + step, step) > 0.0);
            x = x + (whole ? 1.0 : least_along(x, step)) * step;
            if (whole)
                before = bearing;
            else
                before.clear();
            if (largest_change(step) <= no_change * largest_gap(x)) break;
        }
        return x;
    }

private:
    struct SoftPoint {
        double gap, stiffness, give, turn;  ///< [m], [N/m], of the gap over give [-] and turn [m]

        double at(Point x) const { return gap + change(x); }
        double change(Point x) const { return give * x.x + turn * x.y; }
    };

    /// Part of the largest gap that a step must change to be one [-].
    static constexpr double no_change = 1e-14;

    bool bears(const SoftPoint& p, Point x) const { return bonded || p.at(x) < 0.0; }

    Point newton_step(Point x, std::vector<char>& bearing) const
    {
        double k = machine, c = 0.0, m = 0.0, force = machine * (give_before + x.x), moment = 0.0;
        for (const SoftPoint& p : points) {
            const bool now = bears(p, x);
            bearing.push_back(now);
            if (!now) continue;
            const double spring = p.stiffness * p.at(x);
            k += p.stiffness * p.give * p.give;
            c += p.stiffness * p.give * p.turn;
            m += p.stiffness * p.turn * p.turn;
            force += spring * p.give;
            moment += spring * p.turn;
        }
        if (k == 0.0) k = 1.0;  // it does not give, or does not turn, and no force asks for it
        if (m == 0.0) m = 1.0;
        const double whole = k * m - c * c;
        return { (c * moment - m * force) / whole, (c * force - k * moment) / whole };
    }

    /// Growth of the energy along a step.
    double slope(Point x, Point step) const
    {
        double sum = machine * (give_before + x.x) * step.x;
        for (const SoftPoint& p : points)
            if (bears(p, x)) sum += p.stiffness * p.at(x) * p.change(step);
        return sum;
    }

    /// Part of a step after which the energy grows along it.
    double least_along(Point x, Point step) const
    {
        double low = 0.0, high = 1.0;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (low + high);
            (slope(x + middle * step, step) > 0.0 ? high : low) = middle;
        }
        return low;
    }

    double largest_change(Point step) const
    {
        double found = 0.0;
        for (const SoftPoint& p : points)
            found = std::max(found, std::fabs(p.change(step)));
        return found;
    }

    double largest_gap(Point x) const
    {
        double found = 0.0;
        for (const SoftPoint& p : points)
            found = std::max(found, std::fabs(p.at(x)));
        return found;
    }

    double machine, give_before;
    bool bonded = false;
    std::vector<SoftPoint> points;
};

/// A jaw with friction in a soft machine: as it gives, it slips along the rim, too, and friction
/// bears a part of its load. What is missing of that has no energy, but grows with the give.
class RubbingJaw {
public:
    RubbingJaw(const Assembly& a, const Plate& plate, double dt) : plate(plate)
    {
        for (int i = 0; i < plate_points(plate); ++i) {
            const PlatePoint p = plate_point(plate, i);
            const auto nodes = a.facets.nodes(p.facet);
            const Vector v = vector_on_edge(a.grains.velocity, nodes, p.weight);
            const Vector way = vector_on_edge(a.grains.displacement, nodes, p.weight) + dt * v
                - plate.displacement;
            const Vector along = point_normal(plate, i), across = tangent_of(in_plane(along));
            points.push_back(
                { p, plate.gap[i] + dot(along, way), dt * dot(across, v - plate.velocity),
                    plate.shear_force[i], dot(plate.normal, along), dot(plate.normal, across) });
        }
    }

    /// The give at which nothing is missing, by the rule of Illinois.
    double balanced() const
    {
        double near = 0.0, missing_near = missing(0.0);
        double far = near, missing_far = missing_near;
        for (double reach = 1.0; missing_near * missing_far > 0.0 && reach < largest_reach;
             reach *= 2.0) {
            far = -reach * missing_near / plate.machine_stiffness;
            missing_far = missing(far);
        }
        const double none = no_force * std::fabs(missing_near);
        for (int look = 0; look < most_looks && std::fabs(missing_far) > none; ++look) {
            const double x = far - missing_far * (far - near) / (missing_far - missing_near);
            const double m = missing(x);
            if (m * missing_far < 0.0) {
                near = far;
                missing_near = missing_far;
            } else {
                missing_near *= 0.5;
            }
            far = x;
            missing_far = m;
        }
        return far;
    }

private:
    struct JawPoint {
        PlatePoint point;
        double gap, slip, shear;         ///< before a give [m, m, N]
        double along_give, across_give;  ///< of its normal and its tangent along the plate's normal
    };

    /// Bounds of a search that a load always ends.
    static constexpr double largest_reach = 1e6;
    static constexpr int most_looks = 100;
    /// Part of what is missing without a give that is none [-].
    static constexpr double no_force = 1e-14;

    /// Force of the machine at a give, less that of the contacts [N].
    double missing(double give) const
    {
        double sum = plate.machine_stiffness * (plate.machine_give + give);
        for (const JawPoint& p : points) {
            const double normal = normal_force(plate, p.point, p.gap + give * p.along_give);
            const double slip = p.slip + give * p.across_give;
            const double shear =
                within_friction(plate, normal, p.shear - p.point.shear_stiffness * slip);
            sum -= normal * p.along_give + shear * p.across_give;
        }
        return sum;
    }

    const Plate& plate;
    std::vector<JawPoint> points;
};

/// Whether friction has a part in the load of a plate.
bool is_rubbing_jaw(const Plate& plate) { return !plate.normals.empty() && plate.friction > 0.0; }

}  // namespace

double normal_force(const Plate& plate, const PlatePoint& p, double gap)
{
    return gap < 0.0 || plate.bonded ? -p.stiffness * gap : 0.0;
}

double within_friction(const Plate& plate, double normal_force, double shear)
{
    const double limit = plate.friction * std::max(normal_force, 0.0);
    return std::min(std::max(shear, -limit), limit);
}

double give_way(const Assembly& a, Plate& plate, double dt)
{
    const auto [give, turn] = is_rubbing_jaw(plate)
        ? Point { RubbingJaw(a, plate, dt).balanced(), 0.0 }
        : SoftPlate(a, plate, dt).least();
    plate.machine_give += give;
    plate.displacement = plate.displacement - give * plate.normal;
    plate.angle += turn;
    return give;
}

}  // namespace flexpm
