// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Assembly of the linear stiffness and its sparse factorisation.
#include <flexpm/kernel/statics/elastic_solve.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/checks.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/specimen_strain.hpp>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <cmath>
#include <sstream>

namespace flexpm {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower>;

/// A pivot below this share of its diagonal term is round-off: the part it belongs to moves freely.
constexpr double smallest_pivot = 1e-10;

void add_block(std::vector<StiffnessEntry>& entries, int row, int column, const StiffnessBlock& k)
{
    entries.push_back({ row, column, k.xx });
    entries.push_back({ row, column + lanes, k.xy });
    entries.push_back({ row + lanes, column, k.yx });
    entries.push_back({ row + lanes, column + lanes, k.yy });
}

void add_grain(const Assembly& a, int grain, std::vector<StiffnessEntry>& entries)
{
    const PlaneStiffness c = stiffness_of(a, grain);
    for (int t = 0; t < triangles_of(a, grain); ++t) {
        const auto n = triangle_nodes(a, grain, t);
        const TriangleShape s = shape_of(a, grain, t);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                add_block(
                    entries, a.node(grain, n[i]), a.node(grain, n[j]), stiffness_block(s, c, i, j));
            }
        }
    }
}

/// Springs along a normal and across it.
StiffnessBlock spring_block(Point n, double normal, double shear)
{
    const double cross = (normal - shear) * n.x * n.y;
    return { normal * n.x * n.x + shear * n.y * n.y, cross, cross,
        normal * n.y * n.y + shear * n.x * n.x };
}

/// Springs k_n along the bonded normal and k_s across it, between the points of the two edges.
void add_contact(const Assembly& a, int contact, std::vector<StiffnessEntry>& entries)
{
    const Point n = bonded_normal(a, contact);
    // share[i][j]: sum over points of area times the parts of nodes i and j in the relative motion
    std::array<std::array<double, 4>, 4> share = {};
    for (int p = 0; p < a.points; ++p) {
        const double area = a.area[row_index(contact, p, a.points)];
        const double wa = a.weight[row_index(contact, 2 * p, 2 * a.points)];
        const double wb = a.weight[row_index(contact, 2 * p + 1, 2 * a.points)];
        const std::array<double, 4> part = { wa - 1.0, -wa, 1.0 - wb, wb };
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j)
                share[i][j] += area * part[i] * part[j];
        }
    }
    const LawParameters& law = a.laws[a.contact_law[contact]];
    const double kn = law.normal_stiffness, ks = law.shear_stiffness;
    const StiffnessBlock k = spring_block(n, kn, ks);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double s = share[i][j];
            add_block(entries, a.contact_nodes[row_index(contact, i, ContactRows::nodes)],
                a.contact_nodes[row_index(contact, j, ContactRows::nodes)],
                { s * k.xx, s * k.xy, s * k.yx, s * k.yy });
        }
    }
}

/// Springs of a plate's points to where the plate is.
void add_plate(const Assembly& a, const Plate& plate, std::vector<StiffnessEntry>& entries)
{
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const StiffnessBlock k = spring_block(plate.normal, p.stiffness, p.shear_stiffness);
        const auto n = edge_nodes(a, p.edge);
        const double part[] = { 1.0 - p.weight, p.weight };
        for (int r = 0; r < 2; ++r) {
            for (int c = 0; c < 2; ++c) {
                const double s = part[r] * part[c];
                add_block(entries, n[r], n[c], { s * k.xx, s * k.xy, s * k.yx, s * k.yy });
            }
        }
    }
}

/// Forces on the nodes when the plates are displaced and the grains are not.
void add_plate_loads(const Assembly& a, Array<double>& loads)
{
    for (const Plate& plate : a.plates) {
        for (int i = 0; i < plate_points(plate); ++i) {
            const PlatePoint p = plate_point(plate, i);
            const StiffnessBlock k = spring_block(plate.normal, p.stiffness, p.shear_stiffness);
            const Point u = plate.displacement;
            const auto n = edge_nodes(a, p.edge);
            const double part[] = { 1.0 - p.weight, p.weight };
            for (int r = 0; r < 2; ++r) {
                loads[n[r]] += part[r] * (k.xx * u.x + k.xy * u.y);
                loads[n[r] + lanes] += part[r] * (k.yx * u.x + k.yy * u.y);
            }
        }
    }
}

/// What each entry of Assembly::displacement, and behind them the rotation of each slot, is to the
/// solve: an unknown's number, or one of these.
enum : int { padding = -1, prescribed_value = -2, follower = -3 };

/// A node's displacement in terms of unknowns: itself, or the motion of its rigid grain.
struct Term {
    int index;
    double factor;
};

struct Unknowns {
    std::vector<int> number;  ///< per entry of Assembly::displacement, then per slot
    std::vector<int> index;   ///< per unknown: its entry
    std::vector<Term> lever;  ///< per entry that follows a rotation: index and arm
    std::vector<int> leader;  ///< per entry that follows: the same component of the centre
};

/// Calls visit(index, factor) for what the displacement entry consists of.
template <class Visit> void for_each_term(const Unknowns& n, int entry, Visit visit)
{
    if (n.number[entry] != follower) {
        visit(entry, 1.0);
        return;
    }
    visit(n.leader[entry], 1.0);
    visit(n.lever[entry].index, n.lever[entry].factor);
}

/// The nodes of a rigid grain follow its centre; the rotation becomes an unknown.
void follow_centre(const Assembly& a, int grain, Unknowns& n)
{
    const int centre = a.centre(grain);
    const int rotation = static_cast<int>(a.displacement.size()) + a.grain_slot[grain];
    n.number[rotation] = 0;
    for (int k = 0; k < a.nodes_of(grain); ++k) {
        const int node = a.node(grain, k);
        if (node == centre) continue;
        const double rx = a.reference[node] - a.reference[centre];
        const double ry = a.reference[node + lanes] - a.reference[centre + lanes];
        for (int c = 0; c < 2; ++c) {
            n.number[node + c * lanes] = follower;
            n.leader[node + c * lanes] = centre + c * lanes;
            n.lever[node + c * lanes] = { rotation, c == 0 ? -ry : rx };
        }
    }
}

[[noreturn]] void refuse_prescribed(const Prescribed& p, const std::string& rule)
{
    refuse("solve_static: prescribed displacement " + std::to_string(p.index), p.value, "m", rule);
}

/// Marks what is prescribed and numbers the rest, node by node; fills `u` with the given values.
Unknowns number_unknowns(
    const Assembly& a, const std::vector<Prescribed>& prescribed, Array<double>& u)
{
    Unknowns n;
    n.number.assign(a.displacement.size() + a.slot_grain.size(), padding);
    n.leader.assign(a.displacement.size(), 0);
    n.lever.assign(a.displacement.size(), { 0, 0.0 });
    for (int g = 0; g < a.grains; ++g) {
        for (int k = 0; k < a.nodes_of(g); ++k) {
            for (int c = 0; c < 2; ++c)
                n.number[a.node(g, k) + c * lanes] = 0;
        }
        if (a.is_rigid(g)) follow_centre(a, g, n);
    }
    for (const Prescribed& p : prescribed) {
        if (!std::isfinite(p.value)) refuse_prescribed(p, "must be a finite number");
        const bool known =
            p.index >= 0 && p.index < static_cast<int>(u.size()) && n.number[p.index] != padding;
        if (!known) refuse_prescribed(p, "its index must name a component of a grain's node");
        if (n.number[p.index] == follower) {
            refuse_prescribed(p, "belongs to a rigid grain; prescribe its centre");
        }
        if (n.number[p.index] == prescribed_value && u[p.index] != p.value) {
            refuse_prescribed(p, "given before with another value; give it once");
        }
        n.number[p.index] = prescribed_value;
        u[p.index] = p.value;
    }
    const auto count = [&n](int i) {
        if (n.number[i] != 0) return;
        n.number[i] = static_cast<int>(n.index.size());
        n.index.push_back(i);
    };
    for (int g = 0; g < a.grains; ++g) {
        for (int k = 0; k < a.nodes_of(g); ++k) {
            for (int i : { a.node(g, k), a.node(g, k) + lanes })
                count(i);
        }
        count(static_cast<int>(a.displacement.size()) + a.grain_slot[g]);
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
                const int row = n.number[i], column = n.number[j];
                const double value = row_factor * column_factor * e.value;
                if (row < 0) return;
                if (column < 0) {
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

[[noreturn]] void report_free_motion(const Assembly& a, int index, double ratio)
{
    const int size = static_cast<int>(a.displacement.size());
    const bool turns = index >= size;
    const bool along_y = !turns && index % (2 * lanes) >= lanes;  // rows of x and y alternate
    const Point p = a.position(
        turns ? a.centre(a.slot_grain[index - size]) : (along_y ? index - lanes : index));
    std::ostringstream text;
    text << "solve_static: pivot / stiffness = " << ratio << " at x, y = " << p.x << ", " << p.y
         << " m "
         << (turns            ? "about z"
                    : along_y ? "along y"
                              : "along x")
         << ", must be above " << smallest_pivot
         << "; hold nodes against every rigid motion of this part";
    throw std::runtime_error(text.str());
}

void check_pivots(const Assembly& a, const Unknowns& n, const SparseMatrix& k, const Solver& solver)
{
    // a pivot of exactly zero ends the factorisation: it is the first that fails here
    const Eigen::VectorXd diagonal = k.diagonal(), pivots = solver.vectorD();
    const auto& original = solver.permutationPinv().indices();
    for (Eigen::Index i = 0; i < pivots.size(); ++i) {
        const double ratio = pivots[i] / diagonal[original[i]];
        // written so that a pivot that is not a number is caught too
        if (!(ratio > smallest_pivot)) report_free_motion(a, n.index[original[i]], ratio);
    }
}

/// Displacements of all nodes from the unknowns.
void spread(const Unknowns& n, const Eigen::VectorXd& x, Array<double>& displacement)
{
    const auto value_of = [&](int index) {
        return n.number[index] >= 0 ? x[n.number[index]] : displacement[index];
    };
    for (std::size_t i = 0; i < displacement.size(); ++i) {
        if (n.number[i] >= 0) displacement[i] = x[n.number[i]];
    }
    for (std::size_t i = 0; i < displacement.size(); ++i) {
        if (n.number[i] != follower) continue;
        displacement[i] = value_of(n.leader[i]) + n.lever[i].factor * x[n.number[n.lever[i].index]];
    }
}

/// Force on the specimen of a plate at its place, all contacts bonded.
Point static_force(const Assembly& a, const Plate& plate)
{
    Point sum;
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const StiffnessBlock k = spring_block(plate.normal, p.stiffness, p.shear_stiffness);
        const auto n = edge_nodes(a, p.edge);
        const double *u0 = &a.displacement[n[0]], *u1 = &a.displacement[n[1]], w = p.weight;
        const double x = plate.displacement.x - ((1.0 - w) * u0[0] + w * u1[0]);
        const double y = plate.displacement.y - ((1.0 - w) * u0[lanes] + w * u1[lanes]);
        sum.x += k.xx * x + k.xy * y;
        sum.y += k.yx * x + k.yy * y;
    }
    return sum;
}

}  // namespace

std::vector<StiffnessEntry> stiffness_entries(const Assembly& a)
{
    std::vector<StiffnessEntry> entries;
    for (int g = 0; g < a.grains; ++g)
        add_grain(a, g, entries);
    for (int c = 0; c < a.contacts; ++c)
        add_contact(a, c, entries);
    for (const Plate& p : a.plates)
        add_plate(a, p, entries);
    return entries;
}

StaticSolution solve_static(
    const Assembly& a, const std::vector<Prescribed>& prescribed, const Array<double>* loads)
{
    StaticSolution s;
    s.displacement.assign(a.displacement.size(), 0.0);
    s.force.assign(a.displacement.size(), 0.0);
    const Unknowns n = number_unknowns(a, prescribed, s.displacement);
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
            if (n.number[j] >= 0) rhs[n.number[j]] += factor * load;
        });
    }
    const SparseMatrix k = reduce(entries, n, s.displacement, rhs);
    if (k.rows() > 0) {
        // minimum degree, the default order, fills in least of those that Eigen has
        const Solver solver(k);
        check_pivots(a, n, k, solver);
        spread(n, solver.solve(rhs), s.displacement);
    }
    for (const StiffnessEntry& e : entries) {
        s.force[e.row] -= e.value * s.displacement[e.column];
    }
    return s;
}

namespace {

constexpr double test_strain = 1e-3;  // any value: the solve is linear

/// The ends move axially, one point stays laterally.
std::vector<Prescribed> hold_ends(Assembly& a, double height)
{
    const std::vector<int> bottom = side_nodes(a, bottom_side), top = side_nodes(a, top_side);
    if (a.is_rigid(0)) {
        const PlateContact smooth = { 0.0, 0.0, true };
        add_side_plates(a, bottom_side, 1, smooth);
        const int upper = add_side_plates(a, top_side, 1, smooth).front();
        a.plates[upper].displacement = { 0.0, test_strain * height };
        int held = 0;
        while (a.edge_side[held] != bottom_side)
            ++held;
        return { { a.centre(a.edge_grain[held]), 0.0 } };
    }
    std::vector<Prescribed> prescribed { { bottom.front(), 0.0 } };
    for (int n : bottom)
        prescribed.push_back({ n + lanes, 0.0 });
    for (int n : top)
        prescribed.push_back({ n + lanes, test_strain * height });
    return prescribed;
}

}  // namespace

ElasticConstants elastic_constants(const Assembly& a)
{
    for (int side = 0; side < 4; ++side) {
        check_positive(
            "elastic_constants: length of side " + std::to_string(side), side_length(a, side), "m");
    }
    const double width = side_length(a, bottom_side), height = side_length(a, left_side);
    Assembly solved = a;
    solved.plates.clear();
    const std::vector<Prescribed> prescribed = hold_ends(solved, height);
    StaticSolution s = solve_static(solved, prescribed);
    solved.displacement = std::move(s.displacement);
    solved.force = std::move(s.force);

    double top = 0.0;
    for (const Plate& p : solved.plates) {
        if (p.side == top_side) top = static_force(solved, p).y;
    }
    if (solved.plates.empty()) top = reaction(solved, side_nodes(a, top_side), 1);
    const SpecimenStrain strain = specimen_strain(solved);
    return { top / (width * a.thickness * strain.axial), -strain.lateral / strain.axial };
}

}  // namespace flexpm
