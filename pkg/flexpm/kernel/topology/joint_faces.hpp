// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Faces of joints that slide: which part of a face lies opposite to which now. SI units.
///
/// The cut of a joint gives each grain beside it edges that are faces of the joint. A contact
/// begins between the two faces that came from one edge. As the sides slide, contacts that have
/// cracked get the parts of faces that lie opposite to each other now, with their area, and take
/// over tractions and slip from those that were there.
/// Deviation D54: the opening is that between the faces as they lie; what this changes in stored
/// energy is friction.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// A contact between parts of two faces, as it has to be.
struct FaceContact {
    static constexpr int none = -1;
    int contact = none;  ///< between the same faces, which it replaces; or none
    GrainPair pair {};
    int joint = none;
    int law = 0;
    std::array<int, 2> edges[2] {};  ///< nodes of the face of each grain, in one direction
    double inverse_edge_length[2] = { 0.0, 0.0 };  ///< along the tangent [1/m]
    Point normal;                                  ///< from the first grain to the second

    struct Place {
        double weight[2] = { 0.0, 0.0 };  ///< share of each face's second node [-]
        double area = 0.0;                ///< [m^2]
        PointState state;
        double crack_slip = 0.0;  ///< [m]
    };
    std::vector<Place> points;
};

/// What has to change on the joints of an assembly.
struct FacePairing {
    std::vector<FaceContact> contacts;  ///< all on the joints that change, ascending by pair
    std::vector<int> ended;             ///< contacts whose faces no longer lie opposite, ascending

    bool empty() const { return contacts.empty() && ended.empty(); }
};

/// Pairs of all faces on the joints where an end of a contact has come to lie elsewhere by more
/// than a small part of a face. Faces of contacts that have not cracked keep their partners.
FacePairing pair_faces(const Assembly& a);

}  // namespace flexpm
