// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/one_sided_points.hpp>

#include <flexpm/kernel/forces/plate_contact.hpp>

namespace flexpm {

namespace {

/// The way [m] of a plate's point, of displacements.
Point way_of(const Assembly& a, const PlatePoint& p, const Array<double>& moved)
{
    return vector_on_edge(moved, a.facets.nodes(p.facet), p.weight);
}

void add(Array<double>& to, int node, Point force)
{
    set_vector(to, node, vector_at(to, node) + force);
}

}  // namespace

Closed OneSidedPoints::closed(
    const Array<double>& moved, const std::vector<PlateWay>& plates, double size) const
{
    Closed found;
    const double none = no_gap * size;
    found.contacts.assign(static_cast<std::size_t>(a.contacts.count) * points, 0);
    for_each_point([&](int c, int p) {
        const double gap = gap_of(a.contacts, c, p)
            + dot(bonded_normal(a, c), relative_velocity(a.contacts, c, p, moved));
        found.contacts[c * points + p] = gap <= none || damage_of(a.contacts, c, p) <= 0.0;
    });
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        const Plate& plate = a.plates[i];
        found.plates.emplace_back();
        for (int k = 0; k < plate_points(plate); ++k) {
            const bool shut = gap(i, k, moved, plates[i]) <= none;
            found.plates.back().push_back(plate.bonded || (shut && !is_idle(plate)));
        }
    }
    return found;
}

double OneSidedPoints::gap(
    std::size_t i, int k, const Array<double>& moved, const PlateWay& own) const
{
    const Plate& plate = a.plates[i];
    const Vector way = way_of(a, plate_point(plate, k), moved) - own.at(plate, k);
    return plate.opening[k] + dot(point_normal(plate, k), way);
}

PointSprings OneSidedPoints::springs(const Closed& now, double kept) const
{
    PointSprings found(now.contacts.size());
    for_each_point([&](int c, int p) { found[c * points + p] = spring(now, c, p, kept); });
    return found;
}

void OneSidedPoints::loosen_plates(const Closed& now, double kept, Assembly& trial) const
{
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        for (std::size_t k = 0; k < now.plates[i].size(); ++k) {
            trial.plates[i].area[k] = (now.plates[i][k] ? 1.0 : kept) * a.plates[i].area[k];
        }
    }
}

Array<double> OneSidedPoints::forces(const Closed& now, const Assembly& trial) const
{
    Array<double> found = a.grains.force;
    for_each_point([&](int c, int p) {
        const PointTraction before = traction_of(a.contacts, c, p);
        const Point n = bonded_normal(a, c);
        const PointTraction after = traction(now, c, p, {});
        const Point more =
            (after.normal - before.normal) * n + (after.shear - before.shear) * tangent_of(n);
        for (int side = 0; side < 2; ++side) {
            const double w = a.contacts.weight(c, p, side), sign = side == 0 ? 1.0 : -1.0;
            const double area = sign * a.contacts.area(c, p);
            add(found, a.contacts.node(c, side, 0), (1.0 - w) * area * more);
            add(found, a.contacts.node(c, side, 1), w * area * more);
        }
    });
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        for (int k = 0; k < plate_points(a.plates[i]); ++k) {
            const PlatePoint p = plate_point(a.plates[i], k);
            const Point more =
                in_plane(point_force(now, trial, i, k, {}) - flexpm::point_force(a.plates[i], k));
            const auto n = a.facets.nodes(p.facet);
            add(found, n[0], (1.0 - p.weight) * more);
            add(found, n[1], p.weight * more);
        }
    }
    return found;
}

PointTraction OneSidedPoints::traction(const Closed& now, int c, int p, Point way) const
{
    const PointSpring k = spring(now, c, p, 0.0);
    const Point n = bonded_normal(a, c);
    const double shear = a.contacts.point_state(c, p).shear_traction;
    return { k.normal * (gap_of(a.contacts, c, p) + dot(n, way)),
        (k.shear == 0.0 ? 0.0 : shear) + k.shear * dot(tangent_of(n), way) };
}

PointSpring OneSidedPoints::spring(const Closed& now, int c, int p, double kept) const
{
    const LawParameters& law = a.contacts.law_of(c);
    const double damage = damage_of(a.contacts, c, p);
    const bool shut = now.contacts[c * points + p];
    if (damage <= 0.0) return { law.normal_stiffness, law.shear_stiffness };
    if (damage < 1.0) {
        const double open = law::secant(law, a.contacts.point_state(c, p).max_opening, damage);
        return { shut ? law.normal_stiffness : open, law.shear_stiffness };
    }
    if (!shut) return { kept * law.normal_stiffness, kept * law.shear_stiffness };
    return { law.normal_stiffness, (law.friction > 0.0 ? 1.0 : kept) * law.shear_stiffness };
}

Vector OneSidedPoints::point_force(
    const Closed& now, const Assembly& trial, std::size_t i, int k, Vector way) const
{
    const Plate& plate = a.plates[i];
    const PlatePoint p = plate_point(trial.plates[i], k);
    const Vector normal = point_normal(plate, k), t = tangent_of(in_plane(normal));
    // the little that an open one keeps holds what would float; it must not pull across a wide gap
    const double gap = now.plates[i][k] ? plate.opening[k] : 0.0;
    const double shear = now.plates[i][k] ? plate.shear_force[k] : 0.0;
    return -p.stiffness * (gap + dot(normal, way)) * normal
        + (shear - p.shear_stiffness * dot(t, way)) * t;
}

PlatePush OneSidedPoints::plate_push(const Closed& now, const Assembly& trial, std::size_t i,
    const Array<double>& moved, const PlateWay& own) const
{
    const Plate& plate = a.plates[i];
    PlatePush sum;
    for (int k = 0; k < plate_points(plate); ++k) {
        const Vector way = way_of(a, plate_point(plate, k), moved) - own.at(plate, k);
        const Vector force = point_force(now, trial, i, k, way);
        sum.force = sum.force + force;
        sum.moment += point_arm(plate, k) * dot(force, point_normal(plate, k));
    }
    return sum;
}

}  // namespace flexpm
