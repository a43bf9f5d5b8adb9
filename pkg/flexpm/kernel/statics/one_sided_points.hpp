// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of contacts and plates that bear pressure alone once their bond is gone, in a
/// linear solution from the present state: open ones and closed ones. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>

#include <vector>

namespace flexpm {

/// Gap over the largest displacement, or over a grain's radius, that is round-off [-].
constexpr double no_gap = 1e-10;

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
        return turn == 0.0 ? displacement
                           : displacement + turn * plate.arms[point] * point_normal(plate, point);
    }
};

/// Force of a plate on the specimen [N], and its moment about its seat [N m].
struct PlatePush {
    Vector force;
    double moment = 0.0;
};

/// Whether each point that can be open is closed.
struct Closed {
    std::vector<char> contacts;             ///< [contact * points + point]
    std::vector<std::vector<char>> plates;  ///< [plate][point]

    bool operator==(const Closed& other) const
    {
        return contacts == other.contacts && plates == other.plates;
    }
};

/// What the points of contacts and plates bear, if they are open and closed as they are told to be.
class OneSidedPoints {
public:
    /// @param a  the present state, which must outlive this
    explicit OneSidedPoints(const Assembly& a) : a(a), points(a.contacts.group.points) { }

    /// Which are closed after displacements [m] from the present state; `size` is that of these.
    Closed closed(
        const Array<double>& moved, const std::vector<PlateWay>& plates, double size) const;

    /// Stiffnesses of the contacts' points; one that is open keeps a part of its own.
    PointSprings springs(const Closed& now, double kept) const;

    /// Take all but that part from open points of plates, in a copy of the state.
    void loosen_plates(const Closed& now, double kept, Assembly& trial) const;

    /// Forces on the nodes at the present displacements [N].
    Array<double> forces(const Closed& now, const Assembly& trial) const;

    /// Traction of a contact's point after a way [m] from the present state [Pa].
    PointTraction traction(const Closed& now, int contact, int point, Point way) const;

    /// Gap of a plate's point then [m].
    double gap(std::size_t plate, int point, const Array<double>& moved, const PlateWay& way) const;

    /// What a plate does to the specimen after displacements [m] from the present state.
    PlatePush plate_push(const Closed& now, const Assembly& trial, std::size_t plate,
        const Array<double>& moved, const PlateWay& way) const;

    /// Calls visit(contact, point) for all that bear.
    template <class Visit> void for_each_point(const Visit& visit) const
    {
        for (int c = 0; c < a.contacts.count; ++c) {
            for (int p = 0; !a.contacts.erased[c] && p < a.contacts.points_of(c); ++p)
                if (a.contacts.area(c, p) > 0.0) visit(c, p);
        }
    }

private:
    PointSpring spring(const Closed& now, int contact, int point, double kept) const;
    Vector point_force(
        const Closed& now, const Assembly& trial, std::size_t plate, int point, Vector way) const;

    const Assembly& a;
    const int points;
};

}  // namespace flexpm
