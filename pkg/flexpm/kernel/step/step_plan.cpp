// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/step/step_plan.hpp>

#include <flexpm/kernel/plane_lanes/nodal_forces.hpp>
#include <flexpm/kernel/plane_lanes/prefetch.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/tiles.hpp>

#include <algorithm>
#include <numeric>

namespace flexpm {

namespace {

/// Whether the points of a contact lie at the ends and in the middle of an edge that both grains
/// share as a whole.
bool is_between_whole_edges(const Contacts& contacts, int contact)
{
    for (int p = 0; p < 3; ++p) {
        for (int side = 0; side < 2; ++side)
            if (contacts.weight(contact, p, side) != 0.5 * p) return false;
        if (contacts.paired_slip(contact, p) != 0.0) return false;
    }
    return contacts.area(contact, 0) == contacts.area(contact, 2)
        && contacts.inverse_edge_length(contact, 0) == contacts.inverse_edge_length(contact, 1);
}

std::vector<std::uint8_t> find_whole_edges(const Contacts& contacts)
{
    std::vector<std::uint8_t> whole(contacts.blocks(), 0);
    for (int b = 0; b < contacts.blocks(); ++b) {
        whole[b] = contacts.points_in(b) == 3;
        for (int c = b * lanes; c < (b + 1) * lanes && whole[b]; ++c)
            whole[b] = is_between_whole_edges(contacts, c);
    }
    return whole;
}

std::vector<int> sort_by_id(const Contacts& contacts)
{
    std::vector<int> order(contacts.count);
    std::iota(order.begin(), order.end(), 0);
    std::sort(
        order.begin(), order.end(), [&](int i, int j) { return contacts.id[i] < contacts.id[j]; });
    return order;
}

}  // namespace

void prepare_step(Assembly& a)
{
    StepPlan& plan = a.plan;
    plan.sources = find_sources(a.grains, a.contacts, a.facets);
    plan.tiles = make_tiles(a.grains, a.contacts);
    plan.prefetch = list_prefetches(a.grains, a.contacts);
    plan.whole_edges = find_whole_edges(a.contacts);
    plan.contacts_by_id = sort_by_id(a.contacts);
    if (plan.element_bound.empty()) plan.element_bound = element_bound(a.grains);
    plan.next_centre.resize(static_cast<std::size_t>(dimension * lanes) * a.grains.blocks());
}

}  // namespace flexpm
