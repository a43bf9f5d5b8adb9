// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Assembly of the linear stiffness and its sparse factorisation.
#include <flexpm/kernel/elastic_solve.hpp>

#include <flexpm/kernel/boundary.hpp>
#include <flexpm/kernel/checks.hpp>
#include <flexpm/kernel/grain_access.hpp>

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

/// Springs k_n along the bonded normal and k_s across it, between the points of the two edges.
void add_contact(const Assembly& a, int contact, std::vector<StiffnessEntry>& entries)
{
    const double dx = a.span[row_index(contact, 0, 2)], dy = a.span[row_index(contact, 1, 2)];
    const double d = std::hypot(dx, dy), nx = dx / d, ny = dy / d;
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
    const StiffnessBlock k = { kn * nx * nx + ks * ny * ny, (kn - ks) * nx * ny,
        (kn - ks) * nx * ny, kn * ny * ny + ks * nx * nx };
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double s = share[i][j];
            add_block(entries, a.contact_nodes[row_index(contact, i, ContactRows::nodes)],
                a.contact_nodes[row_index(contact, j, ContactRows::nodes)],
                { s * k.xx, s * k.xy, s * k.yx, s * k.yy });
        }
    }
}

/// What each entry of Assembly::displacement is to the solve: an unknown's number, or one of these.
enum : int { padding = -1, prescribed_value = -2 };

struct Unknowns {
    std::vector<int> number;  ///< per entry of Assembly::displacement
    std::vector<int> index;   ///< per unknown: its entry
};

[[noreturn]] void refuse_prescribed(const Prescribed& p, const std::string& rule)
{
    refuse("solve_static: prescribed displacement " + std::to_string(p.index), p.value, "m", rule);
}

/// Marks what is prescribed and numbers the rest, node by node; fills `u` with the given values.
Unknowns number_unknowns(
    const Assembly& a, const std::vector<Prescribed>& prescribed, Array<double>& u)
{
    Unknowns n;
    n.number.assign(a.displacement.size(), padding);
    for (int g = 0; g < a.grains; ++g) {
        for (int k = 0; k < a.nodes_of(g); ++k) {
            for (int c = 0; c < 2; ++c)
                n.number[a.node(g, k) + c * lanes] = 0;
        }
    }
    for (const Prescribed& p : prescribed) {
        if (!std::isfinite(p.value)) refuse_prescribed(p, "must be a finite number");
        const bool known = p.index >= 0 && p.index < static_cast<int>(n.number.size())
            && n.number[p.index] != padding;
        if (!known) refuse_prescribed(p, "its index must name a component of a grain's node");
        if (n.number[p.index] == prescribed_value && u[p.index] != p.value) {
            refuse_prescribed(p, "given before with another value; give it once");
        }
        n.number[p.index] = prescribed_value;
        u[p.index] = p.value;
    }
    for (int g = 0; g < a.grains; ++g) {
        for (int k = 0; k < a.nodes_of(g); ++k) {
            for (int i : { a.node(g, k), a.node(g, k) + lanes }) {
                if (n.number[i] != 0) continue;
                n.number[i] = static_cast<int>(n.index.size());
                n.index.push_back(i);
            }
        }
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
        const int row = n.number[e.row], column = n.number[e.column];
        if (row < 0) continue;
        if (column < 0) {
            rhs[row] -= e.value * u[e.column];
        } else if (row >= column) {
            triplets.emplace_back(row, column, e.value);
        }
    }
    const Eigen::Index size = static_cast<Eigen::Index>(n.index.size());
    SparseMatrix k(size, size);
    k.setFromTriplets(triplets.begin(), triplets.end());
    return k;
}

[[noreturn]] void report_free_motion(const Assembly& a, int index, double ratio)
{
    const bool along_y = index % (2 * lanes) >= lanes;  // rows of x and y alternate
    const Point p = a.position(along_y ? index - lanes : index);
    std::ostringstream text;
    text << "solve_static: pivot / stiffness = " << ratio << " at x, y = " << p.x << ", " << p.y
         << " m along " << (along_y ? 'y' : 'x') << ", must be above " << smallest_pivot
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

}  // namespace

std::vector<StiffnessEntry> stiffness_entries(const Assembly& a)
{
    std::vector<StiffnessEntry> entries;
    for (int g = 0; g < a.grains; ++g)
        add_grain(a, g, entries);
    for (int c = 0; c < a.contacts; ++c)
        add_contact(a, c, entries);
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

    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n.index.size()));
    if (loads && loads->size() != s.displacement.size()) {
        refuse("solve_static: loads", static_cast<double>(loads->size()), "values",
            "must be " + std::to_string(s.displacement.size()) + ", one per displacement");
    }
    for (std::size_t i = 0; loads && i < n.index.size(); ++i) {
        check_finite("solve_static: load", (*loads)[n.index[i]], "N");
        rhs[i] = (*loads)[n.index[i]];
    }
    const SparseMatrix k = reduce(entries, n, s.displacement, rhs);
    if (k.rows() > 0) {
        // minimum degree, the default order, fills in least of those that Eigen has
        const Solver solver(k);
        check_pivots(a, n, k, solver);
        const Eigen::VectorXd x = solver.solve(rhs);
        for (std::size_t i = 0; i < n.index.size(); ++i)
            s.displacement[n.index[i]] = x[i];
    }
    for (const StiffnessEntry& e : entries) {
        s.force[e.row] -= e.value * s.displacement[e.column];
    }
    return s;
}

ElasticConstants elastic_constants(const Assembly& a)
{
    for (int side = 0; side < 4; ++side) {
        check_positive(
            "elastic_constants: length of side " + std::to_string(side), side_length(a, side), "m");
    }
    constexpr double strain = 1e-3;  // any value: the solve is linear
    const double width = side_length(a, 0), height = side_length(a, 1);
    const std::vector<int> bottom = side_nodes(a, 0), top = side_nodes(a, 2);
    std::vector<Prescribed> prescribed { { bottom.front(), 0.0 } };
    for (int n : bottom)
        prescribed.push_back({ n + lanes, 0.0 });
    for (int n : top)
        prescribed.push_back({ n + lanes, strain * height });
    StaticSolution s = solve_static(a, prescribed);

    Assembly solved = a;
    solved.displacement = std::move(s.displacement);
    solved.force = std::move(s.force);
    const double widening = side_displacement(solved, 1, 0) - side_displacement(solved, 3, 0);
    return { reaction(solved, top, 1) / (width * a.thickness * strain),
        -widening / (width * strain) };
}

}  // namespace flexpm
