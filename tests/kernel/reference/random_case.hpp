// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Random assemblies and random loading that follow from a seed.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/random.hpp>

#include <cstdint>
#include <string>

namespace plain {

/// A specimen under way: outline, sizes, model, mesh, points, minerals, laws, masses, boundary and
/// loading are drawn.
struct RandomCase {
    explicit RandomCase(std::uint64_t seed);

    /// Change the loading as it goes: now and then new velocities of all grains, which open, close,
    /// shear and turn their contacts by anything between a part of the elastic way and more than
    /// the critical one.
    void load();

    /// Whether a grain has left the specimen far behind: loads are drawn beyond what the elements
    /// stand.
    bool has_diverged() const;

    std::string name;  ///< what was drawn, for messages
    flexpm::Assembly assembly;
    double dt = 1.0;  ///< [s]
    double damping = 0.7;
    int steps = 0;  ///< to take

private:
    void draw_motion();

    flexpm::Random random;
    bool touches = false;  ///< contacts come and go
    int next_motion = 0;   ///< step of the next change of velocities
};

}  // namespace plain
