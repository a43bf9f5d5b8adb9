// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/floating_sets.hpp>

namespace flexpm {

namespace {

/// Call visit(unknown of a node, unknown of its group), both offsets, for each that floats.
template <class Visit>
void for_each_floating(const std::vector<FloatingNodes>& groups, std::size_t unknowns, Visit visit)
{
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (int triple : groups[g].triples)
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (groups[g].axes[axis])
                    visit(3 * static_cast<std::size_t>(triple) + axis, unknowns + 3 * g + axis);
}

}  // namespace

FloatingForces::FloatingForces(
    const LinearForces& structure, std::size_t unknowns, const std::vector<FloatingNodes>& groups) :
    structure_(structure),
    unknowns_(unknowns),
    groups_(groups)
{
}

void FloatingForces::add(const double* u, double* forces) const
{
    std::vector<double> moved(u, u + unknowns_), on(unknowns_, 0.0);
    for_each_floating(
        groups_, unknowns_, [&](std::size_t node, std::size_t group) { moved[node] += u[group]; });
    structure_.add(moved.data(), on.data());
    for (std::size_t i = 0; i < unknowns_; ++i)
        forces[i] += on[i];
    for_each_floating(groups_, unknowns_,
        [&](std::size_t node, std::size_t group) { forces[group] += on[node]; });
}

DiagonalBlocks FloatingForces::diagonal_blocks() const
{
    DiagonalBlocks blocks = structure_.diagonal_blocks();
    const std::size_t size = unknowns_ + 3 * groups_.size();
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        Vector columns[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<double> way(size, 0.0), forces(size, 0.0);
            way[unknowns_ + 3 * g + axis] = 1.0;
            add(way.data(), forces.data());
            const double* on = forces.data() + unknowns_ + 3 * g;
            columns[axis] = { on[0], on[1], on[2] };
        }
        blocks.append({ columns[0], columns[1], columns[2] });
    }
    return blocks;
}

FreeSolution solve_floating(const LinearForces& structure, const std::vector<FloatingNodes>& groups,
    std::vector<std::uint8_t> held, std::vector<double> load, std::vector<double> guess)
{
    if (groups.empty()) return solve_free(structure, held, std::move(load), guess);
    const std::size_t unknowns = held.size();
    held.resize(unknowns + 3 * groups.size(), 0);
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t axis = 0; axis < 3; ++axis)
            held[unknowns + 3 * g + axis] = groups[g].axes[axis] ? 0 : 1;
    load.resize(held.size(), 0.0);
    guess.resize(held.size(), 0.0);
    for_each_floating(
        groups, unknowns, [&](std::size_t node, std::size_t group) { load[group] += load[node]; });
    FreeSolution found =
        solve_free(FloatingForces(structure, unknowns, groups), held, std::move(load), guess);
    for_each_floating(groups, unknowns,
        [&](std::size_t node, std::size_t group) { found.u[node] += found.u[group]; });
    return found;
}

}  // namespace flexpm
