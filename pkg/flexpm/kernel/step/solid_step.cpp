// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/step/solid_step.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/core/rows_of_four.hpp>
#include <flexpm/kernel/core/thread_team.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/pairs/pair_forces.hpp>
#include <flexpm/kernel/pairs/pair_search.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/soft_plate.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/face_forces.hpp>
#include <flexpm/kernel/space_lanes/rigid_faces.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/space_lanes/solid_motion.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_works.hpp>

#include <algorithm>
#include <atomic>

namespace flexpm {

namespace {

/// Tiles of one thread.
struct TileRange {
    int first, end;
};

TileRange share_of(const SolidPlan& plan, int thread, int threads)
{
    return { thread * plan.tiles() / threads, (thread + 1) * plan.tiles() / threads };
}

/// Call visit(block) for each block of grains of a tile.
template <class Visit> void for_each_block(const SolidState& s, int tile, Visit visit)
{
    const int end = std::min((tile + 1) * tile_grains, s.grains.blocks());
    for (int block = tile * tile_grains; block < end; ++block)
        visit(block);
}

void move_block(SolidState& s, int block, double dt)
{
    if (s.grains.group(block).rigid) {
        move_body(s, block, dt);
    } else {
        move_grain(s, block, dt);
    }
}

/// Move the grains of a thread that contacts of an earlier one touch to the end of the step.
void move_shared_grains(SolidState& s, TileRange own, double dt)
{
    for (int tile = own.first; tile < own.end; ++tile) {
        for_each_block(s, tile, [&](int block) {
            if (s.plan.first_tile[block] < own.first) move_block(s, block, dt);
        });
    }
}

/// Move those whose first contact is in a tile, as far as they are the thread's.
void move_grains_of(SolidState& s, int tile, TileRange own, double dt)
{
    const SolidPlan& plan = s.plan;
    const int end = plan.tile_moves[tile + 1];
    constexpr int ahead = 4;
    for (int i = plan.tile_moves[tile]; i < end; ++i) {
        if (s.is_rigid() && i + ahead < end) prefetch_body(s, plan.moves[i + ahead]);
        if (plan.moves[i] < own.end * tile_grains) move_block(s, plan.moves[i], dt);
    }
}

/// Contacts of a tile, with the forces that are added at once. Returns the number of contacts
/// without a middle face.
int update_contacts_of(SolidState& s, int tile, double dt)
{
    const int first = tile * tile_grains, end = std::min(first + tile_grains, s.grains.blocks());
    const int contacts = s.plan.tile_contacts[tile], past = s.plan.tile_contacts[tile + 1];
    if (s.is_rigid()) {
        clear_wrenches(s, first, end);
        return update_rigid_blocks(s, contacts, past, dt);
    }
    clear_forces(s, first, end);
    return update_face_blocks(s, contacts, past, dt);
}

/// Add parcels to the nodes of a block, in their order.
FLEXPM_INLINE void add_parcels(
    const Parcel* first, const Parcel* end, const double* parcels, double* force)
{
    for (const Parcel* p = first; p != end; ++p)
        row_of_four(force + p->node) += row_of_four(parcels + p->place);
}

FLEXPM_INLINE void add_wrenches(
    const Parcel* first, const Parcel* end, const double* parcels, double* wrench)
{
    for (const Parcel* p = first; p != end; ++p)
        for (int row = 0; row < WrenchRow::count; row += 4)
            row_of_four(wrench + row) += row_of_four(parcels + p->place + row);
}

/// Complete the forces of contacts, pairs, plates, pressures and gravity on a block of grains.
void sum_outer_forces(SolidState& s, int block)
{
    SolidPlan& plan = s.plan;
    const int first = plan.block_sums[block], end = plan.block_sums[block + 1];
    if (first < end) {
        const bool rigid = s.is_rigid();
        const auto add = rigid ? variant_of<add_wrenches>() : variant_of<add_parcels>();
        add(plan.sums.data() + first, plan.sums.data() + end, plan.parcels.data(),
            rigid ? plan.wrenches.data() + block * WrenchRow::count
                  : s.grains.force.data() + s.grains.block_nodes[block]);
    }
    add_pair_forces(s, block);
    if (!plan.first_press.empty()) add_plate_forces(s, block);
    if (!plan.first_pressed.empty()) add_pressure_forces(s, block);
    if (s.has_gravity()) add_weight(s, block);
}

/// Sum the forces on a block of grains and integrate its velocities.
void update_grains(SolidState& s, int block, const StepOptions& o)
{
    sum_outer_forces(s, block);
    StepSums sums;
    if (s.grains.group(block).rigid) {
        integrate_body(s, block, o, sums);
    } else {
        add_tetrahedron_forces(s, block);
        integrate_grain(s, block, o.dt, o.damping, o.measure, sums);
    }
    add_works(s.ledger, block, sums, o.measure);
}

/// Move the grains that contacts of an earlier thread touch, or all of a thread where pairs have to
/// know where grains are; then the pairs of the thread.
void move_first(SolidState& s, TileRange own, ThreadTeam& team, int thread, double dt)
{
    if (s.plan.pairs.empty()) return move_shared_grains(s, own, dt);
    for (int tile = own.first; tile < own.end; ++tile)
        for_each_block(s, tile, [&](int block) { move_block(s, block, dt); });
    team.meet();
    follow_bodies(s, thread, team.size());
    team.meet();
    update_pairs(s, dt, thread, team.size());
}

/// Update a thread's contacts and the grains that only these touch. Returns the number of contacts
/// without a middle face.
int update_own_tiles(SolidState& s, TileRange own, const StepOptions& o)
{
    int turned = 0;
    for (int tile = own.first; tile < own.end; ++tile) {
        if (s.plan.pairs.empty()) move_grains_of(s, tile, own, o.dt);
        turned += update_contacts_of(s, tile, o.dt);
        for_each_block(s, tile, [&](int block) {
            if (s.plan.first_tile[block] >= own.first) update_grains(s, block, o);
        });
    }
    return turned;
}

/// Update the grains that contacts of an earlier thread touch, too.
void update_shared_grains(SolidState& s, TileRange own, const StepOptions& o)
{
    for (int tile = own.first; tile < own.end; ++tile) {
        for_each_block(s, tile, [&](int block) {
            if (s.plan.first_tile[block] < own.first) update_grains(s, block, o);
        });
    }
}

/// A state that was loaded has pairs, but no plan of theirs.
void require_plan_of_pairs(SolidState& s)
{
    if (s.plan.pairs.pairs.size() != s.pairs.size()) prepare_pairs(s);
}

void check(const StepOptions& o)
{
    check_positive("time step", o.dt, "s");
    check_damping(o.damping);
    if (o.threads < 1) refuse("threads", o.threads, "", "must be at least 1");
}

}  // namespace

void find_forces(SolidState& s)
{
    if (s.is_rigid()) read_motions(s);
    require_plan_of_pairs(s);
    update_pairs(s, 0.0);
    int turned = 0;
    for (int tile = 0; tile < s.plan.tiles(); ++tile)
        turned += update_contacts_of(s, tile, 0.0);
    if (turned > 0) {
        refuse("contacts without a middle face", turned, "",
            "must be 0; the sides of each contact must lie opposite to each other");
    }
    for (int block = 0; block < s.grains.blocks(); ++block) {
        sum_outer_forces(s, block);
        if (s.grains.group(block).rigid)
            sum_body_forces(s, block);
        else
            add_tetrahedron_forces(s, block);
    }
    sum_plates(s, 0.0, 0.0);
    leave_nodes_behind(s);
    show_nodes(s);
}

void step(SolidState& s, const StepOptions& options)
{
    check(options);
    if (s.plan.tile_contacts.empty()) {
        refuse("tiles of a step", 0.0, "", "must be at least 1; call prepare_step() after loading");
    }
    require_plan_of_pairs(s);
    ThreadTeam& team = team_of(options.threads);
    std::atomic<int> turned { 0 };
    for (Plate& plate : s.plates)
        plate.displacement = plate.displacement + options.dt * plate.velocity;
    give_way(s, options.dt);
    const ThreadTeam::Work share = [&](int thread) {
        const TileRange own = share_of(s.plan, thread, team.size());
        move_first(s, own, team, thread, options.dt);
        team.meet();
        turned += update_own_tiles(s, own, options);
        team.meet();
        update_shared_grains(s, own, options);
    };
    team.run(share);
    leave_nodes_behind(s);
    if (!options.leave_nodes) show_nodes(s);
    hold_faces(s);
    sum_plates(s, options.dt, options.damping);
    sum_pressure_work(s);
    ++s.step;
    if (turned > 0) {
        fail("step " + std::to_string(s.step) + ": contacts without a middle face",
            std::to_string(turned), "must be 0; load more slowly, or end the test earlier");
    }
    update_node_sets(s, options.dt, options.damping);
}

void show_nodes(SolidState& s)
{
    show_places(s);
    if (!s.plan.forces_behind) return;
    s.plan.forces_behind = false;
    Array<double>& forces = s.plan.shown_forces;
    forces = s.grains.force;
    add_node_forces(s, forces.data());
    require_plan_of_pairs(s);
    add_loads_of_pairs(s, forces.data());
}

}  // namespace flexpm
