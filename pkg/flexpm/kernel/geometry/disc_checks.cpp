// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Checks of each disc by itself, and a sweep along x for discs in one place.
#include <flexpm/kernel/geometry/disc_checks.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace flexpm {

namespace {

void require_sound(const Disc& disc, const std::string& name)
{
    if (!is_finite(disc.centre)) {
        refuse(name + ": centre", place(disc.centre), "must be finite; give finite coordinates");
    }
    if (!(std::isfinite(disc.radius) && disc.radius > 0.0)) {
        refuse(name + ": radius", disc.radius, "m",
            "must be finite and > 0; remove or correct the disc");
    }
}

}  // namespace

void require_discs_inside(const std::vector<Disc>& discs, const Outline& outline)
{
    if (discs.empty()) refuse("tessellate: discs", 0.0, "", "must be >= 1; give at least one disc");
    // the square of a larger radius leaves no digits for places inside the outline, and centres
    // that a smaller one tells apart have too few digits between them
    const double size = bounding_circle(outline).radius;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& d = discs[i];
        const std::string name = "tessellate: disc " + std::to_string(i);
        require_sound(d, name);
        if (d.radius > 1e3 * size || d.radius < 1e-9 * size) {
            refuse(name + ": radius", d.radius, "m",
                "must be 1e-9 to 1000 times the outline's; correct the disc");
        }
        if (!contains(outline, d.centre)) {
            refuse(name + ": centre", place(d.centre),
                "must lie inside the outline; move or remove it");
        }
    }
}

void require_disc_of_each_cell(const Tessellation& tessellation, const std::vector<Disc>& discs)
{
    for (int disc : tessellation.disc_of_cell) {
        if (disc < 0 || disc >= static_cast<int>(discs.size())) {
            refuse("discs of the cells", static_cast<double>(discs.size()), "",
                "must include disc " + std::to_string(disc)
                    + "; give all discs of the tessellation");
        }
        require_sound(discs[disc], "disc " + std::to_string(disc));
    }
}

std::vector<bool> find_coincident(const std::vector<Disc>& discs)
{
    double tolerance = 0.0;
    for (const Disc& d : discs)
        tolerance += 1e-6 * 2.0 * d.radius / static_cast<double>(discs.size());
    std::vector<int> order(discs.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
        [&](int i, int j) { return discs[i].centre.x < discs[j].centre.x; });

    std::vector<bool> coincident(discs.size(), false);
    for (std::size_t k = 0; k < order.size(); ++k)
        for (std::size_t l = k + 1; l < order.size(); ++l) {
            const int i = std::min(order[k], order[l]), j = std::max(order[k], order[l]);
            const Point a = discs[i].centre, b = discs[j].centre;
            if (std::abs(b.x - a.x) > tolerance) break;
            if (std::abs(b.y - a.y) > tolerance) continue;
            coincident[discs[j].radius > discs[i].radius ? i : j] = true;
        }
    return coincident;
}

}  // namespace flexpm
