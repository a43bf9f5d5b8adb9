// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains and contacts that a script erases from a running assembly. SI units.
///
/// They are gone at once from all that is asked of the assembly. Bonds keep their rows for the
/// record of cracks: points that had not cracked are noted as erased and never crack. Should the
/// discs of the pair touch, that is a new contact. What was stored and in motion counts as erased
/// in the energy balance, what was dissipated stays dissipated.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// What a script has erased between two steps.
struct Erasure {
    std::vector<int> grains;    ///< with all of their contacts
    std::vector<int> contacts;  ///< others, by their places, ascending

    bool empty() const { return grains.empty() && contacts.empty(); }
};

/// Take out what is named, and prepare the next step. Places of contacts change.
///
/// @param dt  time step [s]; the forces at its beginning have given the velocities of that step
///         already
void erase(Assembly& a, const Erasure& what, double dt);

}  // namespace flexpm
