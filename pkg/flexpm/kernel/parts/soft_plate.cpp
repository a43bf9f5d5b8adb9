// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/soft_plate.hpp>

#include <flexpm/kernel/parts/plate_springs.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexpm {

namespace {

/// Springs of a plate at the end of a step that began at the present displacements of the nodes.
SoftPlate soft_plate(const Assembly& a, const Plate& plate, double dt)
{
    SoftPlate found { plate.loaded ? 0.0 : plate.machine_stiffness, plate.machine_give,
        plate.bonded, {} };
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const auto nodes = a.facets.nodes(p.facet);
        const Vector way = vector_on_edge(a.grains.displacement, nodes, p.weight)
            + dt * vector_on_edge(a.grains.velocity, nodes, p.weight) - plate.displacement;
        const Vector along = point_normal(plate, i);
        const double arm = point_arm(plate, i);
        const double gap = plate.gap[i] + dot(along, way) - arm * plate.turn.z;
        const double gives = found.machine > 0.0 ? dot(plate.normal, along) : 0.0;
        found.contacts.push_back({ gap, p.stiffness, { gives, -arm, 0.0 } });
    }
    return found;
}

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
    const Vector motion = is_rubbing_jaw(plate)
        ? Vector { RubbingJaw(a, plate, dt).balanced(), 0.0, 0.0 }
        : soft_plate(a, plate, dt).least();
    plate.machine_give += motion.x;
    plate.displacement = plate.displacement - motion.x * plate.normal;
    plate.turn.z += motion.y;
    return motion.x;
}

}  // namespace flexpm
