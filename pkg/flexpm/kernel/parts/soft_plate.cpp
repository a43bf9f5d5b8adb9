// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/soft_plate.hpp>

#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace flexpm {

namespace {

/// Way of a point from its reference, less that of the plate, at the end of a step [m].
Vector way_after(const Assembly& a, const Plate& plate, int index, double dt)
{
    const EdgePoint p = edge_point(plate, index);
    const auto nodes = a.facets.nodes(p.facet);
    return vector_on_edge(a.grains.displacement, nodes, p.weight)
        + dt * vector_on_edge(a.grains.velocity, nodes, p.weight) - plate.displacement;
}
Vector way_after(const SolidState& s, const Plate& plate, int index, double dt)
{
    const int triangle = plate.points[index].facet, grain = s.surface.grain[triangle];
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
        const double gap = gap_after(plate, i, way_after(state, plate, i, dt));
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

/// A point of a jaw with friction before its plate gives way, in 2D.
struct EdgeOfJaw {
    int index;
    double shear_stiffness;          ///< [N/m]
    double gap, slip, shear;         ///< before a give [m, m, N]
    double along_give, across_give;  ///< of its normal and its tangent along the plate's normal

    /// Force along the plate's normal at a give [N].
    double push(const Plate& plate, double give) const
    {
        const double normal = normal_force(plate, index, gap + give * along_give);
        const double trial = shear - shear_stiffness * (slip + give * across_give);
        return normal * along_give + within_friction(plate, normal, trial) * across_give;
    }
};

/// The same in 3D, where the spring of friction has two components.
struct TriangleOfJaw {
    int index;
    double shear_stiffness;  ///< [N/m]
    double gap;              ///< before a give [m]
    double along_give;       ///< of its normal along the plate's normal
    Vector stretch;          ///< of the spring of friction before a give [m]
    Vector across_give;      ///< growth of that by a give [-]

    double push(const Plate& plate, double give) const
    {
        const double normal = normal_force(plate, index, gap + give * along_give);
        const Vector trial = -shear_stiffness * (stretch + give * across_give);
        const double size = norm(trial), bears = within_friction(plate, normal, size);
        const double part = size > bears ? bears / size : 1.0;
        return normal * along_give + part * dot(trial, across_give);
    }
};

std::vector<EdgeOfJaw> points_of_jaw(const Assembly& a, const Plate& plate, double dt)
{
    std::vector<EdgeOfJaw> points;
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const auto nodes = a.facets.nodes(p.facet);
        const Vector v = vector_on_edge(a.grains.velocity, nodes, p.weight);
        const Vector way =
            vector_on_edge(a.grains.displacement, nodes, p.weight) + dt * v - plate.displacement;
        const Vector along = point_normal(plate, i), across = tangent_of(in_plane(along));
        points.push_back({ i, p.shear_stiffness, plate.points[i].gap + dot(along, way),
            dt * dot(across, v - plate.velocity), plate.points[i].shear.x, dot(plate.normal, along),
            dot(plate.normal, across) });
    }
    return points;
}

std::vector<TriangleOfJaw> points_of_jaw(const SolidState& s, const Plate& plate, double dt)
{
    std::vector<TriangleOfJaw> points;
    for (int i = 0; i < plate_points(plate); ++i) {
        const Vector way = way_after(s, plate, i, dt), along = point_normal(plate, i);
        const double gap = dot(along, way), give = dot(along, plate.normal);
        points.push_back({ i, sliding_stiffness(plate, i), plate.points[i].gap + gap, give,
            way - gap * along - plate.points[i].slip, plate.normal - give * along });
    }
    return points;
}

/// A jaw with friction in a soft machine: as it gives, it slips along the rim, too, and friction
/// bears a part of its load. What is missing of that has no energy, but grows with the give.
template <class Point> class RubbingJaw {
public:
    RubbingJaw(const Plate& plate, std::vector<Point> points) :
        plate(plate),
        points(std::move(points))
    {
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
    /// Bounds of a search that a load always ends.
    static constexpr double largest_reach = 1e6;
    static constexpr int most_looks = 100;
    /// Part of what is missing without a give that is none [-].
    static constexpr double no_force = 1e-14;

    /// Force of the machine at a give, less that of the contacts [N].
    double missing(double give) const
    {
        double sum = plate.machine_stiffness * (plate.machine_give + give);
        for (const Point& p : points)
            sum -= p.push(plate, give);
        return sum;
    }

    const Plate& plate;
    std::vector<Point> points;
};

/// Whether friction has a part in the load of a plate.
bool is_rubbing_jaw(const Plate& plate) { return is_jaw(plate) && plate.friction > 0.0; }

/// Motion of a soft plate at the end of a step: a give and turns.
template <class State> Vector motion_of(const State& state, const Plate& plate, double dt)
{
    if (!is_rubbing_jaw(plate)) return plate_after(state, plate, dt).least();
    return { RubbingJaw(plate, points_of_jaw(state, plate, dt)).balanced(), 0.0, 0.0 };
}

}  // namespace

double within_friction(const Plate& plate, double normal_force, double shear)
{
    const double limit = plate.friction * std::max(normal_force, 0.0);
    return std::min(std::max(shear, -limit), limit);
}

double give_way(const Assembly& a, Plate& plate, double dt)
{
    const Vector motion = motion_of(a, plate, dt);
    follow(plate, motion);
    return motion.x;
}

void give_way(SolidState& s, double dt)
{
    for (Plate& plate : s.plates)
        if (plate.seated || gives_way(plate)) follow(plate, motion_of(s, plate, dt));
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
    for (int i = 0; i < plate_points(plate); ++i) {
        if (!(plate.bonded || plate.points[i].opening < 0.0)) continue;
        Vector way = plate.velocity;
        for (int k = 0; k < 3; ++k) {
            const int node = s.surface.nodes[plate.points[i].facet][k];
            way = way - corner_share(plate, i, k) * space_vector(velocity, node);
        }
        const double spring = point_stiffness(plate, i);
        stiffness.add(spring, opens(plate, i));
        growth = growth + spring * dot(point_normal(plate, i), way) * opens(plate, i);
        // friction holds what a jaw slips along as it gives
        const Vector along = point_normal(plate, i);
        const Vector slips = plate.normal - dot(along, plate.normal) * along;
        const double sliding = gives_way(plate) ? sliding_stiffness(plate, i) : 0.0;
        stiffness.add(sliding, { norm(slips), 0.0, 0.0 });
        growth.x += sliding * dot(slips, way);
    }
    const Vector motion = stiffness.moved_by(growth);
    return { motion.x, turn_of(plate, motion) };
}

}  // namespace flexpm
