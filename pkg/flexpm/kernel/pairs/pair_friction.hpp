// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Friction of a pair of grains: a spring along the surface and one about its normal, each of
/// which slips at Coulomb's limit. SI units.
#pragma once

#include <flexpm/kernel/assembly/pair_contacts.hpp>

namespace flexpm {

/// How a pair presses now.
struct PairPress {
    Vector normal;       ///< unit vector
    double force = 0.0;  ///< [N], > 0
    double area = 0.0;   ///< [m^2], > 0
};

/// Motion of the second grain against the first in a step, where the pair presses.
struct PairWay {
    Vector slip;         ///< along the surface [m]
    double twist = 0.0;  ///< about the normal [rad]
};

/// What the springs bear: the force and the moment about the normal that hold the second grain back.
struct PairFriction {
    Vector force;         ///< [N]
    double moment = 0.0;  ///< [N m]
    double slid = 0.0;    ///< plastic slip of the step [m]
};

/// Polar radius of gyration of a disc with an area [m].
double polar_radius(double area);

/// Energy of the springs [J].
double spring_energy(const PairContact& pair, double shear_stiffness);

/// Turn the springs of a pair with its normal, let them follow its pressed area, and advance them by
/// the motion of a step.
///
/// Stiffnesses are K_s A and K_s A r^2, with the polar radius r of the area. Where the area grows,
/// forces stay; where it shrinks, elastic slips stay: stored energy falls in either case, and is
/// dissipated. The limits are mu N, and mu N times 0.943 r, which is that of a disc under even
/// pressure.
///
/// @param pair             normal, area, slip, twist and friction_energy are advanced
/// @param shear_stiffness  K_s [Pa/m]
/// @param friction         mu [-]
PairFriction advance_friction(PairContact& pair, const PairPress& press, const PairWay& way,
    double shear_stiffness, double friction);

/// Friction of a pair: of one that has met anew the residual friction of its law [-].
double friction_of(const PairContact& pair, const LawParameters& law);

/// Leave the springs of a pair that does not press: what they store is dissipated.
void release_friction(PairContact& pair, double shear_stiffness);

}  // namespace flexpm
