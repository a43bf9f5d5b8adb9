// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/loose_groups.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// The group whose discs have the largest area, or whose spheres have the largest volume.
int largest_group(const Grains& grains, Groups& groups)
{
    std::vector<double> size(grains.count, 0.0);
    for (int g = 0; g < grains.count; ++g) {
        if (!grains.erased[g])
            size[groups.of(g)] += std::pow(grains.radius[g], grains.layout.dimension);
    }
    return static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
}

}  // namespace

void mark_loose(Grains& grains, Groups& groups, const std::vector<std::uint8_t>& held)
{
    std::vector<std::uint8_t> stands(grains.count, 0);  // by group
    for (int g = 0; g < grains.count; ++g) {
        if (held[g]) stands[groups.of(g)] = 1;
    }
    if (std::find(stands.begin(), stands.end(), 1) == stands.end())
        stands[largest_group(grains, groups)] = 1;
    for (int g = 0; g < grains.count; ++g)
        grains.loose[g] = !grains.erased[g] && !stands[groups.of(g)];
}

bool loads_any(const std::vector<Plate>& plates)
{
    return std::any_of(plates.begin(), plates.end(), [](const Plate& p) { return p.loaded; });
}

void mark_touching(const std::vector<Plate>& plates, const std::vector<int>& grain_of,
    std::vector<std::uint8_t>& marked)
{
    for (const Plate& plate : plates) {
        if (plate.loaded) continue;
        for (const PlatePoint& point : plate.points) {
            if (point.area > 0.0 && (plate.bonded || point.opening <= 0.0))
                marked[grain_of[point.facet]] = 1;
        }
    }
}

bool bears_any(const Plate& plate, const std::vector<int>& grain_of, const Grains& grains)
{
    return std::any_of(plate.points.begin(), plate.points.end(),
        [&](const PlatePoint& point) { return !grains.loose[grain_of[point.facet]]; });
}

}  // namespace flexpm
