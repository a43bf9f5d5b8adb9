// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/prefetch_rows.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/core/rows_of_four.hpp>
#include <flexpm/kernel/space_lanes/face_forces.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

namespace flexpm {

namespace {

/// The nodes of a rigid grain, its centre the last one.
struct BodyNodes {
    int vertices;
    const double* reference;
    const double* displacement;
    const double* force;
};

BodyNodes body_nodes(const SolidState& s, int grain)
{
    const Grains& grains = s.grains;
    const int first = grains.node(grain, 0);
    return { grains.vertices_of(grain), grains.reference.data() + first,
        grains.displacement.data() + first, grains.force.data() + first };
}

/// What a turn adds to vectors: to those along the axes.
struct TurnColumns {
    Vector x, y, z;
};

/// Displacements of all nodes but the centre, for a way of that.
FLEXPM_INLINE void place_nodes(
    const BodyNodes& b, Vector way, const TurnColumns& turn, double* displacement)
{
    constexpr int stride = space_layout.node_stride;
    const Four middle = row_of_four(b.reference + b.vertices * stride);
    const Four to { way.x, way.y, way.z, 0.0 }, of_x { turn.x.x, turn.x.y, turn.x.z, 0.0 },
        of_y { turn.y.x, turn.y.y, turn.y.z, 0.0 }, of_z { turn.z.x, turn.z.y, turn.z.z, 0.0 };
    for (int n = 0; n < b.vertices; ++n) {
        const Four arm = row_of_four(b.reference + n * stride) - middle;
        const Four x = __builtin_shufflevector(arm, arm, 0, 0, 0, 0);
        const Four y = __builtin_shufflevector(arm, arm, 1, 1, 1, 1);
        const Four z = __builtin_shufflevector(arm, arm, 2, 2, 2, 2);
        row_of_four(displacement + n * stride) = to + (x * of_x + y * of_y + z * of_z);
    }
}

/// Sum of the forces on all nodes but the centre, and their moment about it.
FLEXPM_INLINE void sum_forces(const BodyNodes& b, Resultant& to)
{
    constexpr int stride = space_layout.node_stride;
    const double *centre = b.reference + b.vertices * stride,
                 *of_centre = b.displacement + b.vertices * stride;
    const Four middle = row_of_four(centre) + row_of_four(of_centre);
    Four sum {}, across {};
    for (int n = 0; n < b.vertices; ++n) {
        const int row = n * stride;
        const Four arm =
            row_of_four(b.reference + row) + row_of_four(b.displacement + row) - middle;
        const Four f = row_of_four(b.force + row);
        // y z x of both: the product has its components in this order, too
        const Four next_arm = __builtin_shufflevector(arm, arm, 1, 2, 0, 3);
        const Four next_f = __builtin_shufflevector(f, f, 1, 2, 0, 3);
        sum += f;
        across += arm * next_f - next_arm * f;
    }
    const Four moment = __builtin_shufflevector(across, across, 1, 2, 0, 3);
    to = { { sum[0], sum[1], sum[2] }, { moment[0], moment[1], moment[2] } };
}

/// Solve I w = l.
Vector solve(const SpaceTensor& i, Vector l)
{
    const Vector x { i.xx, i.xy, i.xz }, y { i.xy, i.yy, i.yz }, z { i.xz, i.yz, i.zz };
    const double whole = triple(x, y, z);
    return (1.0 / whole) * Vector { triple(l, y, z), triple(x, l, z), triple(x, y, l) };
}

/// Whether all directions are alike, as of scaled masses.
bool is_round(const SpaceTensor& i)
{
    return i.xx == i.yy && i.yy == i.zz && i.yz == 0.0 && i.xz == 0.0 && i.xy == 0.0;
}

/// Spin half a step after the turn of a body with its angular momentum.
Vector spin_of(const RigidBody& body, double dt)
{
    if (is_round(body.inertia)) return (1.0 / body.inertia.xx) * body.angular_momentum;
    // converges to the last digit for the turns of a step
    constexpr int rounds = 6;
    Vector spin = body.spin;
    for (int round = 0; round < rounds; ++round) {
        const Quaternion there = rotation_by(0.5 * dt * spin) * body.turn;
        spin = turned(there, solve(body.inertia, turned(inverse(there), body.angular_momentum)));
    }
    return spin;
}

/// Local damping of a moment, Eq. 2 for each component.
/// @param spin  beyond what damping leaves alone
Vector damping_moment(Vector moment, Vector spin, double damping)
{
    const auto against = [&](double m, double w) {
        return (w > 0.0 ? -damping : (w < 0.0 ? damping : 0.0)) * std::fabs(m);
    };
    return { against(moment.x, spin.x), against(moment.y, spin.y), against(moment.z, spin.z) };
}

/// New spin of a body under a moment, and the works of damping and of what holds it.
///
/// @param undamped  spin that damping leaves alone
void integrate_turn(
    RigidBody& body, Vector moment, Vector undamped, const StepOptions& o, StepSums& sums)
{
    const Vector old = body.spin, momentum = body.angular_momentum;
    if (body.spin_held) {
        const double work = -0.5 * o.dt * dot(moment, old);
        sums.prescribed[0] += work;
        sums.prescribed_next[0] += work;
        const Vector own = turned(inverse(body.turn), body.spin);
        body.angular_momentum = turned(body.turn, body.inertia * own);
        return;
    }
    const Vector damp = damping_moment(moment, old - undamped, o.damping);
    body.angular_momentum = momentum + o.dt * (moment + damp);
    body.spin = spin_of(body, o.dt);
    sums.damped[0] -= 0.5 * o.dt * dot(damp, old);
    sums.damped_next[0] -= 0.5 * o.dt * dot(damp, body.spin);
    sums.dragged[0] -= 0.5 * o.dt * dot(damp, undamped);
    sums.kinetic[0] += 0.25 * (dot(old, body.angular_momentum) + dot(body.spin, momentum));
}

Vector axis_vector(int axis)
{
    return { axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0 };
}

Vector vector_of(const double* row) { return { row[0], row[1], row[2] }; }

void set_row(double* row, Vector v)
{
    row[0] = v.x;
    row[1] = v.y;
    row[2] = v.z;
}

/// Force and moment on a rigid grain: those of its contacts, what acts on its nodes, and its weight,
/// which its centre has. The centre gets the force.
Resultant forces_on_body(SolidState& s, int block)
{
    Grains& grains = s.grains;
    const auto [grain, centre] = s.plan.body_places[block];
    const double* wrench = s.plan.wrenches.data() + block * WrenchRow::count;
    Resultant on { vector_of(wrench + WrenchRow::force), vector_of(wrench + WrenchRow::moment) };
    if (s.plan.node_loads[block] != 0) {
        Resultant more;
        variant_of<sum_forces>()(body_nodes(s, grain), more);
        on = { on.force + more.force, on.moment + more.moment };
    }
    if (s.has_gravity()) on.force = on.force + space_vector(grains.force, centre);
    set_space_vector(grains.force, centre, on.force);
    s.bodies[grain].moment = on.moment;
    return on;
}

/// The motion of a rigid grain since the reference.
BodyMotion motion_of(const SolidState& s, int grain)
{
    return { space_vector(s.grains.displacement, s.grains.centre(grain)), s.bodies[grain].turn };
}

/// Put all nodes of a rigid grain but the centre where centre and turn are. A window may ask for it
/// while a step is under way, so nothing is written that a step reads.
void place_vertices(SolidState& s, int grain, Vector way)
{
    const Quaternion& turn = s.bodies[grain].turn;
    const TurnColumns columns { turned_by(turn, { 1.0, 0.0, 0.0 }),
        turned_by(turn, { 0.0, 1.0, 0.0 }), turned_by(turn, { 0.0, 0.0, 1.0 }) };
    double* displacement = s.grains.displacement.data() + s.grains.node(grain, 0);
    variant_of<place_nodes>()(body_nodes(s, grain), way, columns, displacement);
}

/// Leave no force on the nodes of a block.
void clear_nodes(Grains& grains, int block)
{
    double* force = grains.force.data() + grains.block_nodes[block];
    std::fill_n(force, grains.group(block).nodes * grains.layout.node_stride, 0.0);
}

}  // namespace

void move_body(SolidState& s, int block, double dt)
{
    Grains& grains = s.grains;
    const auto [grain, centre] = s.plan.body_places[block];
    RigidBody& body = s.bodies[grain];
    const Vector way =
        space_vector(grains.displacement, centre) + dt * space_vector(grains.velocity, centre);
    body.turn = normalized(scaled_rotation_by(dt * body.spin) * body.turn);
    set_space_vector(grains.displacement, centre, way);
    write_motion({ way, body.turn }, s.plan.motions.data() + block * RigidMotionRow::count);
    if (s.plan.node_loads[block] != 0) place_vertices(s, grain, way);
}

void prefetch_body(const SolidState& s, int block)
{
    const Grains& grains = s.grains;
    const auto [grain, centre] = s.plan.body_places[block];
    for (const auto* values : { &grains.displacement, &grains.velocity, &grains.force })
        __builtin_prefetch(values->data() + centre);
    __builtin_prefetch(s.undamped().velocity.data() + centre);
    __builtin_prefetch(s.undamped().spin.data() + 3 * grain);
    __builtin_prefetch(grains.inverse_mass.data() + grains.scalar_index(centre));
    __builtin_prefetch(grains.prescribed.data() + centre);
    prefetch_rows(reinterpret_cast<const double*>(&s.bodies[grain]), 3);
    prefetch_rows(s.plan.motions.data() + block * RigidMotionRow::count, 2);
}

void read_motions(SolidState& s)
{
    for (int block = 0; block < s.grains.blocks(); ++block) {
        write_motion(motion_of(s, s.plan.body_places[block].grain),
            s.plan.motions.data() + block * RigidMotionRow::count);
    }
}

void clear_wrenches(SolidState& s, int first, int end)
{
    std::fill(s.plan.wrenches.begin() + first * WrenchRow::count,
        s.plan.wrenches.begin() + end * WrenchRow::count, 0.0);
    for (int block = first; block < end; ++block) {
        if (s.plan.node_loads[block] != 0) {
            clear_nodes(s.grains, block);
        } else {
            set_space_vector(s.grains.force, s.plan.body_places[block].centre, {});
        }
    }
}

void sum_body_forces(SolidState& s, int block) { forces_on_body(s, block); }

void integrate_body(SolidState& s, int block, const StepOptions& o, StepSums& sums)
{
    Grains& grains = s.grains;
    const int grain = s.plan.body_places[block].grain, centre = s.plan.body_places[block].centre;
    const Vector moment = forces_on_body(s, block).moment;
    const double inverse_mass = grains.inverse_mass[grains.scalar_index(centre)];
    const Array<double>& undamped = s.undamped().velocity;
    const auto integrate = [&](auto measure) FLEXPM_INLINED {
        for (int axis = 0; axis < 3; ++axis) {
            const int i = centre + axis;
            integrate_one<measure>({ grains.force[i], inverse_mass,
                                       static_cast<double>(grains.prescribed[i]), undamped[i] },
                o.dt, o.damping, grains.velocity[i], sums, axis);
        }
    };
    if (o.measure) {
        integrate(std::true_type());
    } else {
        integrate(std::false_type());
    }
    RigidBody& body = s.bodies[grain];
    if (o.measure && !body.spin_held)
        sums.largest[0] = std::max(sums.largest[0], norm(moment) / grains.radius[grain]);
    integrate_turn(body, moment, spin_in(s.undamped(), grain), o, sums);
}

void leave_nodes_behind(SolidState& s)
{
    s.plan.places_behind = s.is_rigid();
    s.plan.forces_behind = s.is_rigid();
}

void show_places(SolidState& s)
{
    if (!s.plan.places_behind) return;
    s.plan.places_behind = false;
    for (int block = 0; block < s.grains.blocks(); ++block) {
        const auto [grain, centre] = s.plan.body_places[block];
        if (s.plan.node_loads[block] == 0)
            place_vertices(s, grain, space_vector(s.grains.displacement, centre));
    }
}

void write_motion(const BodyMotion& motion, double* to)
{
    set_row(to + RigidMotionRow::way, motion.way);
    set_row(to + RigidMotionRow::of_x, turned_by(motion.turn, { 1.0, 0.0, 0.0 }));
    set_row(to + RigidMotionRow::of_y, turned_by(motion.turn, { 0.0, 1.0, 0.0 }));
    set_row(to + RigidMotionRow::of_z, turned_by(motion.turn, { 0.0, 0.0, 1.0 }));
}

BodyMotion motion_before(const SolidState& s, int grain, double dt)
{
    const BodyMotion now = motion_of(s, grain);
    return { now.way - dt * space_vector(s.grains.velocity, s.grains.centre(grain)),
        inverse(rotation_by(dt * s.bodies[grain].spin)) * now.turn };
}

void place_body(SolidState& s, int grain, Vector way)
{
    set_space_vector(s.grains.displacement, s.grains.centre(grain), way);
    place_vertices(s, grain, way);
}

Vector displacement_before(const SolidState& s, int grain, int node, double dt)
{
    const Grains& grains = s.grains;
    if (!grains.is_rigid(grain)) {
        return space_vector(grains.displacement, node) - dt * space_vector(grains.velocity, node);
    }
    const BodyMotion before = motion_before(s, grain, dt);
    const Vector arm =
        space_vector(grains.reference, node) - space_vector(grains.reference, grains.centre(grain));
    return before.way + turned_by(before.turn, arm);
}

void set_spin(SolidState& s, int grain, Vector spin, bool held)
{
    RigidBody& body = s.bodies.at(grain);
    body.spin = spin;
    body.spin_held = held;
    body.angular_momentum = turned(body.turn, body.inertia * turned(inverse(body.turn), spin));
}

void set_motion(SolidState& s, int grain, Vector velocity, Vector spin)
{
    if (!s.grains.is_rigid(grain))
        refuse("grain", grain, "", "is deformable, must be rigid; write to its velocities instead");
    if (!is_finite(velocity) || !is_finite(spin)) {
        refuse("motion of grain " + std::to_string(grain), "no finite number",
            "must be a velocity [m/s] and a spin [rad/s]");
    }
    set_space_vector(s.grains.velocity, s.grains.centre(grain), velocity);
    set_spin(s, grain, spin, s.bodies[grain].spin_held);
}

void hold_faces(SolidState& s)
{
    Grains& grains = s.grains;
    for (const HeldFace& face : s.held_faces) {
        RigidBody& body = s.bodies[face.grain];
        const int centre = grains.centre(face.grain);
        const Vector along = axis_vector(face.axis);
        const Quaternion back = inverse(body.turn);
        const Vector lever = cross(turned(body.turn, face.arm), along);
        const Vector turns = turned(body.turn, solve(body.inertia, turned(back, lever)));
        const double inverse_mass = grains.inverse_mass[grains.scalar_index(centre)];
        const int i = grains.component(centre, face.axis);
        const double push =
            -(grains.velocity[i] + dot(body.spin, lever)) / (inverse_mass + dot(lever, turns));
        grains.velocity[i] += push * inverse_mass;
        set_spin(s, face.grain, body.spin + push * turns, false);
    }
}

double least_moment(const SpaceTensor& i)
{
    const Vector x { i.xx, i.xy, i.xz }, y { i.xy, i.yy, i.yz }, z { i.xz, i.yz, i.zz };
    const double trace = i.xx + i.yy + i.zz;
    // Gershgorin's circles; and the product of the others is at most a quarter of trace squared
    const double circles = std::min({ i.xx - std::fabs(i.xy) - std::fabs(i.xz),
        i.yy - std::fabs(i.xy) - std::fabs(i.yz), i.zz - std::fabs(i.xz) - std::fabs(i.yz) });
    return std::max(circles, 4.0 * triple(x, y, z) / (trace * trace));
}

}  // namespace flexpm
