// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a step needs and a saved state does not hold.
#include <flexpm/kernel/step/step_plan.hpp>

#include <flexpm/kernel/forces/nodal_forces.hpp>
#include <flexpm/kernel/forces/prefetch.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/tiles.hpp>

namespace flexpm {

namespace {

bool between_whole_edges(const Assembly& a, int block)
{
    const int first = block * lanes;
    const double *w = a.weight.data() + 6 * first, *area = a.area.data() + 3 * first,
                 *reach = a.edge_reach.data() + 2 * first;
    for (int l = 0; l < lanes; ++l) {
        for (int p = 0; p < 3; ++p) {
            for (int side = 0; side < 2; ++side)
                if (w[(2 * p + side) * lanes + l] != 0.5 * p) return false;
        }
        if (area[l] != area[2 * lanes + l] || reach[l] != reach[lanes + l]) return false;
    }
    return true;
}

void find_whole_edges(Assembly& a)
{
    a.whole_edges.assign(a.contact_blocks(), 0);
    if (a.points != 3) return;
    for (int b = 0; b < a.contact_blocks(); ++b)
        a.whole_edges[b] = between_whole_edges(a, b);
}

}  // namespace

void prepare_step(Assembly& a)
{
    list_forces(a);
    sort_sources(a);
    list_chunks(a);
    list_fetches(a);
    find_whole_edges(a);
    if (a.element_bound.empty()) a.element_bound = element_bound(a);
}

}  // namespace flexpm
