// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Record of a test whose specimen is held and loaded by parts: supports, rollers and boxes,
/// each a plate against a part of the outline, and node sets. SI units; load and displacement are
/// positive along the loading.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/laboratory/test_frame.hpp>

#include <limits>
#include <vector>

namespace flexpm {

/// The parts of a test, and the sizes that turn load and displacement into its stress and strain.
struct PartGeometry {
    std::vector<int> driven;   ///< plates that load, which move alike
    std::vector<int> holding;  ///< plates that hold against them; none: the load alone counts
    Vector direction;          ///< of the loading, a unit vector; zero if the loading turns
    double area = 0.0;         ///< stress = load / area [m^2]
    double length = 0.0;       ///< strain = displacement / length [m]

    std::vector<int> driven_sets = {};   ///< node sets that move along, or turn
    std::vector<int> back_sets = {};     ///< those that turn the other way
    std::vector<int> holding_sets = {};  ///< those that hold against a direction
    /// Axis about which sets turn, a unit vector, in 2D z; load and way are then moments [N m] and
    /// an angle. Zero: nothing turns.
    Vector turn = {};

    bool turns() const { return norm(turn) != 0.0; }
};

/// @throws std::invalid_argument  if a part is not there or a size is not above zero
void check_parts(const BondedState& s, const PartGeometry& parts);

/// @throws std::invalid_argument  if the parts leave the whole specimen free to move or turn
void require_held(const Assembly& a);

/// Forces along the loading: of the holding parts and of the driven ones; of what turns moments
/// [N, or N m].
EndForces part_forces(const BondedState& s, const PartGeometry& parts);

/// Load [N, or N m]: mean of what the driven parts push and the holding ones push back; 0 if nothing
/// is driven. Deviation D25.
double part_load(const BondedState& s, const PartGeometry& parts);

/// Change of the driven parts' push in a unit of time, where nodes move at such velocities, in the
/// layout of Grains::displacement, and plates at their own; that of sets is the one of the loading
/// [N/s].
double part_load_rate(const Assembly& a, const PartGeometry& parts, const Array<double>& velocity);

/// Way of the driven parts along the loading [m], or their angle [rad].
double part_displacement(const BondedState& s, const PartGeometry& parts);

/// The frame of such a test; its load is positive as tension is. There is no lateral strain and no
/// confinement.
/// @throws std::invalid_argument  as check_parts()
template <class State> StateFrame<State> part_frame(const State& s, const PartGeometry& parts)
{
    check_parts(s, parts);
    StateFrame<State> frame;
    frame.area = parts.area;
    frame.height = parts.length;
    frame.sense = Sense::tension;
    frame.ends = [parts](const State& now) { return part_forces(now, parts); };
    frame.strains = [parts](const State& now) {
        return TestStrains { part_displacement(now, parts) / parts.length,
            std::numeric_limits<double>::quiet_NaN() };
    };
    return frame;
}

/// Middle of the specimen, by the centres of its grains, and the length of the diagonal [m].
struct CentreExtent {
    Vector middle;
    double size;
};
CentreExtent centre_extent(const Grains& grains);

/// Elastic solution of a test for a unit way of the driven parts.
struct PartSolution {
    double mass;       ///< twice the kinetic energy at a unit velocity [kg, or kg m^2]
    double stiffness;  ///< load over way of the driven parts [N/m, or N m]
    double softening;  ///< way at which the first contact point leaves its elastic branch [m]
};

/// Scales from that solution, see part_scales().
/// @param compressed  inputs of the scales of the specimen in compression
/// @param width       thickness or root of the area, as of the parts' stress [m]
TestScales scales_of_parts(const Grains& grains, const PartGeometry& parts,
    const PartSolution& solution, double strength, const ScaleInputs& compressed, double width);

/// Scales of such a test, from its elastic solution for a unit way of the driven parts: its
/// stiffness gives the modulus, and the mass that takes part in the motion the steps of a crossing.
/// These are those of a bar of the same lowest frequency: sqrt(3 m / k) / dt, with the kinetic
/// energy m / 2 and the stored energy k / 2 at a unit velocity and way. Joints that the loading
/// opens carry nothing. The way is that of the plates themselves, also in a soft machine.
///
/// @param strength  stress that the test may reach, roughly [Pa]; 0: twice that at which the first
///                  contact point leaves its elastic branch. The failure strain is then that of the
///                  specimen's whole extent along the loading, in compression; of parts that turn
///                  it is an angle of that size
/// @throws std::invalid_argument  if the parts leave the whole specimen free to move
/// @throws std::runtime_error     if they leave a piece of it free
TestScales part_scales(const Assembly& a, const PartGeometry& parts, double strength, double dt);

}  // namespace flexpm
