// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One value of each grain, by which a window colours it. Stresses are positive in tension,
/// SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <optional>
#include <string>
#include <vector>

namespace flexpm {

/// What a value says of a grain.
enum class GrainValue {
    stress_xx,
    stress_yy,
    stress_xy,  ///< means over the grain [Pa]; of a rigid one by the forces on it
    stress_zz,
    stress_yz,
    stress_xz,     ///< in 3D alone
    displacement,  ///< of its centre since it was bonded [m]
    damage,        ///< mean over the points of its bonds [-]
    mineral,       ///< number in the material
    fragment,      ///< number by area or volume, 0 the largest; grains hang together as in
                   ///< fragments.csv
};

/// The value with a name, as it stands above; none of any other name, or of one that grains of so
/// many dimensions do not have.
std::optional<GrainValue> grain_value(const std::string& name, int dimensions = 2);

/// Whether values are numbers of kinds, not quantities.
bool is_kind(GrainValue what);

/// What stands beside a scale, with the unit in which scale_factor() gives the values.
std::string scale_title(GrainValue what);

/// Values in the unit of scale_title() over those in SI units.
double scale_factor(GrainValue what);

/// One value for each grain; nan for one that is erased. `State` is Assembly or SolidState.
template <class State> std::vector<double> grain_values(const State& s, GrainValue what);

/// Lowest and highest corner of a box around all grains that are there [m].
struct Extent {
    Vector low;
    Vector high;
};
Extent extent_of(const Grains& grains);

}  // namespace flexpm
