// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/pairs/pair_forces.hpp>

#include <flexpm/kernel/pairs/grain_bodies.hpp>
#include <flexpm/kernel/pairs/pair_friction.hpp>
#include <flexpm/kernel/space/overlap.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace flexpm {

namespace {

/// Loads of friction with the size 1: along two tangents, and about the normal.
constexpr int modes = 3;
using Modes = std::array<Vector, modes>;

/// A face that is pressed.
struct PressedFace {
    int first, count;  ///< corners in SideOfPair
    double share;      ///< of the side's friction [-]
    Vector force;      ///< by pressure [N]
    Vector point;      ///< where it acts, from the centre [m]
};

/// One grain of a pair, with what acts on its pressed faces.
struct SideOfPair {
    int grain;
    Vector centre;
    bool rigid;
    std::vector<PressedFace> faces;
    std::vector<int> nodes;        ///< corners of the faces
    std::vector<int> pressed;      ///< numbers of the faces in BodyFaces
    std::vector<Vector> corners;   ///< from the centre [m]
    std::vector<Vector> pressure;  ///< [N]
    std::vector<Modes> friction;   ///< forces for loads of 1
    Vector place;                  ///< where friction acts on the nodes [m]
};

/// Room for a pair; each thread has its own.
struct Room {
    SpaceOverlap overlap;
    std::array<SideOfPair, 2> sides;
};

/// Shares of the corners of a face in a force that acts at a point in its plane: their sum is 1, and
/// the mean of the corners by them is the point.
void find_shares(const Vector* corners, int count, Vector at, std::vector<double>& shares)
{
    const ContactPlane plane = InSpace::plane_of(corners, count);
    const auto [first, second] = InSpace::tangents(plane.normal);
    Vector mean;
    for (int k = 0; k < count; ++k)
        mean = mean + (1.0 / count) * corners[k];
    double uu = 0.0, uv = 0.0, vv = 0.0;
    for (int k = 0; k < count; ++k) {
        const double u = dot(corners[k] - mean, first), v = dot(corners[k] - mean, second);
        uu += u * u;
        uv += u * v;
        vv += v * v;
    }
    const double whole = uu * vv - uv * uv;
    const double a = dot(at - mean, first), b = dot(at - mean, second);
    const double along = (vv * a - uv * b) / whole, across = (uu * b - uv * a) / whole;
    shares.clear();
    for (int k = 0; k < count; ++k) {
        const double u = dot(corners[k] - mean, first), v = dot(corners[k] - mean, second);
        shares.push_back(1.0 / count + along * u + across * v);
    }
}

/// Add forces without a sum that have a moment. Forces across the polygon, which turn its area vector,
/// take what lies in its plane, and forces around its mean the rest.
template <class Add> void add_couple(const Vector* corners, int count, Vector moment, Add add)
{
    Vector twice, mean = (1.0 / count) * corners[0];
    for (int k = 1; k < count; ++k)
        mean = mean + (1.0 / count) * corners[k];
    for (int k = 1; k + 1 < count; ++k)
        twice = twice + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    const double area = 0.5 * norm(twice);
    const Vector normal = (0.5 / area) * twice;
    double squares = 0.0;
    Vector bent;  // of faces that are not flat
    for (int k = 0; k < count; ++k) {
        const Vector r = corners[k] - mean;
        const double off = dot(r, normal);
        squares += dot(r, r) - off * off;
        bent = bent + off * (r - off * normal);
    }
    const double about = dot(moment, normal) / squares;
    const Vector tilting = (1.0 / area) * cross(moment + about * bent, normal);
    for (int k = 0; k < count; ++k) {
        const Vector past = corners[(k + 1) % count] - corners[(k + count - 1) % count];
        add(k, 0.5 * cross(past, tilting) + about * cross(normal, corners[k] - mean));
    }
}

/// The face that bears most of the friction of a side.
const PressedFace& main_face(const SideOfPair& side)
{
    return *std::max_element(side.faces.begin(), side.faces.end(),
        [](const PressedFace& a, const PressedFace& b) { return a.share < b.share; });
}

/// Collect the pressed faces of a side, with the nodes' forces by pressure. The friction of a side is
/// shared by faces as the pressure is.
void find_side(const SolidState& s, const GrainBody& body, int which, int faces_before,
    double stiffness, const std::vector<FaceForce>& forces, SideOfPair& side)
{
    const BodyFaces& faces = s.plan.pairs.faces;
    side.grain = body.grain;
    side.centre = body.centre;
    side.rigid = s.grains.is_rigid(body.grain);
    side.faces.clear();
    side.nodes.clear();
    side.pressed.clear();
    side.corners.clear();
    double sum = 0.0;
    for (const FaceForce& on : forces) {
        if ((on.face < faces_before) != (which == 0)) continue;
        const int face = faces.first[body.grain] + on.face - (which == 0 ? 0 : faces_before);
        const int first = static_cast<int>(side.nodes.size());
        side.pressed.push_back(face);
        for (int k = faces.first_corner[face]; k < faces.first_corner[face + 1]; ++k) {
            side.nodes.push_back(faces.corners[k]);
            side.corners.push_back(present_position(s, body.grain, faces.corners[k]) - body.centre);
        }
        const double size = norm(on.force);
        side.faces.push_back({ first, static_cast<int>(side.nodes.size()) - first, size,
            stiffness * on.force, on.point });
        sum += size;
    }
    side.pressure.assign(side.nodes.size(), {});
    for (PressedFace& face : side.faces) {
        face.share /= sum;
        InSpace::spread(side.corners.data() + face.first, face.count, { 0, face.force, face.point },
            side.pressure.data() + face.first);
    }
}

/// Forces on the nodes of a side for friction of 1 at a point.
/// @param at     where friction acts [m]
/// @param sign   1: side of the second grain
void spread_friction(SideOfPair& side, Vector at, const Modes& loads, double sign)
{
    thread_local std::vector<double> shares;
    side.friction.assign(side.nodes.size(), {});
    side.place = {};
    for (const PressedFace& face : side.faces) {
        const Vector* corners = side.corners.data() + face.first;
        find_shares(corners, face.count, at - side.centre, shares);
        for (int k = 0; k < face.count; ++k) {
            const double share = face.share * shares[k];
            side.place = side.place + share * (corners[k] + side.centre);
            for (int mode = 0; mode + 1 < modes; ++mode)
                side.friction[face.first + k][mode] = sign * share * loads[mode];
        }
    }
}

/// Add to the friction of a side what gives it moments of its own.
void add_couples(SideOfPair& side, const Modes& moments)
{
    const PressedFace& face = main_face(side);
    for (int mode = 0; mode < modes; ++mode) {
        add_couple(
            side.corners.data() + face.first, face.count, moments[mode], [&](int k, Vector force) {
                Vector& sum = side.friction[face.first + k][mode];
                sum = sum + force;
            });
    }
}

/// Work of each of the loads on the motion of a step: its way.
std::array<double, modes> ways_of(const SolidState& s, const std::array<SideOfPair, 2>& sides,
    Vector at, const Modes& loads, double dt)
{
    std::array<double, modes> work {};
    for (int k = 0; k < 2; ++k) {
        const SideOfPair& side = sides[k];
        if (side.rigid) {
            const double sign = k == 0 ? -1.0 : 1.0;
            const Vector spin = s.bodies[side.grain].spin;
            const Vector velocity = space_vector(s.grains.velocity, s.grains.centre(side.grain))
                + cross(spin, at - side.centre);
            for (int mode = 0; mode + 1 < modes; ++mode)
                work[mode] += sign * dt * dot(loads[mode], velocity);
            work[modes - 1] += sign * dt * dot(loads[modes - 1], spin);
            continue;
        }
        for (std::size_t i = 0; i < side.nodes.size(); ++i) {
            const Vector velocity = space_vector(s.grains.velocity, side.nodes[i]);
            for (int mode = 0; mode < modes; ++mode)
                work[mode] += dt * dot(side.friction[i][mode], velocity);
        }
    }
    return work;
}

/// Load of a pair on one of its grains.
void write_load(const SideOfPair& side, Vector at, Vector friction, double moment, Vector normal,
    const std::array<double, modes>& sizes, double sign, PairLoad& to)
{
    to.forces.clear();
    to.force = to.moment = {};
    if (side.rigid) {
        for (const PressedFace& face : side.faces) {
            to.force = to.force + face.force;
            to.moment = to.moment + cross(face.point, face.force);
        }
        const Vector rubbing = sign * friction;
        to.force = to.force + rubbing;
        to.moment = to.moment + cross(at - side.centre, rubbing) + sign * moment * normal;
    }
    to.nodes = side.nodes;
    to.faces = side.pressed;
    for (std::size_t i = 0; i < side.nodes.size(); ++i) {
        Vector force = side.pressure[i];
        for (int mode = 0; mode < modes; ++mode)
            force = force + sizes[mode] * side.friction[i][mode];
        to.forces.push_back(force);
    }
}

void clear(PairLoad& load)
{
    load.nodes.clear();
    load.faces.clear();
    load.forces.clear();
    load.force = load.moment = {};
}

/// A pair that does not press.
void part(PairContact& pair, const LawParameters& law, PairWork& work)
{
    release_friction(pair, law.shear_stiffness);
    pair.normal_force = pair.depth = pair.elastic_energy = 0.0;
    pair.place = pair.force = {};
    for (PairLoad& load : work.loads)
        clear(load);
}

/// Let the planes that were moved outwards at a hand-over, to keep its energy, come back while the
/// pair slides. What the overlap stores less counts as friction.
/// @param before  energy of the overlap until then, over K_n
void fade(PairContact& pair, double slid, double before, const LawParameters& law,
    const ContactBody& a, const ContactBody& b, Room& room)
{
    constexpr double fading = 0.01;
    pair.clearance = std::min(pair.clearance + fading * slid, 0.0);
    const double less =
        law.normal_stiffness * (before - room.overlap.measure(a, b, pair.clearance).energy);
    pair.elastic_energy -= less;
    pair.friction_energy += less;
}

/// Update a pair and its loads, which may be copies of those of the state and of the plan.
void update_pair(const SolidState& s, PairContact& pair, PairWork& work, double dt, Room& room)
{
    const GrainBody &a = s.plan.pairs.bodies[work.bodies[0]],
                    &b = s.plan.pairs.bodies[work.bodies[1]];
    const LawParameters& law = s.contacts.laws[pair.law];
    const ContactBody of_a = a.view(), of_b = b.view();
    const BodyOverlap overlap = room.overlap.measure(of_a, of_b, pair.clearance, &work.separating);
    const std::vector<FaceForce>& forces = room.overlap.forces();
    Vector on_b, place;
    double sum = 0.0;
    for (const FaceForce& on : forces) {
        const bool of_second = on.face >= of_a.faces;
        if (of_second) on_b = on_b + law.normal_stiffness * on.force;
        const double size = norm(on.force);
        place = place + size * (on.point + (of_second ? b.centre : a.centre));
        sum += size;
    }
    const double force = norm(on_b);
    if (!(force > 0.0) || !(overlap.area > 0.0)) return part(pair, law, work);
    const PairPress press { (1.0 / force) * on_b, force, overlap.area };
    const Vector at = (1.0 / sum) * place;

    find_side(s, a, 0, of_a.faces, law.normal_stiffness, forces, room.sides[0]);
    find_side(s, b, 1, of_a.faces, law.normal_stiffness, forces, room.sides[1]);
    if (room.sides[0].faces.empty() || room.sides[1].faces.empty()) return part(pair, law, work);
    const auto [first, second] = InSpace::tangents(press.normal);
    const Modes loads { first, second, press.normal };
    spread_friction(room.sides[0], at, loads, -1.0);
    spread_friction(room.sides[1], at, loads, 1.0);
    // friction that acts in different places on both sides has a moment, which either side gets
    // half of, with the opposite sign
    const Vector apart = room.sides[1].place - room.sides[0].place;
    for (int k = 0; k < 2; ++k) {
        add_couples(room.sides[k],
            { -0.5 * cross(apart, first), -0.5 * cross(apart, second),
                (k == 0 ? -1.0 : 1.0) * press.normal });
    }
    const std::array<double, modes> way = ways_of(s, room.sides, at, loads, dt);
    const PairWay moved { way[0] * first + way[1] * second, way[2] };
    const PairFriction rubs =
        advance_friction(pair, press, moved, law.shear_stiffness, friction_of(pair, law));
    if (law::weakens(law)) pair.crack_slip += rubs.slid;
    // friction holds the second grain back
    const std::array<double, modes> sizes { -dot(rubs.force, first), -dot(rubs.force, second),
        -rubs.moment };
    for (int k = 0; k < 2; ++k) {
        write_load(room.sides[k], at, -rubs.force, -rubs.moment, press.normal, sizes,
            k == 0 ? -1.0 : 1.0, work.loads[k]);
    }
    pair.normal_force = force;
    pair.depth = overlap.depth;
    pair.place = at;
    pair.force = on_b - rubs.force;
    pair.elastic_energy =
        law.normal_stiffness * overlap.energy + spring_energy(pair, law.shear_stiffness);
    if (pair.clearance < 0.0 && rubs.slid > 0.0)
        fade(pair, rubs.slid, overlap.energy, law, of_a, of_b, room);
}

void add_node_loads(const PairLoad& load, double* forces)
{
    for (std::size_t k = 0; k < load.nodes.size(); ++k) {
        double* force = forces + load.nodes[k];
        force[0] += load.forces[k].x;
        force[1] += load.forces[k].y;
        force[2] += load.forces[k].z;
    }
}

}  // namespace

void follow_bodies(SolidState& s, int thread, int threads)
{
    PairPlan& plan = s.plan.pairs;
    const auto count = static_cast<int>(plan.bodies.size());
    for (int i = thread * count / threads; i < (thread + 1) * count / threads; ++i)
        follow_grain(s, plan.faces, plan.bodies[i]);
}

void update_pairs(SolidState& s, double dt, int thread, int threads)
{
    thread_local Room room;
    const auto count = static_cast<int>(s.pairs.size());
    for (int i = thread * count / threads; i < (thread + 1) * count / threads; ++i)
        update_pair(s, s.pairs[i], s.plan.pairs.pairs[i], dt, room);
}

void update_pairs(SolidState& s, double dt)
{
    follow_bodies(s, 0, 1);
    update_pairs(s, dt, 0, 1);
}

void add_loads_of_pairs(const SolidState& s, double* forces)
{
    Room room;
    for (std::size_t i = 0; i < s.pairs.size(); ++i) {
        PairContact pair = s.pairs[i];
        PairWork work = s.plan.pairs.pairs[i];
        if (!pair.presses()) continue;
        update_pair(s, pair, work, 0.0, room);
        for (const PairLoad& load : work.loads)
            add_node_loads(load, forces);
    }
}

void add_pair_forces(SolidState& s, int block)
{
    const PairPlan& plan = s.plan.pairs;
    if (plan.first_use.empty()) return;
    for (int i = plan.first_use[block]; i < plan.first_use[block + 1]; ++i) {
        const PairLoad& load = plan.pairs[plan.uses[i].pair].loads[plan.uses[i].side];
        if (!s.is_rigid()) {
            add_node_loads(load, s.grains.force.data());
            continue;
        }
        double* wrench = s.plan.wrenches.data() + block * WrenchRow::count;
        const Vector of[] = { load.force, load.moment };
        for (int row : { 0, 1 }) {
            double* to = wrench + row * WrenchRow::moment;
            to[0] += of[row].x;
            to[1] += of[row].y;
            to[2] += of[row].z;
        }
    }
}

std::vector<double> largest_shares(const std::vector<Vector>& corners)
{
    const auto count = static_cast<int>(corners.size());
    const Vector normal = InSpace::plane_of(corners.data(), count).normal;
    std::vector<double> largest(count, 0.0);
    for (const Vector& place : corners) {
        std::vector<Vector> forces(count);
        InSpace::spread(corners.data(), count, { 0, normal, place }, forces.data());
        double sum = 0.0;
        for (const Vector& force : forces)
            sum += std::fabs(dot(force, normal));
        for (int k = 0; k < count; ++k)
            largest[k] = std::max(largest[k], sum * std::fabs(dot(forces[k], normal)));
    }
    return largest;
}

}  // namespace flexpm
