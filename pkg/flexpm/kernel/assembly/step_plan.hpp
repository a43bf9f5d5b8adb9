// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a step derives from the saved state, for speed. prepare_step() builds it after an
/// assembly was made or loaded and after contacts or facets have changed; no step builds any of it.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/lists.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// A force and the node that it acts on.
struct ForceSource {
    int force;  ///< index of its x component in Contacts::forces or Facets::forces
    int node;   ///< offset of the node from the first of its block of grains
};

/// Forces on the nodes of each block of grains. A node sums its contacts in their order, then its
/// facets.
struct ForceSources {
    /// Contacts::force_index() of the first two contacts of each node, or Contacts::no_force(),
    /// laid out [block][node][first, second][lane].
    std::vector<int> pairs;
    Lists<ForceSource> contacts;  ///< of each block: all further contacts
    Lists<ForceSource> facets;    ///< of each block
};

/// Order of a step: contacts tile by tile, each followed by the grains that have no contact left.
/// What contacts read and write is then still in a cache when the grains follow.
struct Tiles {
    Lists<int> grain_blocks;  ///< of each tile: blocks of grains that have their last contact in it
    std::vector<int> first;   ///< tile of the first contact of each block of grains

    int count() const { return grain_blocks.count(); }
};

/// Rows of `lanes` values to ask for before a block of contacts gathers from them, unless a block
/// shortly before has.
struct PrefetchLists {
    bool needed = false;  ///< the arrays of a step exceed the caches; otherwise the lists are empty
    Lists<int> nodes;     ///< of each block of contacts: rows of x in Grains::velocity
    Lists<int> centres;   ///< of each block of contacts: rows in StepPlan::next_centre
};

struct StepPlan {
    ForceSources sources;
    Tiles tiles;
    PrefetchLists prefetch;

    /// 1 where all contacts of a block lie between whole edges that both grains share, with points
    /// at the ends and in the middle: weights 0, 1/2, 1, one inverse edge length for both, equal
    /// end areas, as they were bonded.
    std::vector<std::uint8_t> whole_edges;

    std::vector<int> contacts_by_id;  ///< places of the contacts in the order of their Contacts::id

    /// What elements add to StiffnessBound::node [N/m]; empty until prepare_step() finds it, and
    /// again once a grain is taken out.
    Array<double> element_bound;

    /// Displacement of the centres at the end of the step, [block][lane][component]; each step
    /// fills it.
    Array<double> next_centre;

    /// Current positions of nodes [m]; empty until a script asks for them, then kept up to date by
    /// each step.
    Array<double> shown_position;
};

}  // namespace flexpm
