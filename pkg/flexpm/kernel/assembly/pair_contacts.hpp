// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The saved state of pairs of grains that have no face in common: grains that meet anew, and
/// grains whose common face has ended. SI units.
#pragma once

#include <flexpm/kernel/assembly/contacts.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// A pair of near grains. It presses while the grains overlap by more than the clearance, and rubs
/// through one spring. What has no other note is of the last forces.
struct PairContact {
    GrainPair grains { 0, 0 };
    int law = 0;             ///< index into the laws of the contacts
    int face = -1;           ///< contact that the pair has taken over from, -1: none
    double clearance = 0.0;  ///< depth of overlap that does not press [m]

    Vector normal;              ///< unit vector, force on the second grain by pressure; 0: none
    double normal_force = 0.0;  ///< [N]
    double area = 0.0;          ///< pressed area [m^2]
    Vector place;               ///< where the force acts [m]
    Vector force;               ///< on the second grain, friction included [N]
    double depth = 0.0;         ///< largest depth of overlap beyond the clearance [m]
    double mass_area = 0.0;     ///< pressed area that masses have been raised for [m^2]

    Vector slip;         ///< elastic slip of the second grain against the first [m]
    double twist = 0.0;  ///< the same about the normal [rad]
    /// Plastic slip since the crack of `face` [m]; without effect if there is none.
    double crack_slip = 0.0;

    double elastic_energy = 0.0;   ///< of overlap and spring [J]
    double friction_energy = 0.0;  ///< dissipated so far [J]

    bool presses() const { return normal_force > 0.0; }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("grains", s.grains);
        visit("law", s.law);
        visit("face", s.face);
        visit("clearance", s.clearance);
        visit("normal_x", s.normal.x);
        visit("normal_y", s.normal.y);
        visit("normal_z", s.normal.z);
        visit("normal_force", s.normal_force);
        visit("area", s.area);
        visit("place_x", s.place.x);
        visit("place_y", s.place.y);
        visit("place_z", s.place.z);
        visit("force_x", s.force.x);
        visit("force_y", s.force.y);
        visit("force_z", s.force.z);
        visit("depth", s.depth);
        visit("mass_area", s.mass_area);
        visit("slip_x", s.slip.x);
        visit("slip_y", s.slip.y);
        visit("slip_z", s.slip.z);
        visit("twist", s.twist);
        visit("crack_slip", s.crack_slip);
        visit("elastic_energy", s.elastic_energy);
        visit("friction_energy", s.friction_energy);
    }
};

}  // namespace flexpm
