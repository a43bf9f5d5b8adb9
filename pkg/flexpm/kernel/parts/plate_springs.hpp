// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The springs of a plate's contacts, as the plate follows what it touches: by a give
/// against its normal, and by turns about two axes on a seat. SI units.
/// Deviation D95: the spring of a machine and a seat have no mass.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Axes about which a plate with this normal turns on its seat; z is the first of one in the plane.
std::array<Vector, 2> seat_axes(Vector normal);

/// Stiffness of springs against a plate's motion: a give [m] and two turns [rad].
class PlateStiffness {
public:
    /// @param opens  what the spring's gap grows by with a give [-] and with both turns [m]
    void add(double stiffness, Vector opens);
    /// The spring of a machine, against the give alone.
    void add_machine(double stiffness) { xx_ += stiffness; }

    /// Motion under a force [N] and two moments [N m]; none where no spring is against it.
    Vector moved_by(Vector load) const;

private:
    double determinant() const;
    Vector with_rest(Vector load) const;

    double xx_ = 0.0, xy_ = 0.0, xz_ = 0.0, yy_ = 0.0, yz_ = 0.0, zz_ = 0.0;
};

/// A contact of a plate that follows what it touches.
struct SoftContact {
    double gap;        ///< before the plate moves [m]
    double stiffness;  ///< [N/m]
    Vector opens;      ///< see PlateStiffness::add()
};

/// A plate before a step's end. The energy of its springs over its motion is convex, in pieces of
/// second order, as contacts that do not pull come and go.
struct SoftPlate {
    double machine = 0.0;      ///< stiffness of the spring behind it; 0: none [N/m]
    double give_before = 0.0;  ///< what that spring is shorter by [m]
    bool bonded = false;       ///< contacts pull, too
    std::vector<SoftContact> contacts;

    /// Motion to the least energy.
    Vector least() const;

private:
    bool bears(const SoftContact& c, Vector x) const;
    Vector newton_step(Vector x, std::vector<char>& bearing) const;
    double slope(Vector x, Vector step) const;
    double least_along(Vector x, Vector step) const;
    double largest_change(Vector step) const;
    double largest_gap(Vector x) const;
};

}  // namespace flexpm
