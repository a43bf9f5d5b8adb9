// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sums over a specimen of 2D or 3D: energies, unbalanced force, cracks, and the search for
/// bad numbers. `State` is Assembly or SolidState. All sums run in a fixed order. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <string>

namespace flexpm {

/// Energy balance at the last step [J]. What went in, boundary_work + initial, equals the sum of
/// the others but for the discrete steps of the law.
struct Energies {
    double kinetic = 0.0;  ///< 1/2 m v(n-1/2) v(n+1/2); of the last measured step
    double elastic = 0.0;  ///< elements, contact points and plates
    double damage = 0.0;
    double softened = 0.0;  ///< part of the damage: in points that have not cracked
    double friction = 0.0;
    double damping = 0.0;  ///< taken from what moves beyond the motion that damping leaves alone
    /// Taken from that motion, of the loading and of the descent (D30, D55): below 0 what damping
    /// has given to it.
    double drag = 0.0;
    double potential = 0.0;      ///< in the field of gravity, 0 at the reference
    double erased = 0.0;         ///< has left with grains and bonds that scripts have erased
    double boundary_work = 0.0;  ///< of prescribed velocities, plates and edge pressure
    double initial = 0.0;
};

template <class State> Energies energies(const State& s);

/// Those of the energies that say what a loading does to the specimen [J].
struct Dissipation {
    double damage = 0.0;
    double friction = 0.0;
    double boundary_work = 0.0;
};

template <class State> Dissipation dissipation(const State& s);

/// Power that local damping takes from what grains, loaded plates and floating node sets move beyond
/// the motion that damping leaves alone, by the forces and velocities of the last step [W, or J per
/// unit step]. Waves that cracks send out feed it.
template <class State> double damping_power(const State& s, double damping);

/// Start a new energy balance: the present energy becomes the initial energy, works and
/// dissipation count from zero. Before the first step the kinetic energy is that of the velocities
/// set; later it is that of the last step, which must have been measured.
void reset_energy_balance(Assembly& a);

/// Kinetic energy as if no force acted on the present velocities: 1/2 m v^2 [J].
double kinetic_of_velocities(const Grains& grains);

/// The same of grains, loaded plates and floating node sets [J].
template <class State> double kinetic_of_velocities(const State& s);

/// Largest force component on a free node, on a loaded part per grain (D103), over the mean contact
/// force [-]; of the last measured step. 1 if a node bears a force and no contact does; else 0.
template <class State> double unbalanced_ratio(const State& s);

/// Cracked points; erased ones did not crack.
struct CrackCount {
    int tensile = 0;
    int shear = 0;
};
template <class State> CrackCount count_cracks(const State& s);

/// Empty if all is well, else one line that names the step, the grain and the quantity that is not
/// a finite number.
std::string find_bad_number(const BondedState& s);

}  // namespace flexpm
