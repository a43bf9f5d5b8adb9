// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Checks of each sphere by itself, and a sweep along x for spheres in one place.
#include <flexpm/kernel/space/sphere_checks.hpp>

#include <algorithm>
#include <numeric>
#include <string>

namespace flexpm {
namespace {

/// Distance over the mean diameter below which two centres are in one place.
constexpr double one_place = 1e-6;
/// Spheres that a message names by their numbers.
constexpr std::size_t most_named = 20;

void require_sound(const Sphere& sphere, const Solid& solid, const std::string& name)
{
    if (!is_finite(sphere.centre)) {
        refuse(name + ": centre", place(sphere.centre), "must be finite; give finite coordinates");
    }
    if (!(std::isfinite(sphere.radius) && sphere.radius > 0.0)) {
        refuse(name + ": radius", sphere.radius, "m",
            "must be finite and > 0; remove or correct the sphere");
    }
    // the square of a larger radius leaves no digits for places inside, a smaller one none between
    // centres
    const double size = 0.5 * norm(solid.high - solid.low);
    if (sphere.radius > 1e3 * size || sphere.radius < 1e-6 * size) {
        refuse(name + ": radius", sphere.radius, "m",
            "must be 1e-6 to 1000 times the outline's; correct the sphere");
    }
    if (!(distance_inside(solid, sphere.centre) > 0.0)) {
        refuse(name + ": centre", place(sphere.centre),
            "must lie inside the outline; move or remove it");
    }
}

void require_apart(const std::vector<Sphere>& spheres)
{
    const double least = one_place * mean_diameter(spheres);
    std::vector<int> order(spheres.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
        [&](int i, int j) { return spheres[i].centre.x < spheres[j].centre.x; });
    for (std::size_t k = 0; k < order.size(); ++k)
        for (std::size_t l = k + 1; l < order.size(); ++l) {
            const int i = std::min(order[k], order[l]), j = std::max(order[k], order[l]);
            const Vector apart = spheres[j].centre - spheres[i].centre;
            if (std::abs(apart.x) > least) break;
            if (norm(apart) > least) continue;
            refuse("polyhedra: sphere " + std::to_string(j) + ": centre", place(spheres[j].centre),
                "must not be that of sphere " + std::to_string(i) + "; move or remove one");
        }
}

}  // namespace

double mean_diameter(const std::vector<Sphere>& spheres)
{
    double sum = 0.0;
    for (const Sphere& s : spheres)
        sum += 2.0 * s.radius;
    return sum / static_cast<double>(spheres.size());
}

void require_spheres_inside(const std::vector<Sphere>& spheres, const Solid& solid)
{
    if (spheres.empty()) {
        refuse("polyhedra: spheres", 0.0, "", "must be >= 1; give at least one sphere");
    }
    for (std::size_t i = 0; i < spheres.size(); ++i)
        require_sound(spheres[i], solid, "polyhedra: sphere " + std::to_string(i));
    require_apart(spheres);
}

void refuse_hidden(const std::vector<Sphere>& spheres, const std::vector<int>& hidden)
{
    if (hidden.empty()) return;
    std::string numbers;
    for (std::size_t k = 0; k < std::min(hidden.size(), most_named); ++k)
        numbers += (k > 0 ? ", " : "") + std::to_string(hidden[k]);
    refuse("polyhedra: hidden spheres",
        std::to_string(hidden.size()) + " (" + numbers + (hidden.size() > most_named ? ", ..." : "")
            + ")",
        "must have a cell, the first at " + place(spheres[hidden.front()].centre)
            + "; remove, move or drop them");
}

}  // namespace flexpm
