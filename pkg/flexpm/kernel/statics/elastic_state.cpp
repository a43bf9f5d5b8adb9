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
#include <flexpm/kernel/statics/static_solve.hpp>

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

/// Gap over the largest displacement, or over a grain's radius, that is round-off [-].
constexpr double round_off = 1e-10;

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
        set.spin = 0.0;
    }
    for (int b = 0; b < a.grains.blocks(); ++b)
        predict_centres(a.grains, b, 1.0, a.plan.next_centre);
    for (int b = 0; b < a.facets.blocks(); ++b)
        update_facet_block(a, b, 1.0);
    std::vector<double> loads;
    for (Plate& p : a.plates) {
        loads.push_back(p.loaded ? p.load : -1.0);
        p.loaded = false;
    }
    update_plates(a, 1.0, 0.0);
    for (std::size_t i = 0; i < loads.size(); ++i)
        a.plates[i].loaded = loads[i] >= 0.0;
    update_contact_blocks(a, 0, a.contacts.blocks(), 1.0);
    for (int b = 0; b < a.grains.blocks(); ++b) {
        sum_forces(a, b);
        if (a.gravity.x != 0.0 || a.gravity.y != 0.0) add_weight(a, b);
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

/// Whether a plate is pressed by nothing: it gives way to all that would push it.
bool is_idle(const Plate& plate) { return plate.loaded && plate.load == 0.0 && !plate.bonded; }

/// Whether each point that can be open is closed.
struct Closed {
    std::vector<char> contacts;             ///< [contact * points + point]
    std::vector<std::vector<char>> plates;  ///< [plate][point]

    bool operator==(const Closed& other) const
    {
        return contacts == other.contacts && plates == other.plates;
    }
};

class Balance {
public:
    explicit Balance(const Assembly& a) : a(a), points(a.contacts.group.points) { }

    /// Gaps of the present state and of displacements from it; `size` is that of these.
    Closed closed(const Array<double>& moved, const std::vector<Point>& plates, double size) const
    {
        Closed found;
        const double none = round_off * size;
        found.contacts.assign(static_cast<std::size_t>(a.contacts.count) * points, 0);
        for_each_point([&](int c, int p) {
            const double gap = gap_of(c, p) + dot(bonded_normal(a, c), way_of(c, p, moved));
            found.contacts[c * points + p] = gap <= none || damage_of(a.contacts, c, p) <= 0.0;
        });
        for (std::size_t i = 0; i < a.plates.size(); ++i) {
            const Plate& plate = a.plates[i];
            found.plates.emplace_back();
            for (int k = 0; k < plate_points(plate); ++k) {
                const double gap = plate.opening[k]
                    + dot(plate.normal, way_of(plate_point(plate, k), moved) - plates[i]);
                found.plates.back().push_back(plate.bonded || (gap <= none && !is_idle(plate)));
            }
        }
        return found;
    }

    PointSprings springs(const Closed& now, double kept) const
    {
        PointSprings found(now.contacts.size());
        for_each_point([&](int c, int p) { found[c * points + p] = spring(now, c, p, kept); });
        return found;
    }

    /// Take what open points of plates keep of their stiffness.
    void loosen_plates(const Closed& now, double kept, Assembly& trial) const
    {
        for (std::size_t i = 0; i < a.plates.size(); ++i) {
            for (std::size_t k = 0; k < now.plates[i].size(); ++k) {
                trial.plates[i].area[k] = (now.plates[i][k] ? 1.0 : kept) * a.plates[i].area[k];
            }
        }
    }

    /// Forces on the nodes at the present displacements, if points are open and closed like that.
    Array<double> forces(const Closed& now, const Assembly& trial) const
    {
        Array<double> found = a.grains.force;
        for_each_point([&](int c, int p) {
            const PointTraction before = traction_of(a.contacts, c, p);
            const Point n = bonded_normal(a, c);
            const PointTraction after = traction(now, c, p, {});
            const Point more =
                (after.normal - before.normal) * n + (after.shear - before.shear) * tangent_of(n);
            for (int side = 0; side < 2; ++side) {
                const double w = a.contacts.weight(c, p, side), sign = side == 0 ? 1.0 : -1.0;
                const double area = sign * a.contacts.area(c, p);
                add(found, a.contacts.node(c, side, 0), (1.0 - w) * area * more);
                add(found, a.contacts.node(c, side, 1), w * area * more);
            }
        });
        for (std::size_t i = 0; i < a.plates.size(); ++i) {
            for (int k = 0; k < plate_points(a.plates[i]); ++k) {
                const PlatePoint p = plate_point(a.plates[i], k);
                const Point more = plate_force(now, trial, i, k, {}) - point_force(a.plates[i], k);
                const auto n = a.facets.nodes(p.facet);
                add(found, n[0], (1.0 - p.weight) * more);
                add(found, n[1], p.weight * more);
            }
        }
        return found;
    }

    /// Traction of a point after a way from the present state.
    PointTraction traction(const Closed& now, int c, int p, Point way) const
    {
        const PointSpring k = spring(now, c, p, 0.0);
        const Point n = bonded_normal(a, c);
        const double shear = a.contacts.point_state(c, p).shear_traction;
        return { k.normal * (gap_of(c, p) + dot(n, way)),
            (k.shear == 0.0 ? 0.0 : shear) + k.shear * dot(tangent_of(n), way) };
    }

    /// Force of a plate's point on the specimen after a way of the grain beside it from the plate.
    Point plate_force(
        const Closed& now, const Assembly& trial, std::size_t i, int k, Point way) const
    {
        const Plate& plate = a.plates[i];
        const PlatePoint p = plate_point(trial.plates[i], k);
        const Point t = tangent_of(plate.normal);
        const double kept = now.plates[i][k] ? plate.shear_force[k] : 0.0;
        return -p.stiffness * (plate.opening[k] + dot(plate.normal, way)) * plate.normal
            + (kept - p.shear_stiffness * dot(t, way)) * t;
    }

    /// Force of a plate on the specimen after displacements from the present state.
    Point plate_force(const Closed& now, const Assembly& trial, std::size_t i,
        const Array<double>& moved, Point displacement) const
    {
        Point sum;
        for (int k = 0; k < plate_points(a.plates[i]); ++k) {
            const Point way = way_of(plate_point(a.plates[i], k), moved) - displacement;
            sum = sum + plate_force(now, trial, i, k, way);
        }
        return sum;
    }

    /// Calls visit(contact, point) for all that bear.
    template <class Visit> void for_each_point(const Visit& visit) const
    {
        for (int c = 0; c < a.contacts.count; ++c) {
            for (int p = 0; !a.contacts.erased[c] && p < a.contacts.points_of(c); ++p)
                if (a.contacts.area(c, p) > 0.0) visit(c, p);
        }
    }

    Point way_of(int contact, int point, const Array<double>& moved) const
    {
        return relative_velocity(a.contacts, contact, point, moved);
    }
    Point way_of(const PlatePoint& p, const Array<double>& moved) const
    {
        return vector_on_edge(moved, a.facets.nodes(p.facet), p.weight);
    }

private:
    static void add(Array<double>& to, int node, Point force)
    {
        set_vector(to, node, vector_at(to, node) + force);
    }

    double gap_of(int contact, int point) const
    {
        return law::gap(a.contacts.law_of(contact), a.contacts.point_state(contact, point));
    }

    PointSpring spring(const Closed& now, int c, int p, double kept) const
    {
        const LawParameters& law = a.contacts.law_of(c);
        const double damage = damage_of(a.contacts, c, p);
        const bool shut = now.contacts[c * points + p];
        if (damage <= 0.0) return { law.normal_stiffness, law.shear_stiffness };
        if (damage < 1.0) {
            const double open = law::secant(law, a.contacts.point_state(c, p).max_opening, damage);
            return { shut ? law.normal_stiffness : open, law.shear_stiffness };
        }
        if (!shut) return { kept * law.normal_stiffness, kept * law.shear_stiffness };
        return { law.normal_stiffness, (law.friction > 0.0 ? 1.0 : kept) * law.shear_stiffness };
    }

    const Assembly& a;
    const int points;
};

/// Components that are held or driven, at a way of what is driven.
std::vector<Prescribed> prescribed_at(const Assembly& a, const ElasticLoading& loading, double way)
{
    const Grains& grains = a.grains;
    Array<double> value(grains.displacement.size(), 0.0);
    std::vector<std::uint8_t> given(grains.prescribed.begin(), grains.prescribed.end());
    const auto drive = [&](int number, double sense) {
        const NodeSet& set = a.node_sets.at(number);
        for (int node : set.nodes) {
            const Point arm = grains.position(node) - set.pivot;
            const Point v =
                way * loading.direction + sense * loading.turn * way * Point { -arm.y, arm.x };
            set_vector(value, node, v);
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
    std::vector<Point> plates;
    std::vector<double> angles;
    double way = 0.0;

    void add(const StaticSolution& s, const StaticCase& of, double factor)
    {
        for (std::size_t i = 0; i < displacement.size(); ++i) {
            displacement[i] += factor * s.displacement[i];
            force[i] += factor * s.force[i];
        }
        for (std::size_t i = 0; i < plates.size(); ++i)
            plates[i] = plates[i] + factor * of.plates[i];
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
void set_forces(const Balance& balance, const Closed& closed, const Assembly& trial,
    const Motion& m, Assembly& s)
{
    s.grains.force = m.force;
    for (std::size_t i = 0; i < s.plates.size(); ++i)
        s.plates[i].force = balance.plate_force(closed, trial, i, m.displacement, m.plates[i]);
    update_node_sets(s, 1.0, 0.0);  // their velocities are zero: forces alone
}

/// State after a motion.
Assembly state_after(const Assembly& a, const Balance& balance, const Closed& closed,
    const Assembly& trial, const Motion& m)
{
    Assembly s = a;
    set_forces(balance, closed, trial, m, s);
    balance.for_each_point([&](int c, int p) {
        const Point n = bonded_normal(a, c), way = balance.way_of(c, p, m.displacement);
        PointState state = a.contacts.point_state(c, p);
        state.opening += dot(n, way);
        state.slip += dot(tangent_of(n), way);
        state.shear_traction = balance.traction(closed, c, p, way).shear;
        s.contacts.set_point_state(c, p, state);
    });
    for (std::size_t i = 0; i < s.grains.displacement.size(); ++i)
        s.grains.displacement[i] += m.displacement[i];
    for (std::size_t i = 0; i < s.plates.size(); ++i)
        s.plates[i].displacement = s.plates[i].displacement + m.plates[i];
    for (std::size_t i = 0; i < s.node_sets.size(); ++i)
        s.node_sets[i].angle += m.angles[i];
    return s;
}

double load_of(const Assembly& a, const ElasticLoading& loading)
{
    double sum = 0.0;
    for (int p : loading.plates)
        sum += dot(a.plates[p].force, loading.direction);
    for (int s : loading.sets)
        sum += dot(a.node_sets[s].force, loading.direction) + loading.turn * a.node_sets[s].moment;
    for (int s : loading.back_sets)
        sum -= loading.turn * a.node_sets[s].moment;
    return sum;
}

/// One solution with points open and closed as they are: the plates under a load, and what is
/// driven by one, find their way.
class Solution {
public:
    Solution(const Assembly& a, const ElasticLoading& loading, const Balance& balance,
        const Closed& closed, double kept) :
        a(a),
        loading(loading),
        balance(balance),
        closed(closed),
        trial(a)
    {
        balance.loosen_plates(closed, kept, trial);
        const Array<double> forces = balance.forces(closed, trial);
        cases.push_back(case_at(a, loading, loading.load ? 0.0 : loading.way));
        cases.front().loads = &forces;
        for (std::size_t i = 0; i < a.plates.size(); ++i) {
            if (!a.plates[i].loaded || is_idle(a.plates[i])) continue;
            pressed.push_back(static_cast<int>(i));
            cases.push_back(case_at(a, loading, 0.0));
            cases.back().plates[i] = a.plates[i].normal;
        }
        if (loading.load) cases.push_back(case_at(a, loading, 1.0));
        found = solve_static_cases(trial, cases, balance.springs(closed, kept));
        motion.displacement.assign(forces.size(), 0.0);
        motion.force = forces;
        motion.plates.resize(a.plates.size());
        motion.angles.assign(a.node_sets.size(), 0.0);
        motion.add(found.front(), cases.front(), 1.0);
        motion.way = loading.load ? 0.0 : loading.way;
        if (cases.size() > 1) find_ways();
    }

    Assembly state() const { return state_after(a, balance, closed, trial, motion); }

    const Motion& moved() const { return motion; }

private:
    /// What each way must bring about, less what a motion does.
    Eigen::VectorXd missing(const Motion& m) const
    {
        Eigen::VectorXd out(static_cast<Eigen::Index>(cases.size() - 1));
        Eigen::Index row = 0;
        for (int i : pressed) {
            const Point force = balance.plate_force(closed, trial, i, m.displacement, m.plates[i]);
            out[row++] = a.plates[i].load - dot(a.plates[i].normal, force);
        }
        if (loading.load) {
            Assembly loaded = a;
            set_forces(balance, closed, trial, m, loaded);
            out[row] = *loading.load - load_of(loaded, loading);
        }
        return out;
    }

    void find_ways()
    {
        const Eigen::VectorXd base = missing(motion);
        Eigen::MatrixXd stiffness(base.size(), base.size());
        for (Eigen::Index j = 0; j < base.size(); ++j) {
            Motion one = motion;
            one.add(found[j + 1], cases[j + 1], 1.0);
            stiffness.col(j) = base - missing(one);
        }
        require_resistance(stiffness);
        const Eigen::VectorXd ways = stiffness.fullPivLu().solve(base);
        for (Eigen::Index j = 0; j < ways.size(); ++j)
            motion.add(found[j + 1], cases[j + 1], ways[j]);
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
    const Balance& balance;
    const Closed& closed;
    Assembly trial;
    std::vector<StaticCase> cases;
    std::vector<int> pressed;
    std::vector<StaticSolution> found;
    Motion motion;
};

int count_beyond_friction(const Assembly& s, const Balance& balance)
{
    int count = 0;
    balance.for_each_point([&](int c, int p) {
        const LawParameters& law = s.contacts.law_of(c);
        if (damage_of(s.contacts, c, p) < 1.0) return;
        const PointTraction t = traction_of(s.contacts, c, p);
        count += std::fabs(t.shear) > (1.0 + round_off) * law.friction * std::max(-t.normal, 0.0);
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
    const Balance balance(now);
    const std::vector<Point> still(now.plates.size());
    const Array<double> none(now.grains.displacement.size(), 0.0);
    Closed closed = balance.closed(none, still, now.grains.radius.front());
    for (int solutions = 1; solutions < most_solutions; ++solutions) {
        const Solution tried(now, loading, balance, closed, loose);
        const Motion& m = tried.moved();
        Closed next = balance.closed(m.displacement, m.plates, largest(m.displacement));
        if (!(next == closed)) {
            closed = std::move(next);
            continue;
        }
        const Solution last(now, loading, balance, closed, 0.0);
        largest(last.moved().displacement);
        ElasticState found { last.state(), last.moved().way, 0.0, solutions + 1, 0 };
        found.load = load_of(found.state, loading);
        for (int set : loading.sets) {
            Point& moved = found.state.node_sets[set].displacement;
            moved = moved + found.way * loading.direction;
        }
        found.beyond_friction = count_beyond_friction(found.state, balance);
        return found;
    }
    fail("find_elastic_state: solutions", number(most_solutions),
        "must be fewer until contacts stay open or closed; give a smaller way or load");
}

}  // namespace flexpm
