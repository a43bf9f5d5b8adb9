// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Numbering of the unknowns, their equations and the sparse factorisation.
#include <flexpm/kernel/statics/static_solve.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cmath>
#include <cstdint>
#include <string>

namespace flexpm {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower>;

/// A pivot below this share of its diagonal term is round-off: the part it belongs to moves freely.
constexpr double smallest_pivot = 1e-10;

/// Forces on the nodes when the plates are displaced and the grains are not.
void add_plate_loads(const Assembly& a, Array<double>& loads)
{
    for (const Plate& plate : a.plates) {
        for (int i = 0; i < plate_points(plate); ++i) {
            const PlatePoint p = plate_point(plate, i);
            const StiffnessBlock k = plate_springs(plate, i);
            const Point u = plate.displacement;
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
Unknowns number_unknowns(
    const Assembly& a, const std::vector<Prescribed>& prescribed, Array<double>& u)
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
        u[moving + s] = a.node_sets[s].angle;
        follow_first(grains, a.node_sets[s], static_cast<int>(moving + s), n);
    }
    for (const Prescribed& p : prescribed) {
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

/// Lower half of the stiffness of the unknowns; what the prescribed values pull goes into `rhs`.
SparseMatrix reduce(const std::vector<StiffnessEntry>& entries, const Unknowns& n,
    const Array<double>& u, Eigen::VectorXd& rhs)
{
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries.size());
    for (const StiffnessEntry& e : entries) {
        for_each_term(n, e.row, [&](int i, double row_factor) {
            for_each_term(n, e.column, [&](int j, double column_factor) {
                if (n.kind[i] != Kind::unknown) return;
                const int row = n.number[i], column = n.number[j];
                const double value = row_factor * column_factor * e.value;
                if (n.kind[j] != Kind::unknown) {
                    rhs[row] -= value * u[j];
                } else if (row >= column) {
                    triplets.emplace_back(row, column, value);
                }
            });
        });
    }
    const Eigen::Index size = static_cast<Eigen::Index>(n.index.size());
    SparseMatrix k(size, size);
    k.setFromTriplets(triplets.begin(), triplets.end());
    return k;
}

[[noreturn]] void report_free_motion(const Grains& grains, int index, double ratio)
{
    const int size = static_cast<int>(grains.displacement.size());
    const bool turns = index >= size;
    const int axis = turns ? 0 : grains.layout.axis_of(index);
    const Point p = grains.position(
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

}  // namespace

StaticSolution solve_static(
    const Assembly& a, const std::vector<Prescribed>& prescribed, const Array<double>* loads)
{
    StaticSolution s;
    s.displacement.assign(a.grains.displacement.size(), 0.0);
    s.force.assign(a.grains.displacement.size(), 0.0);
    Array<double> given;
    const Unknowns n = number_unknowns(a, prescribed, given);
    const std::vector<StiffnessEntry> entries = stiffness_entries(a);

    if (loads && loads->size() != s.displacement.size()) {
        refuse("solve_static: loads", static_cast<double>(loads->size()), "values",
            "must be " + std::to_string(s.displacement.size()) + ", one per displacement");
    }
    add_plate_loads(a, s.force);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n.index.size()));
    for (std::size_t i = 0; i < s.force.size(); ++i) {
        const double load = s.force[i] + (loads ? (*loads)[i] : 0.0);
        check_finite("solve_static: load", load, "N");
        for_each_term(n, static_cast<int>(i), [&](int j, double factor) {
            if (n.kind[j] == Kind::unknown) rhs[n.number[j]] += factor * load;
        });
    }
    const SparseMatrix k = reduce(entries, n, given, rhs);
    if (k.rows() > 0) {
        // minimum degree, the default order, fills in least of those that Eigen has
        const Solver solver(k);
        check_pivots(a, n, k, solver);
        spread(n, solver.solve(rhs), given, s.displacement);
    } else {
        spread(n, rhs, given, s.displacement);
    }
    for (const StiffnessEntry& e : entries) {
        s.force[e.row] -= e.value * s.displacement[e.column];
    }
    return s;
}

}  // namespace flexpm
