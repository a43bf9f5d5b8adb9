// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Where the discs of two grains touch, and on which edges of their cells a contact acts
/// there, paper Sec. 2.3 and Eqs. 5-8. SI units.
#pragma once

#include <flexpm/kernel/assembly/contacts.hpp>
#include <flexpm/kernel/assembly/grains.hpp>

namespace flexpm {

/// Point on the outline of a grain's cell that is closest to a touch.
struct ClosestPoint {
    int node_0, node_1;    ///< of the edge
    double weight;         ///< share of the edge's second node [-]
    double along_tangent;  ///< length of the edge along the tangent of the touch [m]
    double edge_length;    ///< [m]
};

struct TouchPoint {
    Point normal;             ///< unit vector from the first grain to the second
    ClosestPoint closest[2];  ///< on each grain
};

/// Touch point of the discs of a pair at its present positions, Eq. 7.
TouchPoint touch_point(const Grains& grains, GrainPair pair);

/// Let all points of a contact act at a touch point.
void attach(Contacts& contacts, int contact, const TouchPoint& touch);

/// Whether a contact acts elsewhere than at a touch point, by more than a small part of an edge.
bool is_elsewhere(const Contacts& contacts, int contact, const TouchPoint& touch);

}  // namespace flexpm
