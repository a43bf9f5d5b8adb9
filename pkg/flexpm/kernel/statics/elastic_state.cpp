// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/elastic_state.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/contact_forces.hpp>
#include <flexpm/kernel/forces/element_forces.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/nodal_forces.hpp>
#include <flexpm/kernel/forces/node_sets.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/motion/centre_motion.hpp>
#include <flexpm/kernel/statics/one_sided_points.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {

namespace {

/// Part of its stiffness that an open point keeps while others are looked at: it keeps what nothing
/// touches yet in its place. The last solution is without.
constexpr double loose = 1e-6;

/// Solutions after which points must have settled.
constexpr int most_solutions = 60;

/// Stiffness of a plate over that of its springs which is none [-].
constexpr double no_stiffness = 1e-9;

/// Forces of all kinds at the present displacements, of a state that stands still.
void refresh_forces(Assembly& a)
{
    std::fill(a.grains.velocity.begin(), a.grains.velocity.end(), 0.0);
    std::fill(a.grains.spin.begin(), a.grains.spin.end(), 0.0);
    for (Plate& p : a.plates)
        p.velocity = {};
    for (NodeSet& set : a.node_sets) {
        set.velocity = {};
        set.spin = {};
    }
    for (int b = 0; b < a.grains.blocks(); ++b)
        predict_centres(a.grains, b, 1.0, a.plan.next_centre);
    for (int b = 0; b < a.facets.blocks(); ++b)
        update_facet_block(a, b, 1.0);
    std::vector<char> loaded;  // plates that a load would move stand still, too
    for (Plate& p : a.plates) {
        loaded.push_back(p.loaded);
        p.loaded = false;
    }
    update_plates(a, 1.0, 0.0);
    for (std::size_t i = 0; i < loaded.size(); ++i)
        a.plates[i].loaded = loaded[i];
    update_contact_blocks(a, 0, a.contacts.blocks(), 1.0);
    for (int b = 0; b < a.grains.blocks(); ++b) {
        sum_forces(a, b);
        if (a.has_gravity()) add_weight(a, b);
        if (!a.grains.group(b).rigid) add_element_forces(a.grains, b, false);
    }
}

void apply(Assembly& a, const ElasticLoading& loading)
{
    for (const auto& [number, pressure] : loading.pressures) {
        require_plate(a, number);
        check_not_negative("pressure on a plate", pressure, "Pa");
        a.plates[number].loaded = true;
        a.plates[number].load = a.area_of(pressure * a.plates[number].width);
    }
    for (int number : loading.plates) {
        require_plate(a, number);
        a.plates[number].loaded = false;  // the loading has taken it over
    }
}

/// Components that are held or driven, at a way of what is driven.
std::vector<Prescribed> prescribed_at(const Assembly& a, const ElasticLoading& loading, double way)
{
    const Grains& grains = a.grains;
    Array<double> value(grains.displacement.size(), 0.0);
    std::vector<std::uint8_t> given(grains.prescribed.begin(), grains.prescribed.end());
    const auto drive = [&](int number, double sense) {
        const NodeSet& set = a.node_sets.at(number);
        for (int node : set.nodes) {
            const Vector arm = grains.position(node) - set.pivot;
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

/// Displacements from the present state, and the forces of its nodes there.
struct Motion {
    Array<double> displacement, force;
    std::vector<PlateWay> plates;
    std::vector<double> gives;  ///< of the springs of machines, what they are longer by
    std::vector<double> angles;
    double way = 0.0;

    void add(const StaticSolution& s, const StaticCase& of, double factor)
    {
        for (std::size_t i = 0; i < displacement.size(); ++i) {
            displacement[i] += factor * s.displacement[i];
            force[i] += factor * s.force[i];
        }
        for (std::size_t i = 0; i < plates.size(); ++i) {
            plates[i].displacement = plates[i].displacement + factor * of.plates[i];
            plates[i].turn += factor * of.turns[i];
        }
        for (std::size_t i = 0; i < angles.size(); ++i)
            angles[i] += factor * of.angles[i];
    }
};

/// @throws std::runtime_error  if a displacement is not finite
double largest(const Array<double>& displacements)
{
    double found = 0.0;
    for (double v : displacements) {
        if (!std::isfinite(v))
            fail("find_elastic_state: displacement", number(v) + " m",
                "must be a finite number; give a smaller way, load or pressure");
        found = std::max(found, std::fabs(v));
    }
    return found;
}

/// Forces after a motion, at the places from which it is linear.
void set_forces(const OneSidedPoints& points, const Closed& closed, const Assembly& trial,
    const Motion& m, Assembly& s)
{
    s.grains.force = m.force;
    for (std::size_t i = 0; i < s.plates.size(); ++i)
        s.plates[i].force = points.plate_push(closed, trial, i, m.displacement, m.plates[i]).force;
    update_node_sets(s, 1.0, 0.0);  // their velocities are zero: forces alone
}

/// State after a motion.
Assembly state_after(const Assembly& a, const OneSidedPoints& points, const Closed& closed,
    const Assembly& trial, const Motion& m)
{
    Assembly s = a;
    set_forces(points, closed, trial, m, s);
    points.for_each_point([&](int c, int p) {
        const Point n = bonded_normal(a, c),
                    way = relative_velocity(a.contacts, c, p, m.displacement);
        PointState state = a.contacts.point_state(c, p);
        state.opening += dot(n, way);
        state.slip += dot(tangent_of(n), way);
        state.shear_traction = points.traction(closed, c, p, way).shear;
        s.contacts.set_point_state(c, p, state);
    });
    for (std::size_t i = 0; i < s.grains.displacement.size(); ++i)
        s.grains.displacement[i] += m.displacement[i];
    for (std::size_t i = 0; i < s.plates.size(); ++i) {
        for (int k = 0; k < plate_points(s.plates[i]); ++k)
            s.plates[i].opening[k] = points.gap(i, k, m.displacement, m.plates[i]);
        s.plates[i].displacement = s.plates[i].displacement + m.plates[i].displacement;
        s.plates[i].angle += m.plates[i].turn;
        s.plates[i].machine_give -= m.gives[i];
    }
    for (std::size_t i = 0; i < s.node_sets.size(); ++i)
        s.node_sets[i].angle.z += m.angles[i];
    return s;
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

/// A plate whose way along its normal, or whose turn, is to be found.
struct FreeWay {
    int plate;
    bool turns;
};

/// Turn of a plate that moves the ends of its face by 1 m [rad].
double unit_turn(const Plate& plate) { return 2.0 / plate.width; }

/// One solution with points open and closed as they are: the plates under a load, in a soft machine
/// or on a seat, and what is driven by a load, find their way.
class Solution {
public:
    Solution(const Assembly& a, const ElasticLoading& loading, const OneSidedPoints& points,
        const Closed& closed, double kept) :
        a(a),
        loading(loading),
        points(points),
        closed(closed),
        trial(a)
    {
        points.loosen_plates(closed, kept, trial);
        const Array<double> forces = points.forces(closed, trial);
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
        found = solve_static_cases(trial, cases, points.springs(closed, kept));
        motion.displacement.assign(forces.size(), 0.0);
        motion.force = forces;
        motion.plates.resize(a.plates.size());
        motion.gives.assign(a.plates.size(), 0.0);
        motion.angles.assign(a.node_sets.size(), 0.0);
        motion.add(found.front(), cases.front(), 1.0);
        motion.way = loading.load ? 0.0 : loading.way;
        if (cases.size() > 1) find_ways();
    }

    Assembly state() const { return state_after(a, points, closed, trial, motion); }

    const Motion& moved() const { return motion; }

private:
    void let_go(FreeWay way)
    {
        free.push_back(way);
        cases.push_back(case_at(a, loading, 0.0));
    }

    /// What each way must bring about, less what a motion does.
    Eigen::VectorXd missing(const Motion& m) const
    {
        Eigen::VectorXd out(static_cast<Eigen::Index>(cases.size() - 1));
        Eigen::Index row = 0;
        for (const auto& [i, turns] : free) {
            const Plate& p = a.plates[i];
            const PlatePush push = points.plate_push(closed, trial, i, m.displacement, m.plates[i]);
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
            set_forces(points, closed, trial, m, loaded);
            out[row] = *loading.load - load_of(loaded, loading);
        }
        return out;
    }

    /// Add a part of a case that lets one of them go its way.
    void add_way(Motion& m, Eigen::Index which, double factor) const
    {
        m.add(found[which + 1], cases[which + 1], factor);
        if (which < static_cast<Eigen::Index>(free.size()) && !free[which].turns)
            m.gives[free[which].plate] += factor;
    }

    void find_ways()
    {
        const Eigen::VectorXd base = missing(motion);
        Eigen::MatrixXd stiffness(base.size(), base.size());
        for (Eigen::Index j = 0; j < base.size(); ++j) {
            Motion one = motion;
            add_way(one, j, 1.0);
            stiffness.col(j) = base - missing(one);
        }
        require_resistance(stiffness);
        const Eigen::VectorXd ways = stiffness.fullPivLu().solve(base);
        for (Eigen::Index j = 0; j < ways.size(); ++j)
            add_way(motion, j, ways[j]);
        if (loading.load) motion.way = ways[ways.size() - 1];
    }

    void require_resistance(const Eigen::MatrixXd& stiffness) const
    {
        const double whole = stiffness.cwiseAbs().maxCoeff();
        const auto lu = stiffness.fullPivLu();
        const double least = lu.matrixLU().diagonal().cwiseAbs().minCoeff();
        if (least > no_stiffness * whole) return;
        fail("find_elastic_state: resistance to pressed or driven parts", number(least) + " N/m",
            "must be above " + number(no_stiffness * whole)
                + "; hold the specimen against what presses on it");
    }

    const Assembly& a;
    const ElasticLoading& loading;
    const OneSidedPoints& points;
    const Closed& closed;
    Assembly trial;
    std::vector<StaticCase> cases;
    std::vector<FreeWay> free;
    std::vector<StaticSolution> found;
    Motion motion;
};

int count_beyond_friction(const Assembly& s, const OneSidedPoints& points)
{
    int count = 0;
    points.for_each_point([&](int c, int p) {
        const LawParameters& law = s.contacts.law_of(c);
        if (damage_of(s.contacts, c, p) < 1.0) return;
        const PointTraction t = traction_of(s.contacts, c, p);
        count += std::fabs(t.shear) > (1.0 + no_gap) * law.friction * std::max(-t.normal, 0.0);
    });
    return count;
}

}  // namespace

ElasticState find_elastic_state(const Assembly& a, const ElasticLoading& loading)
{
    check_finite("way of what is driven", loading.way, loading.turn != 0.0 ? "rad" : "m");
    check_finite("load of what is driven", loading.load.value_or(0.0), "N");
    if (!a.held_edges.empty())
        refuse("held edges of rigid grains", static_cast<double>(a.held_edges.size()), "",
            "must be none; hold nodes");
    Assembly now = a;
    apply(now, loading);
    refresh_forces(now);
    const OneSidedPoints points(now);
    const std::vector<PlateWay> still(now.plates.size());
    const Array<double> none(now.grains.displacement.size(), 0.0);
    Closed closed = points.closed(none, still, now.grains.radius.front());
    for (int solutions = 1; solutions < most_solutions; ++solutions) {
        const Solution tried(now, loading, points, closed, loose);
        const Motion& m = tried.moved();
        Closed next = points.closed(m.displacement, m.plates, largest(m.displacement));
        if (!(next == closed)) {
            closed = std::move(next);
            continue;
        }
        const Solution last(now, loading, points, closed, 0.0);
        largest(last.moved().displacement);
        ElasticState found { last.state(), last.moved().way, 0.0, solutions + 1, 0 };
        found.load = load_of(found.state, loading);
        for (int set : loading.sets) {
            Vector& moved = found.state.node_sets[set].displacement;
            moved = moved + found.way * loading.direction;
        }
        found.beyond_friction = count_beyond_friction(found.state, points);
        return found;
    }
    fail("find_elastic_state: solutions", number(most_solutions),
        "must be fewer until contacts stay open or closed; give a smaller way or load");
}

}  // namespace flexpm
