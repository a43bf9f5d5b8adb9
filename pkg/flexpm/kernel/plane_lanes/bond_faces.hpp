// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The two faces that a bond has left where it cracked: the edges of its grains, which lay
/// on each other when bonded. Deviation D59. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <array>

namespace flexpm {

/// Where the faces of a bond lie against each other now.
struct BondFaces {
    Point start[2];  ///< of the edge of each grain [m]
    Point along[2];  ///< from there to its end [m]
    Point normal;    ///< unit vector across the mean of both, from the first grain to the second

    /// From the place at a share of the first edge's second node to that at one of the other's [m].
    Point apart(double share_a, double share_b) const;

    /// Distance of the middles along the mean of both edges, as a part of its length [-].
    double slide() const;

    /// Cosine of the angle between the edges, and the angle [rad].
    double cosine() const;
    double turn() const;
};

/// The faces of a contact that has been a bond.
BondFaces bond_faces(const Assembly& a, int contact);

/// How far two faces have parted from where they lay when bonded: 0 as long as they have slid by
/// less than half an edge and turned by less than 30 degrees, 1 from twice that on, and where the
/// middle of one lies by half an edge behind the other.
double parting(const BondFaces& faces);

/// Whether they lie as they did, by this part of what parting() allows.
bool is_facing(const BondFaces& faces, double part = 1.0);

}  // namespace flexpm
