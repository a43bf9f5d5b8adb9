// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/elastic_solution.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexpm {

namespace {

/// Stiffness of a plate over that of its springs which is none [-].
constexpr double no_stiffness = 1e-9;

/// Components that are held or driven, at a way of what is driven.
std::vector<Prescribed> prescribed_at(const Assembly& a, const ElasticLoading& loading, double way)
{
    const Grains& grains = a.grains;
    Array<double> value(grains.displacement.size(), 0.0);
    std::vector<std::uint8_t> given(grains.prescribed.begin(), grains.prescribed.end());
    const auto drive = [&](int number, double sense) {
        const NodeSet& set = a.node_sets.at(number);
        for (int node : set.nodes) {
            const Vector arm = grains.point_at(node) - set.pivot;
            const Vector v =
                way * loading.direction + sense * loading.turn * way * Vector { -arm.y, arm.x };
            set_vector(value, node, in_plane(v));
        }
    };
    for (int s : loading.sets)
        drive(s, 1.0);
    for (int s : loading.back_sets)
        drive(s, -1.0);
    for (const NodeSet& set : a.node_sets) {
        for (int node : set.nodes) {
            for (int axis = 0; axis < grains.layout.dimension; ++axis)
                if (set.floats && set.holds(axis)) given[grains.component(node, axis)] = 0;
        }
    }
    std::vector<Prescribed> found;
    for_each_component(grains, [&](int i) {
        if (given[i]) found.push_back({ i, value[i] });
    });
    return found;
}

StaticCase case_at(const Assembly& a, const ElasticLoading& loading, double way)
{
    StaticCase found;
    found.prescribed = prescribed_at(a, loading, way);
    found.plates.resize(a.plates.size());
    found.turns.assign(a.plates.size(), 0.0);
    for (int p : loading.plates)
        found.plates[p] = way * loading.direction;
    found.angles.assign(a.node_sets.size(), 0.0);
    for (int s : loading.sets)
        found.angles[s] = loading.turn * way;
    for (int s : loading.back_sets)
        found.angles[s] = -loading.turn * way;
    return found;
}

/// Forces after a motion, at the places from which it is linear.
void set_forces(const OneSidedPoints& points, const Bearing& bearing, const Motion& m, Assembly& s)
{
    const Array<double> more = points.more_force(bearing, m.displacement, m.plates);
    for (std::size_t i = 0; i < more.size(); ++i)
        s.grains.force[i] = m.force[i] + more[i];
    for (std::size_t i = 0; i < s.plates.size(); ++i)
        s.plates[i].force = points.plate_push(bearing, i, m.displacement, m.plates[i]).force;
    update_node_sets(s, 1.0, 0.0);  // their velocities are zero: forces alone
}

/// A plate whose way along its normal, or whose turn, is to be found.
struct FreeWay {
    int plate;
    bool turns;
};

/// Turn of a plate that moves the ends of its face by 1 m [rad].
double unit_turn(const Plate& plate) { return 2.0 / plate.width; }

/// One solution. Its cases are a motion of what is driven, with the loads, and one for each way
/// that is to be found.
class Solution {
public:
    Solution(const Assembly& a, const ElasticLoading& loading, const OneSidedPoints& points,
        const Bearing& bearing) :
        a(a),
        loading(loading),
        points(points),
        bearing(bearing),
        trial(a)
    {
        const std::vector<PlateWay> still(a.plates.size());
        const Array<double> none(a.grains.displacement.size(), 0.0);
        const Array<double> now = points.more_force(bearing, none, still);
        Array<double> forces = a.grains.force;
        for (std::size_t i = 0; i < forces.size(); ++i)
            forces[i] += now[i];
        cases.push_back(case_at(a, loading, loading.load ? 0.0 : loading.way));
        cases.front().loads = &forces;
        for (std::size_t i = 0; i < a.plates.size(); ++i) {
            trial.plates[i].machine_stiffness = 0.0;  // their springs find their way here
            trial.plates[i].seated = false;           // likewise
            const Plate& plate = a.plates[i];
            if (is_idle(plate)) continue;
            if (plate.loaded || plate.machine_stiffness > 0.0) {
                let_go({ static_cast<int>(i), false });
                cases.back().plates[i] = plate.normal;
            }
            if (plate.seated) {
                let_go({ static_cast<int>(i), true });
                cases.back().turns[i] = unit_turn(plate);
            }
        }
        if (loading.load) cases.push_back(case_at(a, loading, 1.0));
        for (const StaticSolution& one : solve_static_cases(trial, cases, points.springs(bearing)))
            motions.push_back(motion_of(one));
        for (std::size_t i = 0; i < forces.size(); ++i)
            motions.front().force[i] += a.grains.force[i];
        motions.front().way = loading.load ? 0.0 : loading.way;
        if (cases.size() > 1) find_ways();
    }

    Motion take() { return std::move(motions.front()); }

private:
    void let_go(FreeWay way)
    {
        free.push_back(way);
        cases.push_back(case_at(a, loading, 0.0));
    }

    /// That of the next case.
    Motion motion_of(const StaticSolution& s) const
    {
        const std::size_t number = motions.size();
        const StaticCase& of = cases[number];
        Motion m { s.displacement, s.force, {}, std::vector<double>(a.plates.size(), 0.0),
            of.angles, 0.0 };
        for (std::size_t i = 0; i < a.plates.size(); ++i)
            m.plates.push_back({ of.plates[i], of.turns[i] });
        if (number > free.size())
            m.way = 1.0;
        else if (number > 0 && !free[number - 1].turns)
            m.gives[free[number - 1].plate] = 1.0;
        const std::vector<PlateWay> still(a.plates.size());
        const Array<double> none(m.displacement.size(), 0.0);
        const Array<double> now = points.more_force(bearing, none, still),
                            then = points.more_force(bearing, m.displacement, m.plates);
        for (std::size_t i = 0; i < now.size(); ++i)
            m.force[i] -= then[i] - now[i];
        return m;
    }

    /// What each way must bring about, less what a motion does.
    Eigen::VectorXd missing(const Motion& m) const
    {
        Eigen::VectorXd out(static_cast<Eigen::Index>(motions.size() - 1));
        Eigen::Index row = 0;
        for (const auto& [i, turns] : free) {
            const Plate& p = a.plates[i];
            const PlatePush push = points.plate_push(bearing, i, m.displacement, m.plates[i]);
            if (turns) {
                out[row++] = -unit_turn(p) * push.moment;
                continue;
            }
            const double load =
                p.loaded ? p.load : p.machine_stiffness * (p.machine_give - m.gives[i]);
            out[row++] = load - dot(p.normal, push.force);
        }
        if (loading.load) {
            Assembly loaded = a;
            set_forces(points, bearing, m, loaded);
            out[row] = *loading.load - load_of(loaded, loading);
        }
        return out;
    }

    void find_ways()
    {
        Motion& whole = motions.front();
        const Eigen::VectorXd base = missing(whole);
        Eigen::MatrixXd stiffness(base.size(), base.size());
        for (Eigen::Index j = 0; j < base.size(); ++j) {
            Motion one = whole;
            one.add(motions[j + 1], 1.0);
            stiffness.col(j) = base - missing(one);
        }
        require_resistance(stiffness);
        const Eigen::VectorXd ways = stiffness.fullPivLu().solve(base);
        for (Eigen::Index j = 0; j < ways.size(); ++j)
            whole.add(motions[j + 1], ways[j]);
    }

    void require_resistance(const Eigen::MatrixXd& stiffness) const
    {
        const double whole = stiffness.cwiseAbs().maxCoeff();
        const auto lu = stiffness.fullPivLu();
        const double least = lu.matrixLU().diagonal().cwiseAbs().minCoeff();
        if (least > no_stiffness * whole) return;
        fail("find_elastic_state: resistance to pressed or driven parts", number(least) + " N/m",
            "must be above " + number(no_stiffness * whole)
                + "; fix the specimen against the applied loads");
    }

    const Assembly& a;
    const ElasticLoading& loading;
    const OneSidedPoints& points;
    const Bearing& bearing;
    Assembly trial;
    std::vector<StaticCase> cases;
    std::vector<FreeWay> free;
    std::vector<Motion> motions;  ///< of the cases; the first one becomes the whole
};

}  // namespace

void Motion::add(const Motion& other, double factor)
{
    for (std::size_t i = 0; i < displacement.size(); ++i) {
        displacement[i] += factor * other.displacement[i];
        force[i] += factor * other.force[i];
    }
    for (std::size_t i = 0; i < plates.size(); ++i) {
        plates[i].displacement = plates[i].displacement + factor * other.plates[i].displacement;
        plates[i].turn += factor * other.plates[i].turn;
        gives[i] += factor * other.gives[i];
    }
    for (std::size_t i = 0; i < angles.size(); ++i)
        angles[i] += factor * other.angles[i];
    way += factor * other.way;
}

Motion between(const Motion& from, const Motion& to, double part)
{
    Motion found = from;
    found.add(from, -part);
    found.add(to, part);
    return found;
}

double largest(const Array<double>& displacements)
{
    double found = 0.0;
    for (double v : displacements) {
        if (!std::isfinite(v))
            fail("find_elastic_state: displacement", number(v) + " m",
                "must be finite; give a smaller displacement, load or pressure");
        found = std::max(found, std::fabs(v));
    }
    return found;
}

double load_of(const Assembly& a, const ElasticLoading& loading)
{
    double sum = 0.0;
    for (int p : loading.plates)
        sum += dot(a.plates[p].force, loading.direction);
    for (int s : loading.sets)
        sum +=
            dot(a.node_sets[s].force, loading.direction) + loading.turn * a.node_sets[s].moment.z;
    for (int s : loading.back_sets)
        sum -= loading.turn * a.node_sets[s].moment.z;
    return sum;
}

Assembly state_after(
    const Assembly& a, const OneSidedPoints& points, const Bearing& bearing, const Motion& m)
{
    Assembly s = a;
    set_forces(points, bearing, m, s);
    points.for_each_point([&](int c, int p) {
        const Point n = bonded_normal(a, c),
                    way = relative_velocity(a.contacts, c, p, m.displacement);
        PointState state = a.contacts.point_state(c, p);
        state.opening += dot(n, way);
        state.slip += dot(tangent_of(n), way);
        state.shear_traction = points.traction(bearing, c, p, way).shear;
        s.contacts.set_point_state(c, p, state);
    });
    for (std::size_t i = 0; i < s.grains.displacement.size(); ++i)
        s.grains.displacement[i] += m.displacement[i];
    for (std::size_t i = 0; i < s.plates.size(); ++i) {
        for (int k = 0; k < plate_points(s.plates[i]); ++k)
            s.plates[i].points[k].opening = points.gap(i, k, m.displacement, m.plates[i]);
        s.plates[i].displacement = s.plates[i].displacement + m.plates[i].displacement;
        s.plates[i].turn.z += m.plates[i].turn;
        s.plates[i].machine_give -= m.gives[i];
    }
    for (std::size_t i = 0; i < s.node_sets.size(); ++i)
        s.node_sets[i].angle.z += m.angles[i];
    return s;
}

double energy_growth(const Assembly& a, const ElasticLoading& loading, const OneSidedPoints& points,
    const Bearing& sticking, const Motion& m, const Motion& step)
{
    Bearing bearing = sticking;
    bearing.closed = points.closed(m.displacement, m.plates, largest(m.displacement));
    const Array<double> more = points.more_force(bearing, m.displacement, m.plates);
    double growth = loading.load ? -*loading.load * step.way : 0.0;
    for (std::size_t i = 0; i < more.size(); ++i)
        growth -= (m.force[i] + more[i]) * step.displacement[i];
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        const Plate& p = a.plates[i];
        const PlatePush push = points.plate_push(bearing, i, m.displacement, m.plates[i]);
        growth += dot(push.force, step.plates[i].displacement) + push.moment * step.plates[i].turn;
        if (p.loaded)
            growth -= p.load * dot(p.normal, step.plates[i].displacement);
        else
            growth -= p.machine_stiffness * (p.machine_give - m.gives[i]) * step.gives[i];
    }
    return growth;
}

Motion solve_motion(const Assembly& a, const ElasticLoading& loading, const OneSidedPoints& points,
    const Bearing& bearing)
{
    return Solution(a, loading, points, bearing).take();
}

}  // namespace flexpm
