// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>

namespace flexpm {

std::vector<Vector> middle_face(const SolidState& s, int contact, double factor)
{
    std::vector<Vector> middle;
    for (int k = 0; k < s.contacts.corners_of(contact); ++k)
        middle.push_back(0.5
            * (s.grains.position(s.contacts.node(contact, 0, k), factor)
                + s.grains.position(s.contacts.node(contact, 1, k), factor)));
    return middle;
}

Vector normal_of(const std::vector<Vector>& corners)
{
    Vector twice;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        twice = twice + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    const double size = norm(twice);
    return size > 0.0 ? (1.0 / size) * twice : Vector {};
}

Vector contact_normal(const SolidState& s, int contact)
{
    return normal_of(middle_face(s, contact));
}

FaceFrame contact_frame(const SolidState& s, int contact)
{
    return face_frame(middle_face(s, contact), { 0, s.contacts.line[s.contacts.slot[contact]] });
}

Vector point_place(
    const FaceContacts& contacts, int contact, int point, const std::vector<Vector>& middle)
{
    Vector at;
    for (std::size_t k = 0; k < middle.size(); ++k)
        at = at + contacts.share(contact, point, static_cast<int>(k)) * middle[k];
    return at;
}

Vector contact_middle(const SolidState& s, int contact)
{
    const std::vector<Vector> middle = middle_face(s, contact);
    Vector sum;
    for (int p = 0; p < s.contacts.points_of(contact); ++p)
        sum = sum + s.contacts.area(contact, p) * point_place(s.contacts, contact, p, middle);
    return (1.0 / contact_area(s.contacts, contact)) * sum;
}

Vector area_vector(const SolidState& s, int triangle)
{
    std::array<Vector, 3> r;
    for (int k = 0; k < 3; ++k)
        r[k] = space_vector(s.grains.reference, s.surface.nodes[triangle][k]);
    return 0.5 * cross(r[1] - r[0], r[2] - r[0]);
}

std::vector<FacePlace> places_of(const SolidState& s, int contact)
{
    const FaceContacts& c = s.contacts;
    std::vector<FacePlace> places(c.points_of(contact));
    const std::vector<Vector> middle = middle_face(s, contact);
    if (!(norm(normal_of(middle)) > 0.0)) return places;
    const FaceFrame frame = face_frame(middle, { 0, c.line[c.slot[contact]] });
    std::vector<Vector> apart;
    for (int k = 0; k < c.corners_of(contact); ++k)
        apart.push_back(space_vector(s.grains.displacement, c.node(contact, 1, k))
            - space_vector(s.grains.displacement, c.node(contact, 0, k)));
    for (std::size_t p = 0; p < places.size(); ++p) {
        const Vector jump = point_place(c, contact, static_cast<int>(p), apart);
        places[p] = { dot(jump, frame.normal),
            { dot(jump, frame.first), dot(jump, frame.second) } };
    }
    return places;
}

bool is_cracked_through(const FaceContacts& c, int contact)
{
    const int block = c.block_of(contact);
    if (c.states[block].empty() && c.cracks[block].empty()) return false;
    const LawParameters& law = c.law_of(contact);
    for (int p = 0; p < c.points_of(contact); ++p) {
        if (!(c.area(contact, p) > 0.0) || c.crack(contact, p).mode != intact) continue;
        const FacePointState state = c.point_state(contact, p);
        if (law::damage(law, state.max_opening, state.shear_damage) < 1.0) return false;
    }
    return true;
}

std::vector<GrainPair> mated_pairs(const SolidState& s)
{
    std::vector<GrainPair> pairs;
    for (int c = 0; c < s.contacts.count; ++c)
        if (!s.contacts.has_ended(c)) pairs.push_back(s.contacts.pairs[c]);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

int pair_number(const SolidState& s, const GrainPair& grains)
{
    const auto pair = std::lower_bound(s.pairs.begin(), s.pairs.end(), grains,
        [](const PairContact& p, const GrainPair& g) { return p.grains < g; });
    if (pair == s.pairs.end() || pair->grains != grains) return -1;
    return static_cast<int>(pair - s.pairs.begin());
}

FaceTraction traction_of(const FaceContacts& contacts, int contact, int point, FacePlace place)
{
    if (contacts.has_ended(contact)) return { 0.0, {}, 1.0, 1.0 };
    return traction_at(contacts.law_of(contact), place, contacts.point_state(contact, point));
}

FaceTraction traction_of(const SolidState& s, int contact, int point)
{
    return traction_of(s.contacts, contact, point, places_of(s, contact)[point]);
}

double mean_opening(const SolidState& s, int contact)
{
    const std::vector<FacePlace> places = places_of(s, contact);
    double sum = 0.0;
    for (std::size_t p = 0; p < places.size(); ++p)
        sum += s.contacts.area(contact, static_cast<int>(p)) * places[p].opening;
    return sum / contact_area(s.contacts, contact);
}

std::vector<Vector> point_forces(const SolidState& s, int contact)
{
    std::vector<Vector> forces(s.contacts.points_of(contact));
    if (s.contacts.has_ended(contact)) return forces;
    if (!(norm(contact_normal(s, contact)) > 0.0)) return forces;
    const FaceFrame frame = contact_frame(s, contact);
    const std::vector<FacePlace> places = places_of(s, contact);
    for (std::size_t p = 0; p < forces.size(); ++p) {
        const int point = static_cast<int>(p);
        const FaceTraction t = traction_of(s.contacts, contact, point, places[p]);
        // in tension the second grain is pulled back to the first
        forces[p] = -s.contacts.area(contact, point)
            * (t.normal * frame.normal + t.shear.x * frame.first + t.shear.y * frame.second);
    }
    return forces;
}

Vector contact_force(const SolidState& s, int contact)
{
    Vector sum;
    for (const Vector& force : point_forces(s, contact))
        sum = sum + force;
    return sum;
}

Vector node_velocity(const SolidState& s, int grain, int node)
{
    if (s.bodies.empty()) return space_vector(s.grains.velocity, node);
    const int centre = s.grains.centre(grain);
    return space_vector(s.grains.velocity, centre)
        + cross(s.bodies[grain].spin, s.grains.position(node) - s.grains.position(centre));
}

}  // namespace flexpm
