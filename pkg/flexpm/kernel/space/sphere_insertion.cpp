// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Trials of random places until one is free; cubic bins hold the spheres near it.
#include <flexpm/kernel/space/sphere_insertion.hpp>

#include <flexpm/kernel/core/random.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace flexpm {
namespace {

constexpr int most_tries = 10000;

/// Cubic bins of one largest diameter: a sphere can only touch spheres of the 27 bins around it.
class Bins {
public:
    Bins(const Solid& solid, double largest_radius) : low(solid.low), size(2.0 * largest_radius)
    {
        const Vector extent = solid.high - solid.low;
        counts = { bins_along(extent.x), bins_along(extent.y), bins_along(extent.z) };
        spheres.resize(static_cast<std::size_t>(counts[0]) * counts[1] * counts[2]);
    }

    void add(const Sphere& s) { spheres[index(bin_of(s.centre))].push_back(s); }

    bool is_free(const Sphere& s) const
    {
        const auto [i0, j0, k0] = bin_of(s.centre);
        for (int k = std::max(k0 - 1, 0); k <= std::min(k0 + 1, counts[2] - 1); ++k)
            for (int j = std::max(j0 - 1, 0); j <= std::min(j0 + 1, counts[1] - 1); ++j)
                for (int i = std::max(i0 - 1, 0); i <= std::min(i0 + 1, counts[0] - 1); ++i)
                    for (const Sphere& t : spheres[index({ i, j, k })])
                        if (norm(t.centre - s.centre) < t.radius + s.radius) return false;
        return true;
    }

private:
    using Bin = std::array<int, 3>;

    Vector low;
    double size;
    Bin counts {};
    std::vector<std::vector<Sphere>> spheres;

    int bins_along(double extent) const { return static_cast<int>(extent / size) + 1; }

    Bin bin_of(Vector p) const
    {
        const Vector at = (1.0 / size) * (p - low);
        return { std::clamp(static_cast<int>(at.x), 0, counts[0] - 1),
            std::clamp(static_cast<int>(at.y), 0, counts[1] - 1),
            std::clamp(static_cast<int>(at.z), 0, counts[2] - 1) };
    }

    std::size_t index(const Bin& bin) const
    {
        return (static_cast<std::size_t>(bin[2]) * counts[1] + bin[1]) * counts[0] + bin[0];
    }
};

}  // namespace

std::vector<Vector> insert_spheres(
    const std::vector<double>& radii, const Solid& solid, double shrink, std::uint64_t seed)
{
    if (radii.empty()) return {};
    std::vector<int> order(radii.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return radii[i] > radii[j]; });

    Bins bins(solid, shrink * radii[order[0]]);
    Random random(seed);
    const Vector extent = solid.high - solid.low;
    std::vector<Vector> centres(radii.size());
    for (int i : order) {
        Sphere s { {}, shrink * radii[i] };
        int tries = 0;
        do {
            if (++tries > most_tries) {
                refuse("insert_spheres: radius", radii[i], "m",
                    "must fit into the outline beside the other spheres; choose smaller or fewer "
                    "spheres");
            }
            s.centre.x = solid.low.x + extent.x * random.next();
            s.centre.y = solid.low.y + extent.y * random.next();
            s.centre.z = solid.low.z + extent.z * random.next();
        } while (distance_inside(solid, s.centre) < s.radius || !bins.is_free(s));
        bins.add(s);
        centres[i] = s.centre;
    }
    return centres;
}

}  // namespace flexpm
