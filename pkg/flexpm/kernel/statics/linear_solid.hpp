// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  All that is linear in a solid of bonded polyhedral grains, intact and at small strains:
/// tetrahedra, points of faces, smooth plates. SI units.
#pragma once

#include <flexpm/kernel/iteration/free_solve.hpp>
#include <flexpm/kernel/parts/plate_springs.hpp>

#include <array>
#include <vector>

namespace flexpm {

struct LinearSolid : LinearForces {
    struct Element {
        std::array<int, 4> nodes;
        TetrahedronShape shape;
        int kind;  ///< index into `kinds`
    };
    /// A point of a face, most of which lie at a corner.
    struct Spring {
        double area;
        int corner;                  ///< where it lies; -1: at none
        std::vector<double> shares;  ///< of the corners; empty at one

        double share(int k) const { return corner < 0 ? shares[k] : corner == k ? 1.0 : 0.0; }
    };
    struct Face {
        std::array<std::vector<int>, 2> nodes;  ///< corners of both sides
        Vector normal;
        double normal_stiffness, shear_stiffness;  ///< [Pa/m]
        std::vector<Spring> springs;
    };
    /// A plate before a place of a surface triangle; it bears both ways, and grains stick to it.
    struct Press {
        int plate;
        bool touches;
        std::array<int, 3> nodes;
        std::array<double, 3> shares;  ///< of the nodes in that place
        Vector normal;
        double stiffness;  ///< [N/m]
        double sliding;    ///< the same along its face; 0: smooth [N/m]
        Vector opens;      ///< growth of its gap as the plate follows, see PlateStiffness::add():
                           ///< by a give where a load moves the plate, by turns on a seat
    };

    std::vector<PlaneStiffness> kinds;  ///< of elements
    std::vector<Vector> places;         ///< of nodes, grain after grain, the centre last
    std::vector<int> first_nodes;       ///< of grains, whose elements follow each other, too; then
                                        ///< the number of nodes
    std::vector<Element> elements;
    std::vector<Face> faces;
    std::vector<Press> presses;

    /// Let threads share add(). Its sums keep their bits: a thread has the forces on nodes of its
    /// own grains alone, in the order in which one thread adds them.
    void share_among(int threads);

    /// Unknowns are the displacements of the nodes.
    void add(const double* u, double* forces) const override;
    DiagonalBlocks diagonal_blocks() const override;
    /// Smooth motions that open no contact, and, where contacts are compliant, those in which grains
    /// stay rigid.
    std::vector<std::unique_ptr<WideMotions>> wide_motions(
        const std::vector<std::uint8_t>& held) const override;
    RigidPart rigid_part(int triple) const override { return { 1.0, 0.0, places[triple] }; }

    /// Stiffness of the contacts of plates, by their numbers, against what is free of them.
    std::vector<PlateStiffness> plate_stiffness() const;

    /// Motions of what is free of plates where nodes move so: no force and moment is on it then. By
    /// their numbers; none of others.
    /// @param way_of  way(press): that of its plate along the contact's normal, if this is given
    ///         [m]
    template <class Way> std::vector<Vector> following(const double* u, Way way_of) const
    {
        const std::vector<PlateStiffness> stiffness = plate_stiffness();
        std::vector<Vector> motions(stiffness.size());
        for (const Press& p : presses) {
            if (p.opens.x == 0.0 && p.opens.y == 0.0 && p.opens.z == 0.0) continue;
            const double gap = dot(p.normal, way_before(p, u)) - way_of(p);
            motions[p.plate] = motions[p.plate] - p.stiffness * gap * p.opens;
        }
        for (std::size_t i = 0; i < motions.size(); ++i)
            motions[i] = stiffness[i].moved_by(motions[i]);
        return motions;
    }

    /// Way of the specimen before a contact of a plate.
    Vector way_before(const Press& p, const double* u) const;

    /// Where a contact of a plate lies.
    Vector place_of(const Press& p) const;

private:
    /// What one thread adds forces to, and what has a part in these.
    struct Share {
        int node = 0, end_node = 0;
        std::size_t element = 0, end_element = 0;
        std::vector<int> faces;  ///< with a side among the nodes

        bool owns(int n) const { return node <= n && n < end_node; }
    };
    std::vector<Share> shares_;  ///< of threads; none: one adds all

    Share share_of(int node, int end_node) const;
    std::vector<int> joined_nodes() const;
    void add_elements(const Share& own, const double* u, double* forces) const;
    void add_faces(const Share& own, const double* u, double* forces) const;
    void add_presses(const double* u, double* forces) const;
};

/// Spring of a point, by the shares of the corners in its place.
LinearSolid::Spring spring_at(double area, std::vector<double> shares);

/// Forces of a spring for unit jumps, by rows [N/m].
SpaceGradient spring_block(const LinearSolid::Face& face, const LinearSolid::Spring& s);
/// The same of a contact of a plate.
SpaceGradient press_block(const LinearSolid::Press& p);

inline Vector triple_at(const double* u, int node)
{
    return { u[3 * node], u[3 * node + 1], u[3 * node + 2] };
}
inline void add_triple(double* u, int node, Vector v)
{
    u[3 * node] += v.x;
    u[3 * node + 1] += v.y;
    u[3 * node + 2] += v.z;
}

/// Grains that are rigid: unknowns of each are the way of its centre and its turn times its radius.
struct RigidSolid : LinearForces {
    /// Spring of an element between a node and held nodes, by rows [N/m]. Only the preconditioner
    /// uses it.
    struct Hold {
        int node;
        SpaceGradient k;
    };

    const LinearSolid& solid;
    std::vector<int> grain;       ///< of each node
    std::vector<Vector> centres;  ///< of grains
    std::vector<double> radii;
    std::vector<Hold> holds;

    explicit RigidSolid(const LinearSolid& of) : solid(of) { }
    void add(const double* u, double* forces) const override;
    DiagonalBlocks diagonal_blocks() const override;
    /// Smooth motions.
    std::vector<std::unique_ptr<WideMotions>> wide_motions(
        const std::vector<std::uint8_t>& held) const override;
    RigidPart rigid_part(int triple) const override
    {
        const int g = triple / 2;
        if (triple % 2 == 1) return { 0.0, radii[g], {} };
        return { 1.0, 0.0, centres[g] };
    }

    /// Displacements of the nodes, from the unknowns.
    std::vector<double> on_nodes(const double* u) const;
    /// Forces on the unknowns, from those on nodes.
    void gather(const double* on_nodes, double* forces) const;
    /// Call visit(node, its displacement), from the unknowns.
    template <class Visit> void for_each_node(const double* u, Visit visit) const
    {
        for (int n = 0; n < static_cast<int>(grain.size()); ++n) {
            const int g = grain[n];
            const Vector turn = (1.0 / radii[g]) * triple_at(u, 2 * g + 1);
            visit(n, triple_at(u, 2 * g) + cross(turn, solid.places[n] - centres[g]));
        }
    }
};

}  // namespace flexpm
