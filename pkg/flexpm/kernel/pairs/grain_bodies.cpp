// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/pairs/grain_bodies.hpp>

#include <flexpm/kernel/pairs/body_corners.hpp>
#include <flexpm/kernel/space/overlap.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace flexpm {

namespace {

/// Nodes around a face, counter-clockwise as seen from outside.
using Loop = std::vector<int>;

/// A face on its way into the list: of a contact, of a triangle of the surface, or of several of them
/// that lie in one plane.
struct Face {
    Loop corners;
    std::vector<int> contacts;
    bool outer;  ///< a part of it is on the surface
};

/// Edges of loops that no other of them has, by their first node; empty if they are not one loop.
std::map<int, int> rim_of(const std::vector<const Loop*>& loops)
{
    std::set<std::array<int, 2>> edges;
    for (const Loop* loop : loops)
        for (std::size_t k = 0; k < loop->size(); ++k)
            edges.insert({ (*loop)[k], (*loop)[(k + 1) % loop->size()] });
    std::map<int, int> next;
    for (const auto& [from, to] : edges)
        if (edges.count({ to, from }) == 0 && !next.emplace(from, to).second) return {};
    return next;
}

/// The face that several faces make together; without corners if their rim is not one loop.
Face joined(const std::vector<Face>& faces, const std::vector<int>& members)
{
    Face whole { {}, {}, false };
    std::vector<const Loop*> loops;
    for (int i : members) {
        loops.push_back(&faces[i].corners);
        whole.contacts.insert(
            whole.contacts.end(), faces[i].contacts.begin(), faces[i].contacts.end());
        whole.outer |= faces[i].outer;
    }
    const std::map<int, int> next = rim_of(loops);
    if (next.empty()) return whole;
    int at = next.begin()->first;
    do {
        whole.corners.push_back(at);
        at = next.at(at);
    } while (at != whole.corners.front() && whole.corners.size() < next.size());
    if (whole.corners.size() < next.size() || at != whole.corners.front()) whole.corners.clear();
    return whole;
}

Vector normal_of(const SolidState& s, const Loop& corners)
{
    const Vector origin = space_vector(s.grains.reference, corners[0]);
    Vector twice;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        twice = twice
            + cross(space_vector(s.grains.reference, corners[k]) - origin,
                space_vector(s.grains.reference, corners[k + 1]) - origin);
    return (1.0 / norm(twice)) * twice;
}

/// Whether two loops have an edge in common.
bool are_neighbours(const Loop& a, const Loop& b)
{
    const auto has = [&](int from, int to) {
        for (std::size_t k = 0; k < b.size(); ++k)
            if (b[k] == from && b[(k + 1) % b.size()] == to) return true;
        return false;
    };
    for (std::size_t k = 0; k < a.size(); ++k)
        if (has(a[(k + 1) % a.size()], a[k])) return true;
    return false;
}

/// Make one face of those of a grain that go on from each other in one plane, as the triangles of the
/// surface do and the contacts on a joint: their planes would differ by round-off or by a little
/// deformation, which decides nothing then.
std::vector<Face> merged(const SolidState& s, std::vector<Face> faces)
{
    constexpr double flat = 1e-6;  // sine of the angle between faces of one plane
    const auto count = static_cast<int>(faces.size());
    std::vector<Vector> normals;
    for (const Face& face : faces)
        normals.push_back(normal_of(s, face.corners));
    std::vector<Face> result;
    std::vector<bool> done(count, false);
    for (int first = 0; first < count; ++first) {
        if (done[first]) continue;
        std::vector<int> members { first };
        done[first] = true;
        for (std::size_t k = 0; k < members.size(); ++k) {
            const int i = members[k];
            for (int j = first + 1; j < count; ++j) {
                if (done[j] || dot(normals[i], normals[j]) < 0.0
                    || norm(cross(normals[i], normals[j])) > flat
                    || !are_neighbours(faces[i].corners, faces[j].corners))
                    continue;
                members.push_back(j);
                done[j] = true;
            }
        }
        Face whole = members.size() > 1 ? joined(faces, members) : Face { {}, {}, false };
        if (!whole.corners.empty())
            result.push_back(std::move(whole));
        else
            for (int i : members)
                result.push_back(faces[i]);
    }
    return result;
}

/// Corners of a face now, from a centre.
void corners_of(const SolidState& s, const BodyFaces& faces, int face, int grain, Vector centre,
    std::vector<Vector>& corners)
{
    corners.clear();
    for (int k = faces.first_corner[face]; k < faces.first_corner[face + 1]; ++k)
        corners.push_back(present_position(s, grain, faces.corners[k]) - centre);
}

/// Planes of the faces of a deformable grain.
void find_planes(const SolidState& s, const BodyFaces& faces, GrainBody& body)
{
    thread_local std::vector<Vector> corners;
    const int first = faces.first[body.grain], end = faces.first[body.grain + 1];
    for (int f = first; f < end; ++f) {
        corners_of(s, faces, f, body.grain, body.centre, corners);
        body.planes[f - first] =
            InSpace::plane_of(corners.data(), static_cast<int>(corners.size()));
        body.planes[f - first].counted = is_free(s, faces, f);
    }
}

}  // namespace

BodyFaces faces_of(const SolidState& s)
{
    const FaceContacts& c = s.contacts;
    std::vector<std::vector<Face>> of_grain(s.grains.count);
    for (int contact = 0; contact < c.count; ++contact) {
        for (int side = 0; side < 2; ++side) {
            Loop corners;
            for (int k = 0; k < c.corners_of(contact); ++k)
                corners.push_back(c.node(contact, side, k));
            // corners are counter-clockwise as seen from the second grain
            if (side == 1) std::reverse(corners.begin(), corners.end());
            of_grain[c.pairs[contact][side]].push_back({ corners, { contact }, false });
        }
    }
    for (std::size_t t = 0; t < s.surface.grain.size(); ++t) {
        const auto& nodes = s.surface.nodes[t];
        of_grain[s.surface.grain[t]].push_back({ { nodes.begin(), nodes.end() }, {}, true });
    }
    BodyFaces faces;
    faces.first = faces.first_contact = faces.first_corner = { 0 };
    for (std::vector<Face>& list : of_grain) {
        for (const Face& face : merged(s, std::move(list))) {
            faces.outer.push_back(face.outer);
            faces.contacts.insert(faces.contacts.end(), face.contacts.begin(), face.contacts.end());
            faces.first_contact.push_back(static_cast<int>(faces.contacts.size()));
            faces.corners.insert(faces.corners.end(), face.corners.begin(), face.corners.end());
            faces.first_corner.push_back(static_cast<int>(faces.corners.size()));
        }
        faces.first.push_back(static_cast<int>(faces.outer.size()));
    }
    return faces;
}

bool is_free(const SolidState& s, const BodyFaces& faces, int face)
{
    const int first = faces.first_contact[face], end = faces.first_contact[face + 1];
    return faces.outer[face]
        || std::any_of(faces.contacts.begin() + first, faces.contacts.begin() + end,
            [&](int contact) { return s.contacts.has_ended(contact); });
}

GrainBody body_of(const SolidState& s, const BodyFaces& faces, int grain)
{
    GrainBody body;
    body.grain = grain;
    if (s.grains.is_rigid(grain)) {
        const Vector centre = space_vector(s.grains.reference, s.grains.centre(grain));
        std::vector<Vector> corners;
        for (int f = faces.first[grain]; f < faces.first[grain + 1]; ++f) {
            corners.clear();
            for (int k = faces.first_corner[f]; k < faces.first_corner[f + 1]; ++k)
                corners.push_back(space_vector(s.grains.reference, faces.corners[k]) - centre);
            body.planes.push_back(
                InSpace::plane_of(corners.data(), static_cast<int>(corners.size())));
        }
        SpaceOverlap().find_corners(
            body.planes.data(), static_cast<int>(body.planes.size()), body.bonded_corners);
        body.bonded_planes = body.planes;
    }
    follow_grain(s, faces, body);
    return body;
}

void follow_grain(const SolidState& s, const BodyFaces& faces, GrainBody& body)
{
    const int grain = body.grain, first = faces.first[grain], end = faces.first[grain + 1];
    const int centre = s.grains.centre(grain);
    body.centre = s.grains.position(centre);
    body.planes.resize(end - first);
    if (s.grains.is_rigid(grain)) {
        const Quaternion& turn = s.bodies[grain].turn;
        for (int f = first; f < end; ++f) {
            const ContactPlane& bonded = body.bonded_planes[f - first];
            body.planes[f - first] = { turned(turn, bonded.normal), bonded.offset,
                is_free(s, faces, f) };
        }
        body.corners.clear();
        for (const Vector corner : body.bonded_corners)
            body.corners.push_back(turned(turn, corner));
        return;
    }
    find_planes(s, faces, body);
    if (body.corner_planes.empty()) body.corner_planes = corners_behind(body.planes);
    place_corners(body.planes, body.corner_planes, body.corners);
}

Vector present_position(const SolidState& s, int grain, int node)
{
    if (!s.grains.is_rigid(grain)) return s.grains.position(node);
    const int centre = s.grains.centre(grain);
    const Vector arm =
        space_vector(s.grains.reference, node) - space_vector(s.grains.reference, centre);
    return s.grains.position(centre) + turned(s.bodies[grain].turn, arm);
}

}  // namespace flexpm
