// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energy and forces of two convex bodies that overlap, in 2D; space/overlap.hpp is its twin
/// in 3D. SI units; in 2D per metre of thickness.
///
/// A body is the set behind the planes (in 2D the lines) of its faces. Over the common part O of
/// two bodies the energy of the pair is
///
///     E = 2 K_n * integral over O of d(x) dV,   d(x) = depth of x below the nearest counted plane
///
/// and the forces are its exact derivatives: a counted plane f is pushed inwards by 2 K_n V_f at
/// the centroid of R_f. R_f is the part of O that is nearest to f, and V_f is its volume. Planes
/// that are not counted (walls) only bound O; the pressure 2 K_n d on a wall pushes it inwards. Two
/// flush faces press with K_n per area and depth. Corners and edges begin softly, without a jump.
///
/// The energy is that of a pressure field 2 K_n d (Elandt et al., IROS 2019, "A pressure field
/// model for fast, robust approximation of net contact force and moment"), with d in place of a
/// field that is interpolated.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Plane of a face. A point x has the depth offset - normal . x below it.
struct ContactPlane {
    Vector normal;         ///< outward unit vector
    double offset = 0.0;   ///< from the centre of the body [m]
    bool counted = false;  ///< else it bounds the body, but is no surface that can be pressed
};

/// Convex body behind its planes. All positions are relative to its centre.
struct ContactBody {
    Vector centre;  ///< any point within or near the body [m]
    const ContactPlane* planes = nullptr;
    int faces = 0;
    /// Points whose convex hull contains the body, such as the corners of flat faces [m]. Without
    /// points, find_corners() computes the corners from the planes, which takes longer.
    const Vector* points = nullptr;
    int count = 0;  ///< number of points
};

/// Force of a pair on one face.
struct FaceForce {
    int face = 0;  ///< of the first body; faces of the second body follow
    Vector force;  ///< over K_n, along the normal of the face [m^3; m^2 in 2D]
    Vector point;  ///< in the plane of the face, relative to the centre of its body [m]
};

/// Measures of the overlap of a pair.
struct BodyOverlap {
    double energy = 0.0;  ///< over K_n [m^4; m^3 in 2D]
    double depth = 0.0;   ///< largest depth d below the planes, less the clearance [m]
    double area = 0.0;    ///< of counted faces in the other body: the smaller sum of both [m^2; m]
};

/// Rules of the plane: faces are edges with two corners, and the third components are 0.
struct InPlane {
    static constexpr int dimension = 2;

    /// Part of a line. Positions on it are origin + u first.
    class Piece {
    public:
        void reserve(int) { }
        void start(double reach, double);
        /// Keep the part with a - b u >= 0. Return false if nothing is left.
        bool cut(double a, double b, double);
        /// Largest value of a - b u.
        double largest(double a, double b, double) const;
        /// Length, centre, and second moments about the centre.
        double size() const { return to - from; }
        std::array<double, 2> centre() const { return { 0.5 * (from + to), 0.0 }; }
        std::array<double, 3> moments() const;
        int corners() const { return 2; }
        std::array<double, 2> corner(int i) const { return { i == 0 ? from : to, 0.0 }; }

    private:
        double from = 0.0, to = 0.0;
    };

    /// Tangents of a line or plane with this unit normal.
    static std::array<Vector, 2> tangents(Vector normal)
    {
        return { Vector { -normal.y, normal.x, 0.0 }, Vector { 0.0, 0.0, 1.0 } };
    }

    /// Line of an edge. The body lies on the left, seen from corner 0 to corner 1.
    static ContactPlane plane_of(const Vector* corners, int count);

    /// Add the forces on the corners of an edge, which are the exact derivatives of the energy: the
    /// edge's two shares at the point of the force.
    static void spread(const Vector* corners, int count, const FaceForce& on, Vector* forces);
};

/// BodyOverlap of pairs of bodies, one pair at a time. The object owns the memory that a pair needs and
/// allocates only while this memory grows. Each thread has its own object.
template <class Geometry> class PairOverlap {
public:
    /// BodyOverlap of two bodies, and the forces on their faces.
    /// @param clearance   counted planes are moved inwards by it; may be negative [m]
    /// @param separating  index of the plane that separated both bodies last (faces of the second
    ///                    body follow those of the first), or -1. It is tested first, is updated,
    ///                    and has no influence on the result
    BodyOverlap measure(
        const ContactBody& a, const ContactBody& b, double clearance, int* separating = nullptr);

    /// Forces of the last pair on its touched faces, by face.
    const std::vector<FaceForce>& forces() const { return on_faces; }

    /// Clearance [m] at which two bodies have a given energy over K_n, or birth_clearance() for an
    /// energy of 0. Newton's method within bounds that bisection keeps. forces() are then the
    /// forces at this clearance.
    /// @param energy  [m^4; m^3 in 2D]
    /// @throws std::invalid_argument  for an energy that is not finite, is negative, or that no
    ///                                clearance gives
    double clearance_for(const ContactBody& a, const ContactBody& b, double energy);

    /// Clearance [m] at which a pair that is found overlapping has no energy and no force, to the
    /// bit; 0 for bodies that do not overlap.
    double birth_clearance(const ContactBody& a, const ContactBody& b);

    /// Corners of the body behind some planes. If faces are bent, their nodes are not corners of
    /// this body. Positions are relative to its centre.
    void find_corners(const ContactPlane* planes, int faces, std::vector<Vector>& corners);

private:
    /// Plane in the frame of the box around the overlap.
    struct Active {
        Vector normal;
        double depth;            ///< of the origin
        double lowest, highest;  ///< depth in the box
        int face;
        bool counted;
    };
    /// Sums over the part of the overlap that is nearest to a counted plane, or over a wall.
    struct Sums {
        double volume = 0.0;
        Vector moment;
        double area = 0.0;
    };
    struct Box {
        std::array<Vector, 3> axes;
        Vector centre;            ///< from the middle of the pair
        Vector half;              ///< lengths
        double largest_depth;     ///< no point of the overlap is deeper
        double reach, size, tie;  ///< half diagonal; size of the pair; round-off
        double slack;             ///< least distance of the overlap from the rim
    };

    void load(const ContactBody& body, Vector shift, double clearance, int which);
    bool find_box(int* separating);
    bool find_prism();
    bool is_in_prism(Vector at) const;
    bool find_active();
    void drop_hidden();
    void add_ridge(std::size_t i, std::size_t j, BodyOverlap& sum);
    void add_wall(std::size_t w, std::size_t i, BodyOverlap& sum);
    void finish(const ContactBody& a, const ContactBody& b, BodyOverlap& sum);
    void add_cone(std::size_t i, const Active& q, double factor, Vector centre, BodyOverlap& sum);
    std::array<double, 2> range(Vector normal) const;
    double lowest_over(int plane, int which) const;
    void extend(int which, int plane, std::array<double, 6>& bounds);

    std::array<std::vector<ContactPlane>, 2> planes;  ///< in the frame of the pair, moved inwards
    std::array<Array<double>, 2> x, y, z;             ///< of points, the last of them repeated
    std::array<int, 2> number {};                     ///< of points
    std::array<Vector, 2> shift;                      ///< centres from the middle of the pair
    std::vector<Vector> own_corners;
    Box box {};
    std::vector<Active> active;
    std::vector<std::array<double, 2>> prism;  ///< corners of its section across the first axis
    std::vector<std::array<double, 3>> sides;  ///< conditions of the prism
    std::vector<char> is_hidden;
    std::vector<Sums> sums;
    Vector reference;  ///< point of the overlap, from which moments are taken
    bool has_reference = false, is_astray = false;
    std::vector<std::array<double, 4>> inside, outside;
    std::vector<FaceForce> on_faces;
    typename Geometry::Piece piece;
};

using PlaneOverlap = PairOverlap<InPlane>;
extern template class PairOverlap<InPlane>;

}  // namespace flexpm
