// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/step/step.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/core/thread_team.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/held_sides.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/centre_motion.hpp>
#include <flexpm/kernel/plane_lanes/contact_forces.hpp>
#include <flexpm/kernel/plane_lanes/element_forces.hpp>
#include <flexpm/kernel/plane_lanes/nodal_forces.hpp>
#include <flexpm/kernel/plane_lanes/node_motion.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_works.hpp>
#include <flexpm/kernel/step/tiles.hpp>

#include <algorithm>

namespace flexpm {

namespace {

void show_positions(const Grains& grains, int first, int count, Array<double>& shown)
{
    for (int i = first; i < first + count; ++i)
        shown[i] = grains.reference[i] + grains.displacement[i];
}

/// Sum the forces on the nodes of a block of grains and move it.
void update_grain_block(Assembly& a, int block, const StepOptions& o)
{
    Grains& grains = a.grains;
    const MeshGroup& group = grains.group(block);
    sum_forces(a, block);
    if (a.has_gravity()) add_weight(a, block);
    if (o.outer != nullptr) add_outer_forces(a, block, *o.outer);
    StepSums sums;
    if (group.rigid) {
        step_rigid(rigid_rows(a, block), o.dt, o.damping, o.measure, sums);
    } else {
        const NodeRows rows = node_rows(a, block);
        move_nodes(rows, o.dt);
        add_element_forces(grains, block, a.plan.prefetch.needed);
        integrate_nodes(rows, o.dt, o.damping, o.measure, sums);
    }
    if (!a.plan.shown_position.empty()) {
        show_positions(
            grains, grains.block_nodes[block], node_stride * group.nodes, a.plan.shown_position);
    }
    add_works(a.ledger, block, sums, o.measure);
}

/// Tiles of one thread.
struct TileRange {
    int first, end;
};

TileRange share_of(const Tiles& tiles, int thread, int threads)
{
    return { thread * tiles.count() / threads, (thread + 1) * tiles.count() / threads };
}

/// Update the contacts of a thread and the grains that only these contacts touch.
void update_own_tiles(Assembly& a, TileRange own, const StepOptions& options)
{
    const Tiles& tiles = a.plan.tiles;
    for (int tile = own.first; tile < own.end; ++tile) {
        const int first = tile * tile_length;
        update_contact_blocks(
            a, first, std::min(first + tile_length, a.contacts.blocks()), options.dt);
        for (int block : tiles.grain_blocks[tile])
            if (tiles.first[block] >= own.first) update_grain_block(a, block, options);
    }
}

/// Update the grains that contacts of an earlier thread touch, too.
void update_shared_grains(Assembly& a, TileRange own, const StepOptions& options)
{
    const Tiles& tiles = a.plan.tiles;
    for (int tile = own.first; tile < own.end; ++tile) {
        for (int block : tiles.grain_blocks[tile])
            if (tiles.first[block] < own.first) update_grain_block(a, block, options);
    }
}

/// Press the loaded edges and push the plates, which are few; book what erased grains leave for
/// this step.
void update_boundary(Assembly& a, const StepOptions& options)
{
    a.ledger.erased += a.ledger.erased_next;
    a.ledger.erased_next = 0.0;
    for (int b = 0; b < a.facets.blocks(); ++b)
        a.ledger.pressure_work += update_facet_block(a, b, options.dt);
    if (options.outer != nullptr) a.ledger.pressure_work += work_of(a, *options.outer, options.dt);
    update_plates(a, options.dt, options.damping);
}

/// Do one thread's part of a step.
void update_share(Assembly& a, const StepOptions& options, ThreadTeam& team, int thread)
{
    const int blocks = a.grains.blocks(), threads = team.size();
    for (int b = thread * blocks / threads; b < (thread + 1) * blocks / threads; ++b)
        predict_centres(a.grains, b, options.dt, a.plan.next_centre);
    if (thread == 0) update_boundary(a, options);
    team.meet();
    const TileRange own = share_of(a.plan.tiles, thread, threads);
    update_own_tiles(a, own, options);
    team.meet();
    update_shared_grains(a, own, options);
}

void check(const StepOptions& o)
{
    check_positive("time step", o.dt, "s");
    check_damping(o.damping);
    if (o.threads < 1) refuse("threads", o.threads, "", "must be at least 1");
}

}  // namespace

void show_positions(Assembly& a)
{
    a.plan.shown_position.resize(a.grains.reference.size());
    show_positions(a.grains, 0, static_cast<int>(a.grains.reference.size()), a.plan.shown_position);
}

void step(Assembly& a, const StepOptions& options)
{
    check(options);
    if (options.outer != nullptr) check(a, *options.outer);
    if (a.plan.tiles.count() == 0) {
        refuse("tiles of a step", 0.0, "", "must be at least 1; call prepare_step() after loading");
    }
    ThreadTeam& team = team_of(options.threads);
    const ThreadTeam::Work share = [&](int thread) { update_share(a, options, team, thread); };
    team.run(share);
    update_node_sets(a, options.dt, options.damping);  // which are few
    hold_edges(a, options.dt);                         // likewise
    ++a.step;
}

}  // namespace flexpm
