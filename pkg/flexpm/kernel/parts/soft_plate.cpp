// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/soft_plate.hpp>

#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexpm {

namespace {

/// Way of a point from its reference, less that of the plate, at the end of a step [m].
Vector way_after(const Assembly& a, const Plate& plate, int index, double dt)
{
    const PlatePoint p = plate_point(plate, index);
    const auto nodes = a.facets.nodes(p.facet);
    return vector_on_edge(a.grains.displacement, nodes, p.weight)
        + dt * vector_on_edge(a.grains.velocity, nodes, p.weight) - plate.displacement;
}
Vector way_after(const SolidState& s, const Plate& plate, int index, double dt)
{
    const int triangle = plate.facets[index], grain = s.surface.grain[triangle];
    Vector way = -1.0 * plate.displacement;
    for (int k = 0; k < 3; ++k) {
        const int node = s.surface.nodes[triangle][k];
        way = way + corner_share(plate, index, k) * displacement_before(s, grain, node, -dt);
    }
    return way;
}

/// What the gap of a point grows by as its machine gives way and its seat turns.
Vector opens(const Plate& plate, int index)
{
    const double give = gives_way(plate) ? dot(plate.normal, point_normal(plate, index)) : 0.0;
    return flexpm::opens(plate, index, give);
}

/// Springs of a plate at the end of a step.
template <class State> SoftPlate plate_after(const State& state, const Plate& plate, double dt)
{
    SoftPlate found { gives_way(plate) ? plate.machine_stiffness : 0.0, plate.machine_give,
        plate.bonded, {} };
    for (int i = 0; i < plate_points(plate); ++i) {
        const double gap = plate.gap[i]
            + dot(point_normal(plate, i), way_after(state, plate, i, dt))
            - dot(point_arm(plate, i), plate.turn);
        found.contacts.push_back({ gap, point_stiffness(plate, i), opens(plate, i) });
    }
    return found;
}

/// Move a plate by a give and turns.
void follow(Plate& plate, Vector motion)
{
    plate.machine_give += motion.x;
    plate.displacement = plate.displacement - motion.x * plate.normal;
    plate.turn = plate.turn + turn_of(plate, motion);
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
            points.push_back({ i, p.shear_stiffness, plate.gap[i] + dot(along, way),
                dt * dot(across, v - plate.velocity), plate.shear_force[i],
                dot(plate.normal, along), dot(plate.normal, across) });
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
        int index;
        double shear_stiffness;          ///< [N/m]
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
            const double normal = normal_force(plate, p.index, p.gap + give * p.along_give);
            const double slip = p.slip + give * p.across_give;
            const double shear = within_friction(plate, normal, p.shear - p.shear_stiffness * slip);
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

double within_friction(const Plate& plate, double normal_force, double shear)
{
    const double limit = plate.friction * std::max(normal_force, 0.0);
    return std::min(std::max(shear, -limit), limit);
}

double give_way(const Assembly& a, Plate& plate, double dt)
{
    const Vector motion = is_rubbing_jaw(plate)
        ? Vector { RubbingJaw(a, plate, dt).balanced(), 0.0, 0.0 }
        : plate_after(a, plate, dt).least();
    follow(plate, motion);
    return motion.x;
}

void give_way(SolidState& s, double dt)
{
    for (Plate& plate : s.plates)
        if (plate.seated || gives_way(plate)) follow(plate, plate_after(s, plate, dt).least());
}

Vector opens(const Plate& plate, int index, double give)
{
    const Vector arm = point_arm(plate, index);
    const auto [first, second] = seat_axes(plate.normal);
    return { give, -dot(arm, first), -dot(arm, second) };
}

Vector turn_of(const Plate& plate, Vector motion)
{
    const auto [first, second] = seat_axes(plate.normal);
    return motion.y * first + motion.z * second;
}

PlateRates rates_of(const SolidState& s, const Plate& plate, const Array<double>& velocity)
{
    if (!gives_way(plate) && !plate.seated) return {};
    PlateStiffness stiffness;
    if (gives_way(plate)) stiffness.add_machine(plate.machine_stiffness);
    Vector growth;
    for (int i = 0; i < static_cast<int>(plate.facets.size()); ++i) {
        if (!(plate.bonded || plate.opening[i] < 0.0)) continue;
        Vector way = plate.velocity;
        for (int k = 0; k < 3; ++k) {
            const int node = s.surface.nodes[plate.facets[i]][k];
            way = way - corner_share(plate, i, k) * space_vector(velocity, node);
        }
        const double spring = point_stiffness(plate, i);
        stiffness.add(spring, opens(plate, i));
        growth = growth + spring * dot(point_normal(plate, i), way) * opens(plate, i);
    }
    const Vector motion = stiffness.moved_by(growth);
    return { motion.x, turn_of(plate, motion) };
}

}  // namespace flexpm
