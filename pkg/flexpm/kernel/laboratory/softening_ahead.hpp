// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How far contact points are from their strengths along the motion of a loading, deviation
/// D58. SI units, tension positive.
///
/// What ends bear is ahead of what a plane in the specimen bears: by what the load grows by until a
/// wave has told them that the plane softens. Points that soften one after the other tell by what
/// they dissipate that the load must wait (crack_wait.hpp). A plane whose points soften at once has
/// told nothing before. The elastic solution, along which the specimen moves up to there, tells
/// when that will be.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>

namespace flexpm {

struct SofteningRule {
    /// Most that a plane's traction grows by in a crossing as it begins to soften, over what it
    /// bears then [-].
    double growth = 0.01;
    double crossing = 1.0;  ///< steps in which a wave crosses the specimen
};

/// Time at `velocity` after which the first contact point of the unloaded assembly leaves its
/// elastic branch, at small displacements [s]; infinite if none does.
double elastic_time(const Assembly& a, const Array<double>& velocity);

/// Strain, positive, along `sense` (-1: compression) times a field of strain 1 at which the first
/// point of the unloaded specimen leaves its elastic branch [-]; infinite if none does.
double elastic_strain(const SolidState& s, const SolidField& field, double sense);

/// The strain of such a field that is left until then from the present state on, as of a specimen
/// under pressures [-]; 0 if a point has left its elastic branch.
double elastic_strain_left(const SolidState& s, const SolidField& field, double sense);

/// Factor on a velocity of the loading that brings its points to their strengths slowly enough [-];
/// infinite if few enough are on the way there. A point's distance to its strength may shrink by 1
/// / e in a crossing, or its traction grow by `growth`. Of the points that are elastic still, or
/// bear friction and do not slide, those may be faster that make up a twentieth of a cut through a
/// square or a cube as large as the specimen.
///
/// @param velocity  of all nodes in that motion, see loading_field() [m/s]; in 3D the motion that
///                  the loading gives
/// @param dt        time step [s]
/// @throws std::invalid_argument  if a number of the rule is not above zero
double factor_before_softening(
    const Assembly& a, const Array<double>& velocity, double dt, const SofteningRule& rule);
double factor_before_softening(const SolidState& s, double dt, const SofteningRule& rule);

}  // namespace flexpm
