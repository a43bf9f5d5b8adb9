// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/joint_faces.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/fem/edge_points.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace flexpm {

namespace {

constexpr double small_part = 0.05;     // of a face: a contact that has moved by less stays
constexpr double smallest_part = 1e-3;  // of a face: what overlaps by less does not touch
constexpr double largest_gap = 0.5;     // of the mean radius of two grains whose faces may touch
constexpr double facing_cosine = 0.5;   // of the angle between two faces that may touch

/// Nodes of an edge.
using Edge = std::array<int, 2>;

/// An edge of a grain on a joint, the grain to its left.
struct Face {
    int grain;
    Edge nodes;
    int law;
};

/// A part of an edge, from one share of its second node to another.
struct Part {
    double from, to;

    double at(double share) const { return from + share * (to - from); }
    double length() const { return to - from; }
};

bool is_cracked_through(const Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p)
        if (damage_of(contacts, contact, p) < 1.0) return false;
    return true;
}

/// The part of an edge on which a contact acts.
Part part_of(const Assembly& a, int contact, int side)
{
    const auto [from, to] = acting_part(a, contact, side);
    return { from, to };
}

/// A joint that may have to change.
struct Joint {
    std::vector<Face> faces;    ///< of contacts that have cracked
    std::vector<int> contacts;  ///< that act between these
};

/// Whether a contact acts where it does no more, or a part of its joint has no partner.
bool has_moved(const Contacts& contacts, int contact)
{
    if (!is_active(contacts, contact)) return true;
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const double way = apart_along(contacts, contact, p);
        for (int side = 0; side < 2; ++side) {
            const double part = way * contacts.inverse_edge_length(contact, side);
            if (std::fabs(part) > small_part) return true;
        }
    }
    return false;
}

/// The face of one grain of a bond, which began as the edge of both.
Face face_of(const Contacts& contacts, int bond, int side)
{
    const auto [from, to] = contacts.edge(bond, side);
    const Edge grain_to_the_left = side == 0 ? Edge { from, to } : Edge { to, from };
    return { contacts.pairs[bond][side], grain_to_the_left, contacts.law[bond] };
}

/// Faces that are nowhere have no order along a joint; the next check reports them.
bool is_somewhere(const Grains& grains, const Face& face)
{
    return is_finite(grains.point_at(face.nodes[0])) && is_finite(grains.point_at(face.nodes[1]));
}

/// The joints on which a contact that has cracked has moved.
std::map<int, Joint> joints_that_slide(const Assembly& a)
{
    const Contacts& contacts = a.contacts;
    std::set<int> sliding;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.joint[c] < 0 || contacts.erased[c] || sliding.count(contacts.joint[c]))
            continue;
        if (is_cracked_through(contacts, c) && has_moved(contacts, c))
            sliding.insert(contacts.joint[c]);
    }
    std::map<int, Joint> joints;
    for (int c = 0; c < contacts.count && !sliding.empty(); ++c) {
        if (contacts.erased[c] || sliding.count(contacts.joint[c]) == 0) continue;
        if (!is_cracked_through(contacts, c)) continue;
        Joint& joint = joints[contacts.joint[c]];
        if (is_active(contacts, c)) joint.contacts.push_back(c);
        if (!contacts.bonded[c]) continue;
        for (int side = 0; side < 2; ++side) {
            const Face face = face_of(contacts, c, side);
            if (is_somewhere(a.grains, face)) joint.faces.push_back(face);
        }
    }
    return joints;
}

/// Two faces that lie opposite to each other, in the direction of the first.
struct Overlap {
    const Face* first;
    const Face* second;
    Part on[2];
};

/// Present places of the ends of an edge.
struct Line {
    Point start, along;

    Line(const Grains& grains, Edge nodes) :
        start(grains.point_at(nodes[0])),
        along(grains.point_at(nodes[1]) - start)
    {
    }
    Point at(double share) const { return start + share * along; }
    double share_of(Point p) const { return dot(p - start, along) / dot(along, along); }
};

Edge reversed(Edge nodes) { return { nodes[1], nodes[0] }; }

/// Unit normal across the mean of two edges, to the right of them.
Point normal_across(const Line& a, const Line& b)
{
    const Point along = a.along + b.along;
    const double length = norm(along);
    return { along.y / length, -along.x / length };
}

/// Whether two faces lie opposite to each other, and the parts that do: the ends of the second are
/// projected onto the first.
bool find_overlap(const Grains& grains, const Face& f, const Face& g, Overlap& overlap)
{
    const Line a(grains, f.nodes), b(grains, reversed(g.nodes));
    if (dot(a.along, b.along) < facing_cosine * norm(a.along) * norm(b.along)) return false;
    const Part whole { a.share_of(b.start), a.share_of(b.at(1.0)) };
    const Part on_first { std::max(whole.from, 0.0), std::min(whole.to, 1.0) };
    if (on_first.length() < smallest_part) return false;
    const auto on_second = [&](double share) { return (share - whole.from) / whole.length(); };
    overlap = { &f, &g, { on_first, { on_second(on_first.from), on_second(on_first.to) } } };
    const Point apart = b.at(overlap.on[1].at(0.5)) - a.at(on_first.at(0.5));
    const double radius = 0.5 * (grains.radius[f.grain] + grains.radius[g.grain]);
    return std::fabs(dot(apart, normal_across(a, b))) < largest_gap * radius;
}

/// Extent of a face along an axis.
std::pair<double, double> extent(const Grains& grains, const Face& face, int axis)
{
    const Point p = grains.point_at(face.nodes[0]), q = grains.point_at(face.nodes[1]);
    return axis == 0 ? std::minmax(p.x, q.x) : std::minmax(p.y, q.y);
}

/// The axis along which faces spread more.
int longer_axis(const Grains& grains, const std::vector<Face>& faces)
{
    double length[2];
    for (int axis = 0; axis < 2; ++axis) {
        double least = extent(grains, faces[0], axis).first, most = least;
        for (const Face& face : faces) {
            const auto [from, to] = extent(grains, face, axis);
            least = std::min(least, from);
            most = std::max(most, to);
        }
        length[axis] = most - least;
    }
    return length[0] >= length[1] ? 0 : 1;
}

/// All pairs of faces of a joint that lie opposite to each other, ascending by their grains.
std::vector<Overlap> find_overlaps(const Grains& grains, std::vector<Face>& faces)
{
    if (faces.empty()) return {};
    const int axis = longer_axis(grains, faces);
    std::stable_sort(faces.begin(), faces.end(), [&](const Face& f, const Face& g) {
        return extent(grains, f, axis).first < extent(grains, g, axis).first;
    });
    double margin = 0.0;  // faces that are apart need not overlap along the axis
    for (const Face& face : faces)
        margin = std::max(margin, largest_gap * grains.radius[face.grain]);
    std::vector<Overlap> overlaps;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const double end = extent(grains, faces[i], axis).second + margin;
        for (std::size_t j = i + 1; j < faces.size(); ++j) {
            if (extent(grains, faces[j], axis).first > end) break;
            const bool in_order = faces[i].grain < faces[j].grain;
            const Face &f = faces[in_order ? i : j], &g = faces[in_order ? j : i];
            Overlap overlap {};
            if (f.grain != g.grain && find_overlap(grains, f, g, overlap))
                overlaps.push_back(overlap);
        }
    }
    const auto order = [](const Overlap& o) {
        return std::array<int, 4> { o.first->grain, o.second->grain, o.first->nodes[0],
            o.second->nodes[0] };
    };
    std::sort(overlaps.begin(), overlaps.end(),
        [&](const Overlap& o, const Overlap& p) { return order(o) < order(p); });
    return overlaps;
}

/// The contact between two faces, of those on a joint; or none.
int contact_between(const Contacts& contacts, const Joint& joint, const Overlap& o)
{
    const Edge first = o.first->nodes, second = reversed(o.second->nodes);
    for (int c : joint.contacts)
        if (contacts.edge(c, 0) == first && contacts.edge(c, 1) == second) return c;
    return FaceContact::none;
}

/// Whether the ends of a contact lie elsewhere than those of an overlap.
bool is_elsewhere(const Assembly& a, int contact, const Overlap& o)
{
    for (int side = 0; side < 2; ++side) {
        const Part now = part_of(a, contact, side), wanted = o.on[side];
        if (std::fabs(now.from - wanted.from) > small_part) return true;
        if (std::fabs(now.to - wanted.to) > small_part) return true;
    }
    return false;
}

/// What a contact hands over at a place.
struct Handed {
    double shear_traction = 0.0;
    double slip = 0.0;
    double crack_slip = 0.0;
};

/// Traction and slips of a contact at a share of an edge, linear between its points.
Handed value_at(const Contacts& contacts, int contact, int side, double share)
{
    const auto value = [&](int p) {
        return Handed { traction_of_state(contacts, contact, p).shear,
            slip_of(contacts, contact, p), contacts.crack_slip(contact, p) };
    };
    const int last = contacts.points_of(contact) - 1;
    if (last == 0) return value(0);
    int p = 1;
    while (p < last && share > contacts.weight(contact, p, side))
        ++p;
    const double from = contacts.weight(contact, p - 1, side);
    const double part = (share - from) / (contacts.weight(contact, p, side) - from);
    const double t = std::min(std::max(part, 0.0), 1.0);
    const Handed x = value(p - 1), y = value(p);
    return { x.shear_traction + t * (y.shear_traction - x.shear_traction),
        x.slip + t * (y.slip - x.slip), x.crack_slip + t * (y.crack_slip - x.crack_slip) };
}

/// A contact that now acts on a face, and the side of it that does.
struct Acting {
    int contact, side;
};

std::vector<Acting> acting_on(const Contacts& contacts, const Joint& joint, const Face& face)
{
    std::vector<Acting> found;
    for (int c : joint.contacts) {
        if (contacts.edge(c, 0) == face.nodes) found.push_back({ c, 0 });
        if (contacts.edge(c, 1) == reversed(face.nodes)) found.push_back({ c, 1 });
    }
    return found;
}

/// What the one of these contacts hands over that acts nearest to a place of their face; where none
/// acts, the friction is the residual one.
Handed handed_over(
    const Assembly& a, const LawParameters& law, const std::vector<Acting>& acting, double place)
{
    Handed nearest { 0.0, 0.0, law::slip_to_residual(law) };
    double least = -1.0;
    for (const Acting& on : acting) {
        const double share = on.side == 0 ? place : 1.0 - place;  // edges run one way, faces two
        const Part part = part_of(a, on.contact, on.side);
        const double distance = std::max({ part.from - share, share - part.to, 0.0 });
        if (least >= 0.0 && distance >= least) continue;
        least = distance;
        nearest = value_at(a.contacts, on.contact, on.side, share);
    }
    return nearest;
}

/// State of a point between two faces that lie `opening` apart.
PointState state_between(const LawParameters& law, double opening, const Handed& handed)
{
    PointState state;
    state.opening = opening;
    state.shear_traction = handed.shear_traction;
    state.slip = handed.slip;
    state.shear_damage = 1.0;
    state.max_opening = std::max(law::gap(law, state), 0.0);
    return state;
}

/// The contact of an overlap, with what those that act on its faces hand over.
FaceContact contact_of(const Assembly& a, const Joint& joint, int number, const Overlap& o)
{
    FaceContact made;
    made.contact = contact_between(a.contacts, joint, o);
    made.pair = { o.first->grain, o.second->grain };
    made.joint = number;
    made.law = o.first->law;
    made.edges[0] = o.first->nodes;
    made.edges[1] = reversed(o.second->nodes);
    const Line lines[] = { Line(a.grains, made.edges[0]), Line(a.grains, made.edges[1]) };
    made.normal = normal_across(lines[0], lines[1]);
    for (int side = 0; side < 2; ++side)
        made.inverse_edge_length[side] = 1.0 / cross(made.normal, lines[side].along);
    const double area = a.area_of(o.on[0].length())
        * norm(a.grains.reference_at(made.edges[0][1]) - a.grains.reference_at(made.edges[0][0]));
    auto acting = acting_on(a.contacts, joint, *o.first);
    const bool of_first = !acting.empty();
    if (!of_first) acting = acting_on(a.contacts, joint, *o.second);
    const EdgePoints places = edge_points(a.contacts.group.points);
    made.points.resize(a.contacts.group.points);
    for (int p = 0; p < a.contacts.group.points; ++p) {
        FaceContact::Place& point = made.points[p];
        for (int side = 0; side < 2; ++side)
            point.weight[side] = o.on[side].at(places.weight[p]);
        point.area = places.share[p] * area;
        const Point apart = lines[1].at(point.weight[1]) - lines[0].at(point.weight[0]);
        const double place = of_first ? point.weight[0] : 1.0 - point.weight[1];
        const LawParameters& law = a.contacts.laws[made.law];
        const Handed handed = handed_over(a, law, acting, place);
        point.state = state_between(law, dot(apart, made.normal), handed);
        point.crack_slip = handed.crack_slip;
    }
    return made;
}

/// Whether the contacts of a joint act elsewhere than between the faces that now lie opposite to
/// each other.
bool must_change(const Assembly& a, const Joint& joint, const std::vector<Overlap>& overlaps)
{
    std::size_t stay = 0;
    for (const Overlap& o : overlaps) {
        const int contact = contact_between(a.contacts, joint, o);
        if (contact != FaceContact::none) {
            ++stay;
            if (is_elsewhere(a, contact, o)) return true;
        } else if (o.on[0].length() > small_part) {
            return true;
        }
    }
    return stay < joint.contacts.size();
}

/// Contacts of a joint that no overlap keeps.
std::vector<int> ended_on(const Joint& joint, const std::vector<FaceContact>& contacts)
{
    std::set<int> stay;
    for (const FaceContact& c : contacts)
        stay.insert(c.contact);
    std::vector<int> ended;
    std::copy_if(joint.contacts.begin(), joint.contacts.end(), std::back_inserter(ended),
        [&](int c) { return stay.count(c) == 0; });
    return ended;
}

}  // namespace

FacePairing pair_faces(const Assembly& a)
{
    FacePairing pairing;
    for (auto& [number, joint] : joints_that_slide(a)) {
        const auto overlaps = find_overlaps(a.grains, joint.faces);
        if (!must_change(a, joint, overlaps)) continue;
        std::vector<FaceContact> contacts;
        for (const Overlap& o : overlaps)
            contacts.push_back(contact_of(a, joint, number, o));
        for (int c : ended_on(joint, contacts))
            pairing.ended.push_back(c);
        pairing.contacts.insert(pairing.contacts.end(), contacts.begin(), contacts.end());
    }
    std::sort(pairing.ended.begin(), pairing.ended.end());
    std::stable_sort(pairing.contacts.begin(), pairing.contacts.end(),
        [](const FaceContact& c, const FaceContact& d) { return c.pair < d.pair; });
    return pairing;
}

}  // namespace flexpm
