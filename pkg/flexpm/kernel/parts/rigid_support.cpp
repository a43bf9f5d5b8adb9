// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/rigid_support.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Part of the largest stiffness against a motion that is none [-].
constexpr double no_stiffness = 1e-12;
/// Part of the springs' energy that is left where the body follows [-]: round-off. Supports that
/// resist leave at least the ratio of their stiffness to that of what pushes.
constexpr double no_energy = 1e-10;
/// Rotation over translation, as displacements, that is none [-].
constexpr double no_rotation = 1e-6;

}  // namespace

void RigidSupport::add(Vector place, Vector along, double stiffness, double displacement)
{
    add_stretch(along, cross(place - about_, along), stiffness, displacement);
}

void RigidSupport::add_turning(Vector arm, Vector along, double stiffness, double displacement)
{
    add_stretch({}, cross(arm, along), stiffness, displacement);
}

void RigidSupport::add_stretch(
    Vector translation, Vector rotation, double stiffness, double displacement)
{
    const Vector turned = (1.0 / length_) * rotation;
    const double stretch[] = { translation.x, translation.y, translation.z, turned.x, turned.y,
        turned.z, -displacement };
    for (int i = 0; i <= motions; ++i)
        for (int j = 0; j <= motions; ++j)
            form_[i][j] += stiffness * stretch[i] * stretch[j];
}

void RigidSupport::require_resistance() const
{
    constexpr int push = motions;
    auto m = form_;
    double largest = 0.0;
    for (int i = 0; i < motions; ++i)
        largest = std::max(largest, m[i][i]);
    std::array<bool, motions> done {};
    for (int round = 0; round < motions; ++round) {
        int next = -1;
        for (int i = 0; i < motions; ++i)
            if (!done[i] && (next < 0 || m[i][i] > m[next][next])) next = i;
        if (!(m[next][next] > no_stiffness * largest)) break;
        done[next] = true;
        for (int i = 0; i <= push; ++i) {
            if (i == next) continue;
            const double factor = m[i][next] / m[next][next];
            for (int j = 0; j <= push; ++j)
                m[i][j] -= factor * m[next][j];
        }
    }
    if (m[push][push] > no_energy * form_[push][push]) return;

    double follows[motions] = {};
    for (int i = 0; i < motions; ++i)
        if (done[i]) follows[i] = -m[i][push] / m[i][i];
    int axis = 0, about = 3;
    for (int i = 0; i < 3; ++i) {
        if (std::fabs(follows[i]) > std::fabs(follows[axis])) axis = i;
        if (std::fabs(follows[3 + i]) > std::fabs(follows[about])) about = 3 + i;
    }
    const std::string names = "xyz";
    if (std::fabs(follows[about]) > no_rotation * std::fabs(follows[axis])) {
        refuse("resistance of the supports", 0.0, "N",
            std::string("must be > 0: the specimen rotates about ") + names[about - 3]
                + " with the driven parts; give a part friction or a pin, or fix nodes");
    }
    refuse("resistance of the supports", 0.0, "N",
        std::string("must be > 0: the specimen moves along ") + names[axis]
            + " with the driven parts; add a part that resists it, or fix nodes along "
            + names[axis]);
}

}  // namespace flexpm
