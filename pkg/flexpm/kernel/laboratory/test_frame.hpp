// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Where an axial test takes its load and its strains from, and what they refer to: one
/// maker for each outline and way to hold it; part_frame() is in part_measures.hpp. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/laboratory/loading_scales.hpp>

#include <functional>

namespace flexpm {

/// Forces along the loading that hold a specimen at its ends [N].
struct EndForces {
    double bottom = 0.0;
    double top = 0.0;
};

/// Strains of a test [-]: axial positive in the sense of the loading, lateral as Poisson's effect;
/// nan: there is none.
struct TestStrains {
    double axial = 0.0;
    double lateral = 0.0;
};

/// Frame of a specimen of the plane, or of another one whose state is known here by name alone.
template <class State> struct StateFrame {
    double area = 0.0;    ///< stress = load / area [m^2]
    double height = 0.0;  ///< to which the axial strain refers [m]
    Sense sense = Sense::compression;
    std::function<EndForces(const State&)> ends;  ///< at the last step
    std::function<TestStrains(const State&)> strains;
    std::function<double(const State&)> confinement;  ///< [Pa]; none: there is no lateral pressure
};
using TestFrame = StateFrame<Assembly>;

/// A rectangle between its bottom and top: mean motion of its sides, pressure on the right one.
/// @throws std::invalid_argument  unless the outline has four sides
TestFrame rectangle_frame(const Assembly& a, Sense sense);

/// A disc between a lower and an upper plate, the first two of the assembly: strains are
/// the closure of the plates and the widening of the disc over its diameter, the stress is the
/// tensile one of an elastic disc's centre, 2 P / (pi D t), with P the mean of both plates' forces.
/// @throws std::invalid_argument  if the diameter is not above zero or there are no two plates
TestFrame disc_frame(const Assembly& a, double diameter);

/// The scales of such tests, of the specimen as it is.
/// @throws std::invalid_argument  as the makers, but a disc may lie between no plates
TestScales rectangle_scales(const Assembly& a, Sense sense, double dt);
TestScales disc_scales(const Assembly& a, double diameter, double dt);

/// Area over which the force of a Brazilian test gives its stress 2 P / (pi D t) [m^2].
double splitting_area(double diameter, double thickness);

/// Lateral strain of a rectangle where nodes move so, in the layout of Grains::displacement;
/// positive as Poisson's effect [-].
double lateral_strain(const Assembly& a, Sense sense, const Array<double>& moved);

}  // namespace flexpm
