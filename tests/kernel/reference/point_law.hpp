// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The law of one contact point, written from doc/theory line by line.
#pragma once

#include "reference/plain_specimen.hpp"

namespace plain {

/// Tractions of a point [Pa], and whether this step used up its damage.
struct PointTraction {
    double normal = 0.0;
    double shear = 0.0;
    double gap = 0.0;  ///< opening less dilation [m]
    bool cracks = false;
};

/// Advance a point by an opening and a slip [m].
///
/// The law jumps where a brittle point reaches its strength, and the record of cracks where D
/// reaches 1. ContactPoint::doubt says how far the step was from the nearest of these, as a part of
/// the quantity that decides.
PointTraction advance(
    const flexpm::LawParameters& law, double opening_step, double slip_step, ContactPoint& point);

}  // namespace plain
