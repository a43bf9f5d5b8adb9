// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A specimen for static solutions, and ends that hold it. SI units.
#pragma once

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>

#include "support/specimens.hpp"

#include <vector>

namespace statics {

/// A rectangle of 20 mm x 40 mm.
inline flexpm::Assembly random_assembly()
{
    return specimens::assemble(specimens::random_grains(0.02, 0.04, 3e-3, 11),
        specimens::options(specimens::strong_contact(1.80e14)));
}

/// The bottom held along y, one of its nodes also along x, and the top moved by so much [m].
inline std::vector<flexpm::Prescribed> hold_sides(
    const flexpm::Assembly& a, double top_displacement)
{
    const std::vector<int> bottom = flexpm::side_nodes(a, 0);
    std::vector<flexpm::Prescribed> p { { bottom.front(), 0.0 } };
    for (int n : bottom)
        p.push_back({ flexpm::component(n, 1), 0.0 });
    for (int n : flexpm::side_nodes(a, 2))
        p.push_back({ flexpm::component(n, 1), top_displacement });
    return p;
}

}  // namespace statics
