// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains as convex bodies for their contact with others: their faces, and where these lie. SI
/// units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Faces of all grains. Contacts and triangles of the surface that go on from each other in one plane
/// are one face.
BodyFaces faces_of(const SolidState& s);

/// Whether a face can be pressed: a part of it is on the surface, or one of its contacts has ended.
/// Other faces lie on those of neighbours, and only bound the body.
bool is_free(const SolidState& s, const BodyFaces& faces, int face);

/// Body of a grain where the grain is now.
GrainBody body_of(const SolidState& s, const BodyFaces& faces, int grain);

/// Move a body to where its grain is now.
void follow_grain(const SolidState& s, const BodyFaces& faces, GrainBody& body);

/// Position of a node now, of rigid grains by their motion [m].
Vector present_position(const SolidState& s, int grain, int node);

}  // namespace flexpm
