// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear forces of bonded polyhedral grains as an operator, and its solution.
#include <flexpm/kernel/statics/solid_constants.hpp>

#include <flexpm/kernel/fem/tetrahedron.hpp>
#include <flexpm/kernel/space/face_triangles.hpp>
#include <flexpm/kernel/space/fan_meshes.hpp>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace flexpm {
namespace {

/// Residual, relative to the load, at which forces are in balance.
constexpr double balanced = 1e-10;
constexpr int most_iterations = 20000;

struct Element {
    std::array<int, 4> nodes;
    TetrahedronShape shape;
};

struct Spring {
    double area;
    std::vector<double> shares;
};

struct Face {
    std::array<std::vector<int>, 2> nodes;  ///< corners of both sides
    Vector normal;
    std::vector<Spring> springs;
};

/// Part of the surface: a triangle on a wall.
struct Facet {
    std::array<int, 3> nodes;
    int wall;
    double area;
};

/// All that is linear in a solid.
struct Grains {
    PlaneStiffness stiffness {};
    double normal = 0.0, shear = 0.0;  ///< stiffness of contacts [Pa/m]
    std::vector<Vector> places;
    std::vector<Element> elements;
    std::vector<Face> faces;
    std::vector<Facet> facets;
};

using Numbers = Eigen::VectorXd;

Vector at(const Numbers& u, int node) { return { u[3 * node], u[3 * node + 1], u[3 * node + 2] }; }

void add(Numbers& u, int node, Vector v)
{
    u[3 * node] += v.x;
    u[3 * node + 1] += v.y;
    u[3 * node + 2] += v.z;
}

/// Force of a spring that is stretched by `jump`.
Vector spring_force(const Grains& g, const Face& face, const Spring& s, Vector jump)
{
    return s.area
        * (g.shear * jump + ((g.normal - g.shear) * dot(face.normal, jump)) * face.normal);
}

/// Add K u: the forces that hold the nodes at these displacements.
void add_forces(const Grains& g, const Numbers& u, Numbers& forces)
{
    for (const Element& e : g.elements) {
        const auto& n = e.nodes;
        const SpaceGradient h =
            displacement_gradient(e.shape, at(u, n[0]), at(u, n[1]), at(u, n[2]), at(u, n[3]));
        const SpaceTensor s = stress(g.stiffness,
            SpaceTensor { h.x.x, h.y.y, h.z.z, 0.5 * (h.y.z + h.z.y), 0.5 * (h.x.z + h.z.x),
                0.5 * (h.x.y + h.y.x) });
        const Vector f1 = e.shape.volume * (s * e.shape.g1), f2 = e.shape.volume * (s * e.shape.g2),
                     f3 = e.shape.volume * (s * e.shape.g3);
        add(forces, n[0], -(f1 + f2 + f3));
        add(forces, n[1], f1);
        add(forces, n[2], f2);
        add(forces, n[3], f3);
    }
    for (const Face& face : g.faces) {
        const std::size_t corners = face.nodes[0].size();
        for (const Spring& s : face.springs) {
            Vector jump;
            for (std::size_t k = 0; k < corners; ++k)
                jump = jump + s.shares[k] * (at(u, face.nodes[1][k]) - at(u, face.nodes[0][k]));
            const Vector force = spring_force(g, face, s, jump);
            for (std::size_t k = 0; k < corners; ++k) {
                add(forces, face.nodes[1][k], s.shares[k] * force);
                add(forces, face.nodes[0][k], -s.shares[k] * force);
            }
        }
    }
}

/// Diagonal 3x3 blocks of K.
std::vector<Eigen::Matrix3d> diagonal_blocks(const Grains& g)
{
    std::vector<Eigen::Matrix3d> blocks(g.places.size(), Eigen::Matrix3d::Zero());
    const auto add_block = [&](int node, double factor, const SpaceGradient& k) {
        Eigen::Matrix3d m;
        m << k.x.x, k.x.y, k.x.z, k.y.x, k.y.y, k.y.z, k.z.x, k.z.y, k.z.z;
        blocks[node] += factor * m;
    };
    for (const Element& e : g.elements)
        for (int k = 0; k < 4; ++k)
            add_block(e.nodes[k], 1.0, stiffness_block(e.shape, g.stiffness, k, k));
    for (const Face& face : g.faces) {
        for (const Spring& s : face.springs) {
            const SpaceGradient block { spring_force(g, face, s, { 1.0, 0.0, 0.0 }),
                spring_force(g, face, s, { 0.0, 1.0, 0.0 }),
                spring_force(g, face, s, { 0.0, 0.0, 1.0 }) };
            for (int side = 0; side < 2; ++side)
                for (std::size_t k = 0; k < s.shares.size(); ++k)
                    add_block(face.nodes[side][k], s.shares[k] * s.shares[k], block);
        }
    }
    return blocks;
}

Grains make_grains(const Polyhedra& cells, const SolidElasticity& material, FacePointRule rule)
{
    check_positive("solid_constants: normal_stiffness", material.normal_stiffness, "Pa/m");
    check_positive("solid_constants: shear_ratio", material.shear_ratio, "");
    Grains g;
    // a density is asked for, and has no part in statics
    g.stiffness = solid_stiffness({ material.young, material.poisson, 1.0, Plane::strain });
    g.normal = material.normal_stiffness;
    g.shear = material.shear_ratio * material.normal_stiffness;
    const FanMeshes meshes = fan_meshes(cells);
    const auto node = [&](int cell, int vertex) {
        const auto first = meshes.node_vertices.begin() + meshes.node_offsets[cell];
        const auto last = meshes.node_vertices.begin() + meshes.node_offsets[cell + 1] - 1;
        return static_cast<int>(
            std::lower_bound(first, last, vertex) - meshes.node_vertices.begin());
    };
    for (int c = 0; c < cells.cells(); ++c) {
        const auto first = meshes.node_offsets[c];
        for (auto k = first; k < meshes.node_offsets[c + 1]; ++k) {
            const int vertex = meshes.node_vertices[k];
            g.places.push_back(vertex < 0 ? cells.centres[c] : cells.vertices[vertex]);
        }
        for (auto e = meshes.element_offsets[c]; e < meshes.element_offsets[c + 1]; ++e) {
            std::array<int, 4> n {};
            for (int k = 0; k < 4; ++k)
                n[k] = static_cast<int>(first) + meshes.elements[e][k];
            g.elements.push_back({ n,
                tetrahedron_shape(
                    g.places[n[0]], g.places[n[1]], g.places[n[2]], g.places[n[3]]) });
        }
    }
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const PolyhedronFace& on = cells.faces[f];
        const std::vector<int> corners = cells.corners(static_cast<int>(f));
        if (on.cell_b < 0) {
            for (const auto& [p, q, r] : face_triangles(cells.vertices, corners)) {
                const double area = 0.5
                    * norm(cross(cells.vertices[q] - cells.vertices[p],
                        cells.vertices[r] - cells.vertices[p]));
                g.facets.push_back({ { node(on.cell_a, p), node(on.cell_a, q), node(on.cell_a, r) },
                    on.wall, area });
            }
            continue;
        }
        Face face;
        std::vector<Vector> places;
        for (int v : corners) {
            places.push_back(cells.vertices[v]);
            face.nodes[0].push_back(node(on.cell_a, v));
            face.nodes[1].push_back(node(on.cell_b, v));
        }
        const FacePoints points = face_points(places, rule);
        face.normal = points.normal;
        for (const FacePoint& p : points.points)
            face.springs.push_back({ p.area, p.shares });
        g.faces.push_back(face);
    }
    return g;
}

/// Components that are free to move, and the stiffness between them.
struct Operator {
    const Grains* grains = nullptr;
    std::vector<std::uint8_t> held;  ///< per component

    void project(Numbers& u) const
    {
        for (std::size_t k = 0; k < held.size(); ++k)
            if (held[k]) u[static_cast<Eigen::Index>(k)] = 0.0;
    }
};

}  // namespace

/// The operator as a matrix that Eigen's solvers multiply with.
class FreeStiffness;

}  // namespace flexpm

namespace Eigen::internal {
template <> struct traits<flexpm::FreeStiffness> : public traits<SparseMatrix<double>> {
};
}  // namespace Eigen::internal

namespace flexpm {

class FreeStiffness : public Eigen::EigenBase<FreeStiffness> {
public:
    using Scalar = double;
    using RealScalar = double;
    using StorageIndex = int;
    enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };
    enum { IsRowMajor = false };

    explicit FreeStiffness(const Operator& on) : on_(on) { }
    Eigen::Index rows() const { return static_cast<Eigen::Index>(on_.held.size()); }
    Eigen::Index cols() const { return rows(); }
    const Operator& on() const { return on_; }

    template <class Right>
    Eigen::Product<FreeStiffness, Right, Eigen::AliasFreeProduct> operator*(
        const Eigen::MatrixBase<Right>& right) const
    {
        return { *this, right.derived() };
    }

private:
    const Operator& on_;
};

}  // namespace flexpm

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<flexpm::FreeStiffness, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<flexpm::FreeStiffness, Right,
          generic_product_impl<flexpm::FreeStiffness, Right>> {
    template <class To>
    static void scaleAndAddTo(
        To& to, const flexpm::FreeStiffness& left, const Right& right, const double& factor)
    {
        flexpm::Numbers forces = flexpm::Numbers::Zero(left.rows());
        flexpm::add_forces(*left.on().grains, right, forces);
        left.on().project(forces);
        to.noalias() += factor * forces;
    }
};
}  // namespace Eigen::internal

namespace flexpm {
namespace {

/// Inverse diagonal blocks of the free components.
class BlockPreconditioner {
public:
    template <class Matrix> BlockPreconditioner& compute(const Matrix& matrix)
    {
        const Operator& on = matrix.on();
        blocks_ = diagonal_blocks(*on.grains);
        for (std::size_t n = 0; n < blocks_.size(); ++n) {
            for (int k = 0; k < 3; ++k) {
                if (!on.held[3 * n + k]) continue;
                blocks_[n].row(k).setZero();
                blocks_[n].col(k).setZero();
                blocks_[n](k, k) = 1.0;
            }
            blocks_[n] = blocks_[n].inverse().eval();
        }
        return *this;
    }
    template <class Matrix> BlockPreconditioner& analyzePattern(const Matrix&) { return *this; }
    template <class Matrix> BlockPreconditioner& factorize(const Matrix& m) { return compute(m); }
    Numbers solve(const Numbers& right) const
    {
        Numbers result(right.size());
        for (std::size_t n = 0; n < blocks_.size(); ++n) {
            const auto k = static_cast<Eigen::Index>(3 * n);
            result.segment<3>(k) = blocks_[n] * right.segment<3>(k);
        }
        return result;
    }
    Eigen::ComputationInfo info() const { return Eigen::Success; }

private:
    std::vector<Eigen::Matrix3d> blocks_;
};

/// Nodes that lie on a side.
std::vector<std::uint8_t> nodes_on(const Grains& g, const Solid& solid, SolidSide side)
{
    std::vector<std::uint8_t> on(g.places.size(), 0);
    bool any = false;
    for (const Facet& f : g.facets) {
        if (solid.walls[f.wall].side != side) continue;
        for (int n : f.nodes)
            on[n] = 1;
        any = true;
    }
    if (!any) {
        refuse("solid_constants: facets of an end", 0.0, "",
            "must be above 0; give cells of a solid with bottom and top");
    }
    return on;
}

/// @throws std::invalid_argument  for cells of another solid
void require_cells_of(const Solid& solid, const Polyhedra& cells, const Grains& g)
{
    constexpr double alike = 1e-6;
    const int walls = static_cast<int>(solid.walls.size());
    for (const Facet& f : g.facets) {
        if (f.wall < 0 || f.wall >= walls) {
            refuse("solid_constants: wall of a facet", static_cast<double>(f.wall), "",
                "must be below " + std::to_string(walls) + "; give the solid of the cells");
        }
    }
    double volume = 0.0;
    for (double v : cells.volumes)
        volume += v;
    if (!(std::fabs(volume - solid.volume) <= alike * solid.volume)) {
        refuse("solid_constants: volume of the solid", solid.volume, "m^3",
            "must be that of the cells, " + number(volume) + "; give the solid of the cells");
    }
}

}  // namespace

SolidExtension solid_extension(
    const Polyhedra& cells, const Solid& solid, const SolidElasticity& material, FacePointRule rule)
{
    const Grains g = make_grains(cells, material, rule);
    require_cells_of(solid, cells, g);
    const auto bottom = nodes_on(g, solid, SolidSide::bottom);
    const auto top = nodes_on(g, solid, SolidSide::top);
    const double height = solid.high.z - solid.low.z, section = solid.volume / height;
    // a strain of 1: the solution is linear
    const auto size = static_cast<Eigen::Index>(3 * g.places.size());
    Operator on { &g, std::vector<std::uint8_t>(size, 0) };
    Numbers given = Numbers::Zero(size), guess = Numbers::Zero(size);
    for (std::size_t n = 0; n < g.places.size(); ++n) {
        const double way = g.places[n].z - solid.low.z;
        on.held[3 * n + 2] = bottom[n] | top[n];
        (on.held[3 * n + 2] ? given : guess)[static_cast<Eigen::Index>(3 * n + 2)] = way;
    }
    Numbers load = Numbers::Zero(size);
    add_forces(g, given, load);
    load = -load;
    on.project(load);

    const FreeStiffness matrix(on);
    Eigen::ConjugateGradient<FreeStiffness, Eigen::Lower | Eigen::Upper, BlockPreconditioner>
        solver;
    solver.setTolerance(balanced);
    solver.setMaxIterations(most_iterations);
    solver.compute(matrix);
    const Numbers found = solver.solveWithGuess(load, guess);
    if (solver.info() != Eigen::Success) {
        fail("elastic solution: residual", number(solver.error()),
            "must be below " + number(balanced) + " after " + std::to_string(most_iterations)
                + " iterations; check the stiffness of contacts against that of grains");
    }
    const Numbers u = given + found;
    Numbers forces = Numbers::Zero(size);
    add_forces(g, u, forces);
    double reaction = 0.0, widening = 0.0;
    for (std::size_t n = 0; n < g.places.size(); ++n)
        if (top[n]) reaction += forces[static_cast<Eigen::Index>(3 * n + 2)];
    // Gauss: the sum of both lateral strains times the volume
    for (const Facet& f : g.facets) {
        const Wall& wall = solid.walls[f.wall];
        if (wall.side == SolidSide::bottom || wall.side == SolidSide::top) continue;
        for (int n : f.nodes)
            widening += f.area / 3.0 * dot(wall.normal, at(u, n));
    }
    SolidExtension result { { reaction / section, -0.5 * widening / solid.volume,
                                static_cast<int>(solver.iterations()), solver.error() },
        {} };
    for (int n = 0; n < static_cast<int>(g.places.size()); ++n)
        result.field.push_back(at(u, n));
    return result;
}

SolidConstants solid_constants(
    const Polyhedra& cells, const Solid& solid, const SolidElasticity& material, FacePointRule rule)
{
    return solid_extension(cells, solid, material, rule).constants;
}

}  // namespace flexpm
