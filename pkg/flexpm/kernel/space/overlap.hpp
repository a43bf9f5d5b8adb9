// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energy and forces of two convex bodies that overlap, in 3D: geometry/overlap.hpp has the
/// formulas and the twin in 2D. SI units.
#pragma once

#include <flexpm/kernel/geometry/overlap.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Rules of space: faces are polygons.
struct InSpace {
    static constexpr int dimension = 3;

    /// Convex polygon in a plane. Positions in it are origin + u first + v second.
    class Piece {
    public:
        /// Make room for a number of cuts.
        void reserve(int cuts);
        void start(double along, double across);
        /// Keep the part with a - b u - c v >= 0. Return false if nothing is left.
        bool cut(double a, double b, double c);
        /// Largest value of a - b u - c v.
        double largest(double a, double b, double c) const;
        /// Area, centre, and second moments about the centre.
        double size() const;
        std::array<double, 2> centre() const;
        std::array<double, 3> moments() const;
        int corners() const { return n; }
        std::array<double, 2> corner(int i) const { return { now[i].u, now[i].v }; }

    private:
        struct Corner {
            double u, v;
        };
        int n = 0;
        Corner *now = nullptr, *next = nullptr;  ///< corners, and those after the next cut
        std::vector<Corner> room;
        std::vector<double> value;  ///< by corner, of the condition
    };

    /// Tangents of a plane with this unit normal.
    static std::array<Vector, 2> tangents(Vector normal);

    /// Plane of a face: through the mean of its corners, normal to its area vector.
    /// @param corners  counter-clockwise as seen from outside
    static ContactPlane plane_of(const Vector* corners, int count);

    /// Add the forces on the corners of a face, which are the exact derivatives of the energy:
    /// equal shares, and the forces that turn the area vector for the couple about the mean.
    static void spread(const Vector* corners, int count, const FaceForce& on, Vector* forces);
};

using SpaceOverlap = PairOverlap<InSpace>;
extern template class PairOverlap<InSpace>;

}  // namespace flexpm
