// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/solid_field.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/soft_plate.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>
#include <flexpm/kernel/statics/floating_sets.hpp>
#include <flexpm/kernel/statics/linear_solid.hpp>

#include <algorithm>
#include <utility>

namespace flexpm {

namespace {

/// How a field is found.
struct Solving {
    int threads = 1;
    bool rises = false;  ///< the ends are driven: z from the bottom is given where nodes are held
                         ///< along it, and where the solution begins
    double low = 0.0;    ///< where the bottom is, of ends that are [m]
};

/// Numbers of a grain's nodes follow those of the grain before.
class NodeNumbers {
public:
    explicit NodeNumbers(const SolidState& s) : grains_(s.grains)
    {
        for (int g = 0; g < grains_.count; ++g)
            first_.push_back(first_.back() + grains_.nodes_of(g));
    }
    int of(int grain, int node) const
    {
        const int first = grains_.block_nodes[grains_.block_of(grain)];
        return first_[grain] + (node - first) / grains_.layout.node_stride;
    }
    /// First nodes of the grains, and the number of nodes.
    const std::vector<int>& first() const { return first_; }

private:
    const Grains& grains_;
    std::vector<int> first_ { 0 };
};

void add_elements(const SolidState& s, const NodeNumbers& numbers, LinearSolid& solid)
{
    if (!s.bodies.empty()) return;  // rigid grains need no modulus
    for (const ElasticMaterial& m : s.grains.elastic)
        solid.kinds.push_back(solid_stiffness(m));
    solid.elements.reserve(static_cast<std::size_t>(s.tetrahedra.batches()) * lanes);
    for (int g = 0; g < s.grains.count; ++g) {
        if (s.grains.is_rigid(g)) continue;
        for_each_tetrahedron(
            s, s.grains.block_of(g), [&](const TetrahedronShape& t, std::array<int, 4> nodes) {
                for (int& n : nodes)
                    n = numbers.of(g, n);
                solid.elements.push_back({ nodes, t, s.grains.material[g] });
            });
    }
}

void add_faces(const SolidState& s, const NodeNumbers& numbers, LinearSolid& solid)
{
    const FaceContacts& c = s.contacts;
    solid.faces.reserve(c.count);
    for (int contact = 0; contact < c.count; ++contact) {
        LinearSolid::Face face;
        face.normal = bonded_frame(s, contact).normal;
        face.normal_stiffness = c.law_of(contact).normal_stiffness;
        face.shear_stiffness = c.law_of(contact).shear_stiffness;
        const int corners = c.corners_of(contact);
        face.springs.reserve(c.points_of(contact));
        for (int side = 0; side < 2; ++side) {
            face.nodes[side].reserve(corners);
            for (int k = 0; k < corners; ++k)
                face.nodes[side].push_back(
                    numbers.of(c.pairs[contact][side], c.node(contact, side, k)));
        }
        for (int p = 0; p < c.points_of(contact); ++p) {
            std::vector<double> shares;
            shares.reserve(corners);
            for (int k = 0; k < corners; ++k)
                shares.push_back(c.share(contact, p, k));
            face.springs.push_back(spring_at(c.area(contact, p), std::move(shares)));
        }
        solid.faces.push_back(std::move(face));
    }
}

void add_presses(const SolidState& s, const NodeNumbers& numbers, LinearSolid& solid)
{
    for (int number = 0; number < static_cast<int>(s.plates.size()); ++number) {
        const Plate& plate = s.plates[number];
        for (int i = 0; i < plate_points(plate); ++i) {
            const int triangle = plate.points[i].facet, grain = s.surface.grain[triangle];
            std::array<int, 3> nodes = s.surface.nodes[triangle];
            for (int& n : nodes)
                n = numbers.of(grain, n);
            const bool touches = plate.bonded || plate.points[i].opening <= 0.0;
            const std::array<double, 3> shares = { corner_share(plate, i, 0),
                corner_share(plate, i, 1), corner_share(plate, i, 2) };
            solid.presses.push_back(
                { number, touches, nodes, shares, point_normal(plate, i), point_stiffness(plate, i),
                    sliding_stiffness(plate, i), opens(plate, i, plate.loaded ? 1.0 : 0.0) });
        }
    }
}

bool is_driven(const LinearSolid::Press& p, const SolidDrive& drive)
{
    return std::find(drive.plates.begin(), drive.plates.end(), p.plate) != drive.plates.end();
}

/// @throws std::invalid_argument  for a load on a plate that does not float, or touches nothing
void check_loads(const LinearSolid& solid, const SolidDrive& drive)
{
    for (const PlateLoad& load : drive.loads) {
        const bool bears = std::any_of(solid.presses.begin(), solid.presses.end(),
            [&](const LinearSolid::Press& p) { return p.plate == load.plate && p.opens.x != 0.0; });
        if (!bears)
            refuse("plate under a load", load.plate, "",
                "must touch grains, be free to move, and not be driven");
    }
}

/// Forces of an intact specimen that plates which do not touch it have no part in. No load moves
/// those that are driven.
LinearSolid touched_solid(const SolidState& s, const SolidDrive& drive, int threads)
{
    LinearSolid solid = linear_solid(s, threads);
    for (LinearSolid::Press& p : solid.presses)
        if (is_driven(p, drive)) p.opens.x = 0.0;
    auto& presses = solid.presses;
    presses.erase(std::remove_if(presses.begin(), presses.end(),
                      [](const LinearSolid::Press& p) { return !p.touches; }),
        presses.end());
    check_loads(solid, drive);
    return solid;
}

/// Way along a contact's normal on which its plate is driven [m].
double driven_way(const LinearSolid::Press& p, const SolidDrive& drive)
{
    return is_driven(p, drive) ? dot(p.normal, drive.length * drive.direction) : 0.0;
}

/// The same along its face, which grains that friction holds follow [m].
Vector driven_slide(const LinearSolid::Press& p, const SolidDrive& drive)
{
    if (!is_driven(p, drive) || p.sliding == 0.0) return {};
    return drive.length * drive.direction - driven_way(p, drive) * p.normal;
}

/// Motions of what is free of plates under the loading, by where the nodes are.
std::vector<Vector> motions_of(const LinearSolid& solid, const SolidDrive& drive, const double* u)
{
    std::vector<Vector> motions =
        solid.following(u, [&](const LinearSolid::Press& p) { return driven_way(p, drive); });
    for (const PlateLoad& load : drive.loads) {
        const PlateStiffness stiffness = solid.plate_stiffness()[load.plate];
        motions[load.plate] = motions[load.plate] + stiffness.moved_by({ -load.force, 0.0, 0.0 });
    }
    return motions;
}

/// How far a plate goes along the normal of a contact, there [m].
double way_at(const LinearSolid::Press& p, const SolidDrive& drive, Vector motion)
{
    return driven_way(p, drive) - dot(p.opens, motion);
}

/// Forces on nodes that stay when driven plates have gone their way, and of loads.
std::vector<double> push_of(const LinearSolid& solid, const SolidDrive& drive)
{
    std::vector<double> on_nodes(3 * solid.places.size(), 0.0);
    const std::vector<Vector> motions = motions_of(solid, drive, on_nodes.data());
    for (const LinearSolid::Press& p : solid.presses) {
        const double force = p.stiffness * way_at(p, drive, motions[p.plate]);
        const Vector along = p.sliding * driven_slide(p, drive);
        for (int k = 0; k < 3; ++k) {
            add_triple(on_nodes.data(), p.nodes[k], (3.0 * p.shares[k] * (force / 3.0)) * p.normal);
            add_triple(on_nodes.data(), p.nodes[k], p.shares[k] * along);
        }
    }
    return on_nodes;
}

/// Motions of plates, by where the nodes are.
std::vector<PlateMotion> plate_motions(
    const SolidState& s, const LinearSolid& solid, const SolidDrive& drive, const double* u)
{
    std::vector<PlateMotion> found;
    for (const Vector& m : motions_of(solid, drive, u))
        found.push_back({ -m.x, turn_of(s.plates[found.size()], m) });
    return found;
}

/// Load of driven plates along their way, by where the nodes are.
double load_of(const LinearSolid& solid, const SolidDrive& drive, const double* u)
{
    const std::vector<Vector> motions = motions_of(solid, drive, u);
    double sum = 0.0;
    for (const LinearSolid::Press& p : solid.presses) {
        if (!is_driven(p, drive)) continue;
        const Vector way = solid.way_before(p, u), across = dot(p.normal, way) * p.normal;
        const double pressed = way_at(p, drive, motions[p.plate]) - dot(p.normal, way);
        sum += p.stiffness * pressed * dot(p.normal, drive.direction);
        sum += p.sliding * dot(driven_slide(p, drive) - (way - across), drive.direction);
    }
    return sum;
}

/// Ways of what is held: of driven sets that of the loading. Calls give(grain, node, axis, way).
template <class Give> void give_ways(const SolidState& s, const SolidDrive& drive, Give give)
{
    drive.for_each_set([&](int number, double sense) {
        const NodeSet& set = s.node_sets[number];
        const Vector load = sense * drive.length * drive.direction;
        for (std::size_t i = 0; i < set.nodes.size(); ++i) {
            const Vector arm = space_vector(s.grains.reference, set.nodes[i]) - set.laid_pivot();
            const Vector way = drive.turns ? cross(load, arm) : load;
            const double along[] = { way.x, way.y, way.z };
            for (int axis = 0; axis < 3; ++axis)
                if (set.holds(axis)) give(set.grains[i], set.nodes[i], axis, along[axis]);
        }
    });
}

/// Nodes of the sets that float, in the order of these.
/// @param triple_of  triple_of(grain, node): the unknowns of a node
template <class TripleOf>
std::vector<FloatingNodes> floating_nodes(const SolidState& s, TripleOf triple_of)
{
    std::vector<FloatingNodes> found;
    for (const NodeSet& set : s.node_sets) {
        if (!set.floats) continue;
        found.push_back({ {}, { set.holds_x, set.holds_y, set.holds_z } });
        for (std::size_t i = 0; i < set.nodes.size(); ++i)
            found.back().triples.push_back(triple_of(set.grains[i], set.nodes[i]));
    }
    return found;
}

/// Translations of node sets, from the unknowns at the end of a solution.
std::vector<Vector> set_ways(
    const SolidState& s, const std::vector<double>& u, const std::vector<FloatingNodes>& floating)
{
    std::vector<Vector> ways(floating.empty() ? 0 : s.node_sets.size());
    const double* next = u.data() + u.size() - 3 * floating.size();
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (!s.node_sets[i].floats) continue;
        ways[i] = triple_at(next, 0);
        next += 3;
    }
    return ways;
}

/// Forces that given ways leave on what is free, added to those of a load.
void add_given(
    const LinearForces& forces, const std::vector<double>& given, std::vector<double>& load)
{
    for (double& f : load)
        f = -f;
    forces.add(given.data(), load.data());
    for (double& f : load)
        f = -f;
}

SolidField field_of_nodes(const SolidState& s, const SolidDrive& drive, const Solving& how)
{
    const LinearSolid solid = touched_solid(s, drive, how.threads);
    const std::size_t size = 3 * solid.places.size();
    std::vector<std::uint8_t> held(size, 0);
    std::size_t next = 0;
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        for (int axis = 0; axis < 3; ++axis)
            held[next++] = s.grains.prescribed[s.grains.component(node, axis)];
    });
    if (s.plates.empty() && std::find(held.begin(), held.end(), 1) == held.end())
        refuse("elastic_field: held nodes", 0.0, "", "must be those of both ends; hold them first");
    std::vector<double> given(size, 0.0), guess(size, 0.0);
    std::vector<double> load = push_of(solid, drive);
    for (std::size_t n = 0; how.rises && n < solid.places.size(); ++n)
        (held[3 * n + 2] ? given : guess)[3 * n + 2] = solid.places[n].z - how.low;
    const NodeNumbers numbers(s);
    give_ways(s, drive, [&](int grain, int node, int axis, double way) {
        given[3 * numbers.of(grain, node) + axis] = way;
    });
    add_given(solid, given, load);
    const auto floating =
        floating_nodes(s, [&](int grain, int node) { return numbers.of(grain, node); });
    const FreeSolution found =
        solve_floating(solid, floating, std::move(held), std::move(load), std::move(guess));
    SolidField field;
    for (std::size_t n = 0; n < solid.places.size(); ++n)
        field.ways.push_back(triple_at(given.data(), static_cast<int>(n))
            + triple_at(found.u.data(), static_cast<int>(n)));
    field.plates = plate_motions(s, solid, drive, found.u.data());
    field.sets = set_ways(s, found.u, floating);
    field.load = load_of(solid, drive, found.u.data());  // no given node lies before a plate
    return field;
}

SolidField field_of_bodies(const SolidState& s, const SolidDrive& drive, const Solving& how)
{
    const LinearSolid solid = touched_solid(s, drive, how.threads);
    const RigidSolid rigid = rigid_solid(s, solid);
    std::vector<double> guess(6 * static_cast<std::size_t>(s.grains.count), 0.0);
    for (int g = 0; how.rises && g < s.grains.count; ++g)
        guess[6 * g + 2] = rigid.centres[g].z - how.low;
    std::vector<double> load(guess.size(), 0.0);
    rigid.gather(push_of(solid, drive).data(), load.data());
    std::vector<std::uint8_t> held(guess.size(), 0);
    for (int g = 0; g < s.grains.count; ++g)
        for (int axis = 0; axis < 3; ++axis)
            held[6 * g + axis] = s.grains.prescribed[s.grains.component(s.grains.centre(g), axis)];
    std::vector<double> given(guess.size(), 0.0);
    give_ways(
        s, drive, [&](int grain, int, int axis, double way) { given[6 * grain + axis] = way; });
    add_given(rigid, given, load);
    const auto floating = floating_nodes(s, [](int grain, int) { return 2 * grain; });
    FreeSolution found =
        solve_floating(rigid, floating, std::move(held), std::move(load), std::move(guess));
    for (std::size_t i = 0; i < given.size(); ++i)
        found.u[i] += given[i];
    SolidField field;
    for (int g = 0; g < s.grains.count; ++g) {
        field.ways.push_back(triple_at(found.u.data(), 2 * g));
        field.turns.push_back((1.0 / rigid.radii[g]) * triple_at(found.u.data(), 2 * g + 1));
    }
    const std::vector<double> moved = rigid.on_nodes(found.u.data());
    field.plates = plate_motions(s, solid, drive, moved.data());
    field.sets = set_ways(s, found.u, floating);
    field.load = load_of(solid, drive, moved.data());
    return field;
}

SolidField field_of(const SolidState& s, const SolidDrive& drive, const Solving& how)
{
    const bool rigid = !s.bodies.empty();
    if (!s.held_faces.empty())
        refuse("elastic_field: held faces of rigid grains",
            static_cast<double>(s.held_faces.size()), "", "must be 0; hold sides across an axis");
    const std::size_t parts = s.plates.size() + s.node_sets.size();
    if (rigid && parts < 2) {
        refuse("elastic_field: plates", static_cast<double>(parts), "",
            "must be 2 or more of rigid grains; call hold_ends() first");
    }
    return rigid ? field_of_bodies(s, drive, how) : field_of_nodes(s, drive, how);
}

}  // namespace

FaceFrame bonded_frame(const SolidState& s, int contact)
{
    const FaceContacts& c = s.contacts;
    std::vector<Vector> corners;
    for (int k = 0; k < c.corners_of(contact); ++k)
        corners.push_back(space_vector(s.grains.reference, c.node(contact, 0, k)));
    return face_frame(corners, { 0, c.line[c.slot[contact]] });
}

LinearSolid linear_solid(const SolidState& s, int threads)
{
    const NodeNumbers numbers(s);
    LinearSolid solid;
    for_each_node(s, [&](int grain, int number) {
        solid.places.push_back(space_vector(s.grains.reference, s.grains.node(grain, number)));
    });
    add_elements(s, numbers, solid);
    add_faces(s, numbers, solid);
    add_presses(s, numbers, solid);
    solid.first_nodes = numbers.first();
    solid.share_among(threads);
    return solid;
}

RigidSolid rigid_solid(const SolidState& s, const LinearSolid& solid)
{
    RigidSolid rigid(solid);
    for_each_node(s, [&](int grain, int) { rigid.grain.push_back(grain); });
    for (int g = 0; g < s.grains.count; ++g)
        rigid.centres.push_back(space_vector(s.grains.reference, s.grains.centre(g)));
    rigid.radii = s.grains.radius;
    return rigid;
}

SolidField elastic_field(const SolidState& s, int threads)
{
    SolidDrive drive;
    const double low = end_place(s, SolidSide::bottom);
    drive.length = end_place(s, SolidSide::top) - low;
    for (int p = 0; p < static_cast<int>(s.plates.size()); ++p)
        if (s.plates[p].side == static_cast<int>(SolidSide::top)) drive.plates.push_back(p);
    return field_of(s, drive, { threads, true, low });
}

SolidField elastic_field(const SolidState& s, const SolidDrive& drive, int threads)
{
    return field_of(s, drive, { threads });
}

}  // namespace flexpm
