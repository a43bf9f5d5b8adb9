// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The frame of a polygon and the derivatives of its turn.
#include <flexpm/kernel/space/face_frame.hpp>

namespace flexpm {

std::array<int, 2> farthest_corners(const std::vector<Vector>& corners)
{
    std::array<int, 2> farthest { 0, 1 };
    double largest = -1.0;
    const int n = static_cast<int>(corners.size());
    for (int i = 0; i < n; ++i) {
        for (int k = i + 1; k < n; ++k) {
            const Vector apart = corners[k] - corners[i];
            if (dot(apart, apart) > largest) {
                largest = dot(apart, apart);
                farthest = { i, k };
            }
        }
    }
    return farthest;
}

FaceFrame face_frame(const std::vector<Vector>& middle, std::array<int, 2> line)
{
    Vector twice;
    for (std::size_t k = 1; k + 1 < middle.size(); ++k)
        twice = twice + cross(middle[k] - middle[0], middle[k + 1] - middle[0]);
    FaceFrame frame {};
    frame.area = 0.5 * norm(twice);
    check_positive("face_frame: area between two faces", frame.area, "m^2");
    frame.normal = (0.5 / frame.area) * twice;
    const Vector along = middle[line[1]] - middle[line[0]];
    frame.lean = dot(along, frame.normal);
    const Vector flat = along - frame.lean * frame.normal;
    frame.span = norm(flat);
    check_positive("face_frame: longest line of a face", frame.span, "m");
    frame.first = (1.0 / frame.span) * flat;
    frame.second = cross(frame.normal, frame.first);
    return frame;
}

std::vector<Vector> couple_forces(const FaceFrame& frame, const std::vector<Vector>& middle,
    std::array<int, 2> line, Vector couple)
{
    // The frame turns by n x dn, where dn follows from the change of the area vector, and by
    // second . d(first) about n; the work of the couple on both is linear in the ways of corners.
    const double about = dot(couple, frame.normal) / frame.span;
    const Vector tilting =
        (1.0 / frame.area) * (cross(couple, frame.normal) - (about * frame.lean) * frame.second);
    const std::size_t n = middle.size();
    std::vector<Vector> forces(n);
    for (std::size_t k = 0; k < n; ++k)
        forces[k] = -0.5 * cross(middle[(k + 1) % n] - middle[(k + n - 1) % n], tilting);
    forces[line[0]] = forces[line[0]] + about * frame.second;
    forces[line[1]] = forces[line[1]] - about * frame.second;
    return forces;
}

}  // namespace flexpm
