// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/pairs/grain_bodies.hpp>

#include <flexpm/kernel/pairs/body_corners.hpp>
#include <flexpm/kernel/space/overlap.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <array>
#include <map>

namespace flexpm {

namespace {

using Triangle = std::array<int, 3>;

/// A face on its way into the list.
struct Face {
    int contact;
    std::vector<int> corners;
};

/// Corners around the triangles of one face: edges that no other of the triangles has.
std::vector<int> rim_of(const std::vector<Triangle>& triangles)
{
    std::map<int, int> next;
    const auto has = [&](int from, int to) {
        return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
            return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to)
                || (t[2] == from && t[0] == to);
        });
    };
    for (const Triangle& t : triangles)
        for (int k = 0; k < 3; ++k)
            if (!has(t[(k + 1) % 3], t[k])) next[t[k]] = t[(k + 1) % 3];
    std::vector<int> rim { next.begin()->first };
    for (int at = next.begin()->second; at != rim.front() && rim.size() < next.size();
         at = next[at])
        rim.push_back(at);
    return rim;
}

/// Whether two triangles have an edge in common.
bool are_joined(const Triangle& a, const Triangle& b)
{
    int common = 0;
    for (int node : a)
        common += static_cast<int>(std::count(b.begin(), b.end(), node));
    return common == 2;
}

Vector normal_of(const SolidState& s, const Triangle& t)
{
    const auto at = [&](int k) { return space_vector(s.grains.reference, t[k]); };
    const Vector twice = cross(at(1) - at(0), at(2) - at(0));
    return (1.0 / norm(twice)) * twice;
}

/// Triangles of the surface, which come face by face, as faces.
void add_surface(const SolidState& s, std::vector<std::vector<Face>>& of_grain)
{
    constexpr double flat = 1e-9;  // sine of the angle between triangles of one plane
    const SurfaceTriangles& surface = s.surface;
    std::vector<Triangle> face;
    const auto finish = [&](std::size_t last) {
        if (!face.empty()) of_grain[surface.grain[last]].push_back({ -1, rim_of(face) });
        face.clear();
    };
    for (std::size_t t = 0; t < surface.grain.size(); ++t) {
        const Triangle& own = surface.nodes[t];
        const bool goes_on = !face.empty() && surface.grain[t] == surface.grain[t - 1]
            && std::any_of(face.begin(), face.end(), [&](const Triangle& of) {
                   return are_joined(of, own)
                       && norm(cross(normal_of(s, of), normal_of(s, own))) < flat;
               });
        if (!goes_on && t > 0) finish(t - 1);
        face.push_back(own);
    }
    if (!surface.grain.empty()) finish(surface.grain.size() - 1);
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
            Face face { contact, {} };
            for (int k = 0; k < c.corners_of(contact); ++k)
                face.corners.push_back(c.node(contact, side, k));
            // corners are counter-clockwise as seen from the second grain
            if (side == 1) std::reverse(face.corners.begin(), face.corners.end());
            of_grain[c.pairs[contact][side]].push_back(face);
        }
    }
    add_surface(s, of_grain);
    BodyFaces faces { { 0 }, {}, { 0 }, {} };
    for (const std::vector<Face>& list : of_grain) {
        for (const Face& face : list) {
            faces.contact.push_back(face.contact);
            faces.corners.insert(faces.corners.end(), face.corners.begin(), face.corners.end());
            faces.first_corner.push_back(static_cast<int>(faces.corners.size()));
        }
        faces.first.push_back(static_cast<int>(faces.contact.size()));
    }
    return faces;
}

bool is_free(const SolidState& s, const BodyFaces& faces, int face)
{
    const int contact = faces.contact[face];
    return contact < 0 || s.contacts.has_ended(contact);
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
