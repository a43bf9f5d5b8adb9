// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/elastic_state.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/centre_motion.hpp>
#include <flexpm/kernel/plane_lanes/contact_forces.hpp>
#include <flexpm/kernel/plane_lanes/element_forces.hpp>
#include <flexpm/kernel/plane_lanes/nodal_forces.hpp>
#include <flexpm/kernel/statics/elastic_solution.hpp>
#include <flexpm/kernel/statics/one_sided_points.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {

namespace {

/// Part of a way less for which a point sticks that is none [-].
constexpr double no_change = 1e-4;

/// Solutions after which points must have settled.
constexpr int most_solutions = 300;

/// Halvings of a step, to where the energy is least along it.
constexpr int most_halvings = 40;

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

/// The search for points that are open or closed as their solution has them, and stick while
/// closed.
///
/// At first all points take over what a solution says. With what sticks given, the energy is convex
/// and in pieces of second order, so that Newton's steps, each to where the energy is least along
/// it, end. A point that sticks, and opens by what it then bears, leaves those that stick, once and
/// for all, and slides while it is closed: that ends, too.
class Search {
public:
    Search(const Assembly& a, const ElasticLoading& loading) : a(a), loading(loading), points(a) { }

    ElasticState state()
    {
        const std::vector<PlateWay> still(a.plates.size());
        const Array<double> none(a.grains.displacement.size(), 0.0);
        now.closed = points.closed(none, still, a.grains.radius.front());
        now.sticks = points.sticking(now.closed, none, still);
        now.kept = open_share;
        for (int solutions = 1; solutions < most_solutions; ++solutions) {
            if (goes_on(solutions <= most_plain_solutions)) continue;
            now.kept = 0.0;
            const Motion last = solve_motion(a, loading, points, now);
            largest(last.displacement);
            return { state_after(a, points, now, last), last.way, 0.0, solutions + 1, 0 };
        }
        fail("find_elastic_state: solutions", number(most_solutions),
            "must suffice until no contact opens or closes; give a smaller displacement or load");
    }

    int count_beyond_friction(const Assembly& s) const
    {
        int count = 0;
        points.for_each_point([&](int c, int p) {
            const int at = points.index_of(c, p);
            if (!now.closed[at] || !points.rubs(c, p)) return;
            const PointTraction t = traction_of(s.contacts, c, p);
            const double limit =
                (1.0 + no_gap) * friction_of(s.contacts, c, p) * std::max(-t.normal, 0.0);
            count += now.sticks[at] == 0.0 || std::fabs(t.shear) > limit;
        });
        return count;
    }

private:
    /// One solution more; returns whether it has changed what bears.
    bool goes_on(bool plain)
    {
        Motion next = solve_motion(a, loading, points, now);
        bool there = false;
        if (!plain) {
            Motion step = next;
            step.add(at, -1.0);
            there = largest(step.displacement) <= no_gap * largest(next.displacement);
            if (energy_growth(a, loading, points, now, next, step) > 0.0)
                next = between(at, next, least_along(next, step));
        }
        at = std::move(next);
        PointMarks closed = points.closed(at.displacement, at.plates, largest(at.displacement));
        const bool changed = !(closed == now.closed);
        now.closed = std::move(closed);
        if (!plain && changed && !there) return true;
        return let_stick(!plain) || changed;
    }

    /// Part of a step after which the energy grows along it.
    double least_along(const Motion& end, const Motion& step) const
    {
        double low = 0.0, high = 1.0;
        for (int halving = 0; halving < most_halvings; ++halving) {
            const double middle = 0.5 * (low + high);
            const Motion m = between(at, end, middle);
            (energy_growth(a, loading, points, now, m, step) > 0.0 ? high : low) = middle;
        }
        return high;
    }

    /// Let points stick as they are closed; returns whether that is new.
    ///
    /// @param for_good  those that open although they stick will not stick again
    bool let_stick(bool for_good)
    {
        std::vector<double> sticks = points.sticking(now.closed, at.displacement, at.plates);
        left.resize(sticks.size(), 0);
        bool changed = false;
        for (std::size_t i = 0; i < sticks.size(); ++i) {
            if (for_good && now.sticks[i] > 0.0 && !now.closed[i]) left[i] = 1;
            if (left[i]) sticks[i] = 0.0;
            changed = changed || std::fabs(sticks[i] - now.sticks[i]) > no_change;
        }
        now.sticks = std::move(sticks);
        return changed;
    }

    const Assembly& a;
    const ElasticLoading& loading;
    const OneSidedPoints points;
    Bearing now;
    Motion at;        ///< so far
    PointMarks left;  ///< points that opened although they stuck
};

}  // namespace

ElasticState find_elastic_state(const Assembly& a, const ElasticLoading& loading)
{
    check_finite("way of what is driven", loading.way, loading.turn != 0.0 ? "rad" : "m");
    check_finite("load of what is driven", loading.load.value_or(0.0), "N");
    if (!a.held_edges.empty())
        refuse("held edges of rigid grains", static_cast<double>(a.held_edges.size()), "",
            "must be 0; fix nodes instead");
    Assembly now = a;
    apply(now, loading);
    refresh_forces(now);
    Search search(now, loading);
    ElasticState found = search.state();
    found.load = load_of(found.state, loading);
    for (int set : loading.sets) {
        Vector& moved = found.state.node_sets[set].displacement;
        moved = moved + found.way * loading.direction;
    }
    found.beyond_friction = search.count_beyond_friction(found.state);
    return found;
}

}  // namespace flexpm
