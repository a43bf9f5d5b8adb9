// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Numbering of the unknowns, their equations and the sparse factorisation.
#include <flexpm/kernel/statics/static_solve.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace flexpm {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower>;

/// A pivot below this share of its diagonal term is round-off: the part it belongs to moves freely.
constexpr double smallest_pivot = 1e-10;

/// Forces on the nodes when the plates are displaced and turned and the grains are not.
void add_plate_loads(
    const Assembly& a, const StaticCase& of, const GivenSprings& springs, Array<double>& loads)
{
    for (std::size_t number = 0; number < a.plates.size(); ++number) {
        const Plate& plate = a.plates[number];
        const PlateLag lag = plate_lag(a, plate, of.plates[number], nullptr);
        const double turn = of.turns.empty() ? 0.0 : of.turns[number];
        for (int i = 0; i < plate_points(plate); ++i) {
            const EdgePoint p = edge_point(plate, i);
            const StiffnessBlock k = springs.plates.empty()
                ? plate_springs(plate, i)
                : plate_springs(plate, i, springs.plates[number][i]);
            Vector u = point_way(plate, i, of.plates[number], lag);
            if (turn != 0.0) u = u + turn * seat_arm(plate, i).z * point_normal(plate, i);
            const auto n = a.facets.nodes(p.facet);
            const auto part = facet_parts(p.weight);
            for (int r = 0; r < facet_nodes; ++r) {
                loads[n[r]] += part[r] * (k.xx * u.x + k.xy * u.y);
                loads[a.grains.component(n[r], 1)] += part[r] * (k.yx * u.x + k.yy * u.y);
            }
        }
    }
}

/// Kind of an entry of Assembly::displacement, or of the rotation of a slot, in the solve.
enum class Kind : std::uint8_t {
    padding,     ///< belongs to no node
    unknown,     ///< to be found
    prescribed,  ///< has its given value
    follower     ///< follows the centre of its rigid grain
};

/// Part of a node's displacement: another entry times a factor.
struct Term {
    int index;
    double factor;
};

/// Numbers of the unknowns. Entries are those of Assembly::displacement, and behind them the
/// rotation of each slot and of each node set.
struct Unknowns {
    std::vector<Kind> kind;   ///< per entry
    std::vector<int> number;  ///< per entry that is unknown: its number
    std::vector<int> index;   ///< per unknown: its entry
    std::vector<Term> lever;  ///< per entry that follows a rotation: index and arm
    std::vector<int> leader;  ///< per entry that follows: that of a centre, or of a set
};

/// Call visit(index, factor) for each entry that this one is made of.
///
/// A node follows the centre of its rigid grain, which may follow the first one of its set.
template <class Visit> void for_each_term(const Unknowns& n, int entry, const Visit& visit)
{
    if (n.kind[entry] != Kind::follower) {
        visit(entry, 1.0);
        return;
    }
    for_each_term(n, n.leader[entry], visit);
    visit(n.lever[entry].index, n.lever[entry].factor);
}

/// Let the nodes of a rigid grain follow its centre; its rotation becomes an unknown.
void follow_centre(const Grains& grains, int grain, Unknowns& n)
{
    const int centre = grains.centre(grain);
    const int rotation = static_cast<int>(grains.displacement.size()) + grains.slot[grain];
    n.kind[rotation] = Kind::unknown;
    for (int k = 0; k < grains.nodes_of(grain); ++k) {
        const int node = grains.node(grain, k);
        if (node == centre) continue;
        const Point arm = grains.reference_at(node) - grains.reference_at(centre);
        for (int axis = 0; axis < grains.layout.dimension; ++axis) {
            const int entry = grains.component(node, axis);
            n.kind[entry] = Kind::follower;
            n.leader[entry] = grains.component(centre, axis);
            n.lever[entry] = { rotation, axis == 0 ? -arm.y : arm.x };
        }
    }
}

/// Let what a set that floats holds follow its first node; its rotation is given.
void follow_first(const Grains& grains, const NodeSet& set, int rotation, Unknowns& n)
{
    for (int node : set.nodes) {
        const int first = set.nodes.front();
        if (node == first) continue;
        const Point arm = grains.reference_at(node) - grains.reference_at(first);
        for (int axis = 0; axis < grains.layout.dimension; ++axis) {
            if (!set.holds(axis)) continue;
            const int entry = grains.component(node, axis);
            n.kind[entry] = Kind::follower;
            n.leader[entry] = grains.component(first, axis);
            n.lever[entry] = { rotation, axis == 0 ? -arm.y : arm.x };
        }
    }
}

[[noreturn]] void refuse_prescribed(const Prescribed& p, const std::string& rule)
{
    refuse("solve_static: prescribed displacement " + std::to_string(p.index), p.value, "m", rule);
}

/// Mark what is prescribed and number the rest, node by node; fill `u` with the given values.
Unknowns number_unknowns(const Assembly& a, const StaticCase& of, Array<double>& u)
{
    const Grains& grains = a.grains;
    Unknowns n;
    const std::size_t moving = grains.displacement.size() + grains.in_slot.size();
    n.kind.assign(moving, Kind::padding);
    n.kind.resize(moving + a.node_sets.size(), Kind::prescribed);
    u.assign(n.kind.size(), 0.0);
    n.number.assign(n.kind.size(), 0);
    n.leader.assign(grains.displacement.size(), 0);
    n.lever.assign(grains.displacement.size(), { 0, 0.0 });
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        for_each_component(grains, g, [&](int i) { n.kind[i] = Kind::unknown; });
        if (grains.is_rigid(g)) follow_centre(grains, g, n);
    }
    for (std::size_t s = 0; s < a.node_sets.size(); ++s) {
        if (!a.node_sets[s].floats) continue;
        u[moving + s] = of.angles[s];
        follow_first(grains, a.node_sets[s], static_cast<int>(moving + s), n);
    }
    for (const Prescribed& p : of.prescribed) {
        if (!std::isfinite(p.value)) refuse_prescribed(p, "must be a finite number");
        const bool known = p.index >= 0 && p.index < static_cast<int>(grains.displacement.size())
            && n.kind[p.index] != Kind::padding;
        if (!known) refuse_prescribed(p, "its index must name a component of a grain's node");
        if (n.kind[p.index] == Kind::follower) {
            refuse_prescribed(
                p, "belongs to a rigid grain or to a set that floats; prescribe a centre");
        }
        if (n.kind[p.index] == Kind::prescribed && u[p.index] != p.value) {
            refuse_prescribed(p, "given before with another value; give it once");
        }
        n.kind[p.index] = Kind::prescribed;
        u[p.index] = p.value;
    }
    const auto count = [&n](int i) {
        if (n.kind[i] != Kind::unknown) return;
        n.number[i] = static_cast<int>(n.index.size());
        n.index.push_back(i);
    };
    for (int g = 0; g < grains.count; ++g) {
        for_each_component(grains, g, count);
        count(static_cast<int>(grains.displacement.size()) + grains.slot[g]);
    }
    return n;
}

/// Call visit(row, column, value) for each pair of entries that a term of the stiffness acts
/// between.
template <class Visit>
void for_each_pair(const Unknowns& n, const StiffnessEntry& e, const Visit& visit)
{
    for_each_term(n, e.row, [&](int i, double row_factor) {
        for_each_term(n, e.column, [&](int j, double column_factor) {
            if (n.kind[i] == Kind::unknown) visit(i, j, row_factor * column_factor * e.value);
        });
    });
}

/// Lower half of the stiffness of the unknowns.
SparseMatrix reduce(const std::vector<StiffnessEntry>& entries, const Unknowns& n)
{
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries.size());
    for (const StiffnessEntry& e : entries) {
        for_each_pair(n, e, [&](int i, int j, double value) {
            const int row = n.number[i], column = n.number[j];
            if (n.kind[j] == Kind::unknown && row >= column)
                triplets.emplace_back(row, column, value);
        });
    }
    const Eigen::Index size = static_cast<Eigen::Index>(n.index.size());
    SparseMatrix k(size, size);
    k.setFromTriplets(triplets.begin(), triplets.end());
    return k;
}

/// Forces on the unknowns: loads, and what the prescribed values pull.
Eigen::VectorXd right_hand_side(const std::vector<StiffnessEntry>& entries, const Unknowns& n,
    const Array<double>& given, const Array<double>& of_plates, const Array<double>* loads)
{
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n.index.size()));
    for (std::size_t i = 0; i < of_plates.size(); ++i) {
        const double load = of_plates[i] + (loads ? (*loads)[i] : 0.0);
        if (!std::isfinite(load)) check_finite("solve_static: load", load, "N");  // makes a text
        for_each_term(n, static_cast<int>(i), [&](int j, double factor) {
            if (n.kind[j] == Kind::unknown) rhs[n.number[j]] += factor * load;
        });
    }
    for (const StiffnessEntry& e : entries) {
        for_each_pair(n, e, [&](int i, int j, double value) {
            if (n.kind[j] != Kind::unknown) rhs[n.number[i]] -= value * given[j];
        });
    }
    return rhs;
}

[[noreturn]] void report_free_motion(const Grains& grains, int index, double ratio)
{
    const int size = static_cast<int>(grains.displacement.size());
    const bool turns = index >= size;
    const int axis = turns ? 0 : grains.layout.axis_of(index);
    const Point p = grains.point_at(
        turns ? grains.centre(grains.in_slot[index - size]) : index - grains.component(0, axis));
    const std::string at = " at x, y = " + number(p.x) + ", " + number(p.y) + " m ";
    const char* motion = turns ? "about z" : axis == 1 ? "along y" : "along x";
    fail("solve_static: pivot / stiffness", number(ratio) + at + motion,
        "must be above " + number(smallest_pivot)
            + "; hold nodes against every rigid motion of this part");
}

void check_pivots(const Assembly& a, const Unknowns& n, const SparseMatrix& k, const Solver& solver)
{
    // a pivot of exactly zero ends the factorisation: it is the first that fails here
    const Eigen::VectorXd diagonal = k.diagonal(), pivots = solver.vectorD();
    const auto& original = solver.permutationPinv().indices();
    for (Eigen::Index i = 0; i < pivots.size(); ++i) {
        const double ratio = pivots[i] / diagonal[original[i]];
        // in this form a pivot that is not a number is caught too
        if (!(ratio > smallest_pivot)) report_free_motion(a.grains, n.index[original[i]], ratio);
    }
}

/// Displacements of all nodes from the unknowns and the given values.
void spread(const Unknowns& n, const Eigen::VectorXd& x, const Array<double>& given,
    Array<double>& displacement)
{
    for (std::size_t i = 0; i < displacement.size(); ++i) {
        if (n.kind[i] == Kind::padding) continue;
        double sum = 0.0;
        for_each_term(n, static_cast<int>(i), [&](int j, double factor) {
            sum += factor * (n.kind[j] == Kind::unknown ? x[n.number[j]] : given[j]);
        });
        displacement[i] = sum;
    }
}

void require_size(const char* what, std::size_t size, std::size_t wanted)
{
    if (size == wanted) return;
    refuse(std::string("solve_static: ") + what, static_cast<double>(size), "values",
        "must be " + std::to_string(wanted) + ", as the assembly has");
}

}  // namespace

std::vector<StaticSolution> solve_static_cases(
    const Assembly& a, const std::vector<StaticCase>& cases, const GivenSprings& springs)
{
    const std::size_t size = a.grains.displacement.size();
    const std::size_t points = static_cast<std::size_t>(a.contacts.count) * a.contacts.group.points;
    if (!springs.contacts.empty()) require_size("springs", springs.contacts.size(), points);
    if (!springs.plates.empty())
        require_size("springs of plates", springs.plates.size(), a.plates.size());
    const std::vector<StiffnessEntry> entries = stiffness_entries(a, springs);
    std::vector<StaticSolution> found;
    std::vector<int> factorised;
    Solver solver;
    for (const StaticCase& one : cases) {
        require_size("plates", one.plates.size(), a.plates.size());
        require_size("angles", one.angles.size(), a.node_sets.size());
        if (!one.turns.empty()) require_size("turns", one.turns.size(), a.plates.size());
        Array<double> given;
        const Unknowns n = number_unknowns(a, one, given);
        if (found.empty()) factorised.assign(n.index.begin(), n.index.end());
        if (!std::equal(n.index.begin(), n.index.end(), factorised.begin(), factorised.end())) {
            refuse("solve_static: prescribed", static_cast<double>(one.prescribed.size()),
                "components", "must be the same in all cases");
        }
        if (one.loads && one.loads->size() != size) {
            refuse("solve_static: loads", static_cast<double>(one.loads->size()), "values",
                "must be " + std::to_string(size) + ", one per displacement");
        }
        found.emplace_back();
        StaticSolution& s = found.back();
        s.displacement.assign(size, 0.0);
        s.force.assign(size, 0.0);
        add_plate_loads(a, one, springs, s.force);
        const Eigen::VectorXd rhs = right_hand_side(entries, n, given, s.force, one.loads);
        const bool any = !n.index.empty();
        if (any && found.size() == 1) {
            // minimum degree, the default order, fills in least of those that Eigen has
            const SparseMatrix k = reduce(entries, n);
            solver.compute(k);
            check_pivots(a, n, k, solver);
        }
        spread(n, any ? Eigen::VectorXd(solver.solve(rhs)) : rhs, given, s.displacement);
        for (const StiffnessEntry& e : entries)
            s.force[e.row] -= e.value * s.displacement[e.column];
    }
    return found;
}

StaticSolution solve_static(
    const Assembly& a, const std::vector<Prescribed>& prescribed, const Array<double>* loads)
{
    StaticCase one { prescribed, {}, {}, loads };
    for (const Plate& plate : a.plates)
        one.plates.push_back(plate.displacement);
    for (const NodeSet& set : a.node_sets)
        one.angles.push_back(set.angle.z);
    return std::move(solve_static_cases(a, { one }, {}).front());
}

}  // namespace flexpm
