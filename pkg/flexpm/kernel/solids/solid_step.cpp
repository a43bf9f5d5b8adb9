// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_step.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/core/thread_team.hpp>
#include <flexpm/kernel/motion/central_difference.hpp>
#include <flexpm/kernel/solids/face_forces.hpp>
#include <flexpm/kernel/solids/rows_of_four.hpp>
#include <flexpm/kernel/solids/solid_bodies.hpp>
#include <flexpm/kernel/solids/solid_plates.hpp>
#include <flexpm/kernel/solids/solid_pressure.hpp>
#include <flexpm/kernel/solids/tetrahedron_forces.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step_works.hpp>

#include <algorithm>
#include <atomic>

namespace flexpm {

namespace {

constexpr int node_values = space_layout.node_stride;

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

/// The rows of nodes of one block, two in each row of lanes.
struct PairRows {
    int pairs;
    double* displacement;
    double* velocity;
    const double* undamped;
    double* force;
    const std::uint8_t* prescribed;
    const double* inverse_mass;  ///< of nodes
};

PairRows pair_rows(SolidState& s, int block)
{
    Grains& grains = s.grains;
    const int first = grains.block_nodes[block];
    return { (grains.group(block).nodes + 1) / 2, grains.displacement.data() + first,
        grains.velocity.data() + first, s.undamped().velocity.data() + first,
        grains.force.data() + first, grains.prescribed.data() + first,
        grains.inverse_mass.data() + grains.scalar_index(first) };
}

FLEXPM_INLINE void move_pairs(const PairRows& b, double dt)
{
    for (int i = 0; i < b.pairs * lanes; ++i)
        b.displacement[i] += dt * b.velocity[i];
}

/// The force on each node: contacts in the order of their blocks.
FLEXPM_INLINE void sum_sources(
    const int* first, const int* sources, const double* forces, const PairRows& b)
{
    for (int n = 0; n < 2 * b.pairs; ++n) {
        Four sum {};
        for (int i = first[n]; i < first[n + 1]; ++i)
            sum += row_of_four(forces + sources[i]);
        row_of_four(b.force + n * node_values) = sum;
    }
}

template <bool Measure, bool Prescribed>
FLEXPM_INLINE void integrate_lanes(const PairRows& b, double dt, double damping, StepSums& total)
{
    StepSums sums;
    for (int pair = 0; pair < b.pairs; ++pair) {
        const int row = pair * lanes;
        const double *f = b.force + row, *undamped = b.undamped + row;
        double* v = b.velocity + row;
        alignas(64) double mass[lanes], prescribed[lanes] = {};
        for (int node = 0; node < 2; ++node)
            std::fill_n(mass + node * node_values, node_values, b.inverse_mass[2 * pair + node]);
        if (Prescribed) std::copy_n(b.prescribed + row, lanes, prescribed);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            integrate_one<Measure, Prescribed>(
                { f[l], mass[l], prescribed[l], undamped[l] }, dt, damping, v[l], sums, l);
        }
    }
    sums.copy_to(total);
}

template <bool Measure>
FLEXPM_INLINE void integrate_pairs(const PairRows& b, double dt, double damping, StepSums& sums)
{
    const bool any = std::any_of(
        b.prescribed, b.prescribed + b.pairs * lanes, [](std::uint8_t p) { return p != 0; });
    if (any) {
        integrate_lanes<Measure, true>(b, dt, damping, sums);
    } else {
        integrate_lanes<Measure, false>(b, dt, damping, sums);
    }
}

/// Move a thread's grains to the end of the step.
void move_grains(SolidState& s, TileRange own, double dt)
{
    const auto move = variant_of<move_pairs>();
    for (int tile = own.first; tile < own.end; ++tile)
        for_each_block(s, tile, [&](int block) {
            if (s.grains.group(block).rigid) {
                move_body(s, block, dt);
            } else {
                move(pair_rows(s, block), dt);
            }
        });
}

/// Forces of contacts, plates and pressures on a block of grains.
void sum_outer_forces(SolidState& s, int block, const PairRows& rows)
{
    const int node = s.grains.scalar_index(s.grains.block_nodes[block]);
    variant_of<sum_sources>()(
        s.plan.first.data() + node, s.plan.sources.data(), s.contacts.forces.data(), rows);
    if (!s.plan.first_press.empty()) add_plate_forces(s, block);
    if (!s.plan.first_pressed.empty()) add_pressure_forces(s, block);
}

/// Sum the forces on a block of grains and integrate its velocities.
void update_grains(SolidState& s, int block, const StepOptions& o)
{
    const PairRows rows = pair_rows(s, block);
    sum_outer_forces(s, block, rows);
    StepSums sums;
    if (s.grains.group(block).rigid) {
        integrate_body(s, block, o, sums);
    } else {
        add_tetrahedron_forces(s, block);
        const auto integrate =
            o.measure ? variant_of<integrate_pairs<true>>() : variant_of<integrate_pairs<false>>();
        integrate(rows, o.dt, o.damping, sums);
    }
    add_works(s.ledger, block, sums, o.measure);
}

/// Update a thread's contacts and the grains that only these touch. Returns the number of contacts
/// without a middle face.
int update_own_tiles(SolidState& s, TileRange own, const StepOptions& o)
{
    int turned = 0;
    for (int tile = own.first; tile < own.end; ++tile) {
        turned += update_face_blocks(s, s.plan.tile_contacts[tile], s.plan.tile_contacts[tile + 1]);
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

void check(const StepOptions& o)
{
    check_positive("time step", o.dt, "s");
    check_damping(o.damping);
    if (o.threads < 1) refuse("threads", o.threads, "", "must be at least 1");
}

/// Sources of the forces on all nodes.
void find_sources(SolidState& s)
{
    const FaceContacts& c = s.contacts;
    const Layout& layout = s.grains.layout;
    std::vector<std::vector<int>> sources(s.grains.inverse_mass.size());
    for (int block = 0; block < c.blocks(); ++block) {
        for (int i = c.block_nodes[block]; i < c.block_nodes[block + 1]; ++i) {
            const int lane = (i - c.block_nodes[block]) % lanes;
            if (c.in_slot[block * lanes + lane] < 0) continue;
            sources[layout.scalar_index(c.nodes[i])].push_back(i * node_values);
        }
    }
    s.plan.first = { 0 };
    s.plan.sources.clear();
    for (const auto& of_node : sources) {
        s.plan.sources.insert(s.plan.sources.end(), of_node.begin(), of_node.end());
        s.plan.first.push_back(static_cast<int>(s.plan.sources.size()));
    }
}

void find_tiles(SolidState& s)
{
    const FaceContacts& c = s.contacts;
    const int tiles = (s.grains.blocks() + tile_grains - 1) / tile_grains;
    s.plan.tile_contacts.assign(tiles + 1, 0);
    s.plan.first_tile.resize(s.grains.blocks());
    for (int block = 0; block < s.grains.blocks(); ++block)
        s.plan.first_tile[block] = block / tile_grains;
    for (int contact = 0; contact < c.count; ++contact) {
        const int tile = tile_of(s, contact);
        int& end = s.plan.tile_contacts[tile + 1];
        end = std::max(end, c.block_of(contact) + 1);
        for (int grain : c.pairs[contact]) {
            int& first = s.plan.first_tile[s.grains.block_of(grain)];
            first = std::min(first, tile);
        }
    }
    // a tile without contacts ends where the one before does
    for (int tile = 0; tile < tiles; ++tile)
        s.plan.tile_contacts[tile + 1] =
            std::max(s.plan.tile_contacts[tile + 1], s.plan.tile_contacts[tile]);
}

/// Contacts of plates on each block of grains.
void find_presses(SolidState& s)
{
    std::vector<std::vector<PlateTouch>> of_block(s.grains.blocks());
    for (std::size_t p = 0; p < s.plates.size(); ++p) {
        for (std::size_t i = 0; i < s.plates[p].facets.size(); ++i) {
            const int grain = s.surface.grain[s.plates[p].facets[i]];
            of_block[s.grains.block_of(grain)].push_back(
                { static_cast<int>(p), static_cast<int>(i) });
        }
    }
    s.plan.first_press.clear();
    s.plan.presses.clear();
    if (s.plates.empty()) return;
    for (const auto& touches : of_block) {
        s.plan.first_press.push_back(static_cast<int>(s.plan.presses.size()));
        s.plan.presses.insert(s.plan.presses.end(), touches.begin(), touches.end());
    }
    s.plan.first_press.push_back(static_cast<int>(s.plan.presses.size()));
}

/// Surface triangles of each block of grains, if pressures act on them.
void find_pressed(SolidState& s)
{
    SolidPlan& plan = s.plan;
    plan.first_pressed.clear();
    plan.pressed.clear();
    plan.pressure_works.assign(s.surface.pressure.size(), 0.0);
    if (s.surface.pressure.empty()) return;
    std::vector<std::vector<int>> of_block(s.grains.blocks());
    for (std::size_t t = 0; t < s.surface.pressure.size(); ++t)
        of_block[s.grains.block_of(s.surface.grain[t])].push_back(static_cast<int>(t));
    for (const auto& triangles : of_block) {
        plan.first_pressed.push_back(static_cast<int>(plan.pressed.size()));
        plan.pressed.insert(plan.pressed.end(), triangles.begin(), triangles.end());
    }
    plan.first_pressed.push_back(static_cast<int>(plan.pressed.size()));
}

}  // namespace

int tile_of(const SolidState& s, int contact)
{
    const auto [a, b] = s.contacts.pairs[contact];
    return std::min(s.grains.block_of(a), s.grains.block_of(b)) / tile_grains;
}

void prepare_step(SolidState& s)
{
    find_sources(s);
    find_tiles(s);
    find_presses(s);
    find_pressed(s);
}

void find_forces(SolidState& s)
{
    if (update_face_blocks(s, 0, s.contacts.blocks()) > 0) {
        refuse("contacts without a middle face", 1.0, "",
            "must be 0; the sides of each contact must lie opposite to each other");
    }
    for (int block = 0; block < s.grains.blocks(); ++block) {
        sum_outer_forces(s, block, pair_rows(s, block));
        if (!s.grains.group(block).rigid) add_tetrahedron_forces(s, block);
    }
    sum_plates(s, 0.0);
}

void step(SolidState& s, const StepOptions& options)
{
    check(options);
    if (s.plan.tile_contacts.empty()) {
        refuse("tiles of a step", 0.0, "", "must be at least 1; call prepare_step() after loading");
    }
    ThreadTeam& team = team_of(options.threads);
    std::atomic<int> turned { 0 };
    for (Plate& plate : s.plates)
        plate.displacement = plate.displacement + options.dt * plate.velocity;
    const ThreadTeam::Work share = [&](int thread) {
        const TileRange own = share_of(s.plan, thread, team.size());
        move_grains(s, own, options.dt);
        team.meet();
        turned += update_own_tiles(s, own, options);
        team.meet();
        update_shared_grains(s, own, options);
    };
    team.run(share);
    sum_plates(s, options.dt);
    sum_pressure_work(s);
    ++s.step;
    if (turned > 0) {
        fail("step " + std::to_string(s.step) + ": contacts without a middle face",
            std::to_string(turned), "must be 0; load more slowly, or end the test earlier");
    }
}

}  // namespace flexpm
