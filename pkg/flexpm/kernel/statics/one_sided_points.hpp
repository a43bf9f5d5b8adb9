// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of contacts and plates that bear pressure alone once their bond is gone, in a
/// linear solution from the present state: open ones and closed ones. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>

#include <vector>

namespace flexpm {

/// Gap over the largest displacement, or over a grain's radius, that is round-off [-].
constexpr double no_gap = 1e-10;

/// Part of its stiffness that an open point keeps while others are looked at: it keeps what nothing
/// touches yet in its place. The last solution is without.
constexpr double open_share = 1e-6;

/// Solutions that all points take over at once, which nearly always suffice.
constexpr int most_plain_solutions = 20;

/// Whether a plate is pressed by nothing: it gives way to all that would push it.
inline bool is_idle(const Plate& plate)
{
    return plate.loaded && plate.load == 0.0 && !plate.bonded;
}

/// How a plate moves.
struct PlateWay {
    Vector displacement;  ///< [m]
    double turn = 0.0;    ///< about its seat [rad]

    Vector at(const Plate& plate, int point) const
    {
        return turn == 0.0
            ? displacement
            : displacement + turn * seat_arm(plate, point).z * point_normal(plate, point);
    }
};

/// Force of a plate on the specimen [N], and its moment about its seat [N m].
struct PlatePush {
    Vector force;
    double moment = 0.0;
};

/// A mark of each point of contacts and plates, see OneSidedPoints::index_of().
using PointMarks = std::vector<char>;

/// How points bear: pressure, if they are closed; shear, if they stick.
struct Bearing {
    PointMarks closed;
    /// Parts of their ways along that those without a bond stick for, see sticking() [-].
    std::vector<double> sticks;
    /// Part of its stiffness that each point without a bond has besides, from where it is now: it
    /// holds what nothing touches, and makes the energy strictly convex [-].
    double kept = 0.0;
};

/// What the points of contacts and plates bear, if they are open and closed as they are told to be.
class OneSidedPoints {
public:
    /// @param a  the present state, which must outlive this
    explicit OneSidedPoints(const Assembly& a);

    /// Index into PointMarks.
    int index_of(int contact, int point) const { return contact * points + point; }
    int index_of_plate(std::size_t plate, int point) const { return first_of_plate[plate] + point; }

    /// Which are closed after displacements [m] from the present state; `size` is that of these.
    PointMarks closed(
        const Array<double>& moved, const std::vector<PlateWay>& plates, double size) const;

    /// Parts of their ways that closed ones with friction and without a bond stick for: those that
    /// are open now do from where they close on, if all ways grow alike.
    std::vector<double> sticking(const PointMarks& closed, const Array<double>& moved,
        const std::vector<PlateWay>& plates) const;

    /// Whether a contact's point has friction and no bond.
    bool rubs(int contact, int point) const
    {
        return damage_of(a.contacts, contact, point) >= 1.0
            && friction_of(a.contacts, contact, point) > 0.0;
    }

    /// Stiffnesses of all.
    GivenSprings springs(const Bearing& now) const;

    /// Forces on the nodes after displacements, less those now [N].
    Array<double> more_force(
        const Bearing& now, const Array<double>& moved, const std::vector<PlateWay>& plates) const;

    /// Traction of a contact's point after a way [m] from the present state [Pa].
    PointTraction traction(const Bearing& now, int contact, int point, Point way) const;

    /// Gap of a plate's point then [m].
    double gap(std::size_t plate, int point, const Array<double>& moved, const PlateWay& way) const;

    /// What a plate does to the specimen after displacements [m] from the present state.
    PlatePush plate_push(const Bearing& now, std::size_t plate, const Array<double>& moved,
        const PlateWay& way) const;

    /// Calls visit(contact, point) for all that bear.
    template <class Visit> void for_each_point(const Visit& visit) const
    {
        for (int c = 0; c < a.contacts.count; ++c) {
            for (int p = 0; !a.contacts.erased[c] && p < a.contacts.points_of(c); ++p)
                if (a.contacts.area(c, p) > 0.0) visit(c, p);
        }
    }

private:
    PointSpring spring(const Bearing& now, int contact, int point) const;
    PointSpring plate_spring(const Bearing& now, std::size_t plate, int point) const;
    Vector point_way(
        std::size_t plate, int point, const Array<double>& moved, const PlateWay& own) const;
    Vector point_force(const Bearing& now, std::size_t plate, int point, Vector way) const;

    const Assembly& a;
    const int points;
    std::vector<int> first_of_plate;  ///< and the end behind the last one
};

}  // namespace flexpm
