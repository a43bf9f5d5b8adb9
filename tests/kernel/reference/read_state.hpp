// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The solver's own state as a plain specimen, and what sets two states apart.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include "reference/plain_specimen.hpp"

#include <string>

namespace plain {

Specimen read_state(const flexpm::Assembly& a);

/// Largest differences of two states after a step, each as a part of the largest value of its kind.
struct Differences {
    double force = 0.0;  ///< over the largest that anything exerts on a node
    double displacement = 0.0;
    double velocity = 0.0;
    double opening =
        0.0;  ///< slip, and traction over stiffness, over the largest or the largest way of a node
    double damage = 0.0;  ///< D_s, itself a part
    double energy = 0.0;  ///< of damage and friction, over the fracture energies
    double plate = 0.0;   ///< forces of plates over their stiffness, over the largest displacement
    long points = 0;      ///< that were compared
    long excepted = 0;  ///< of them: differ, and the step was within round-off of a jump of the law
    long records = 0;   ///< crack records that differ without being excepted

    void take_larger(const Differences& other);
    double largest() const;
    std::string text() const;
};

/// Compare the states that the kernel's and the plain step have made of the one `before`; the nodes
/// of an excepted point are left out.
Differences compare(const Specimen& before, const Specimen& kernel, const Specimen& plain);

}  // namespace plain
