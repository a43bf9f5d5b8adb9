// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/one_sided_points.hpp>

#include <flexpm/kernel/parts/plate_contact.hpp>

namespace flexpm {

namespace {

void add(Array<double>& to, int node, Point force)
{
    set_vector(to, node, vector_at(to, node) + force);
}

}  // namespace

OneSidedPoints::OneSidedPoints(const Assembly& a) :
    a(a),
    points(a.contacts.group.points),
    first_of_plate { a.contacts.count * points }
{
    for (const Plate& plate : a.plates)
        first_of_plate.push_back(first_of_plate.back() + plate_points(plate));
}

PointMarks OneSidedPoints::closed(
    const Array<double>& moved, const std::vector<PlateWay>& plates, double size) const
{
    PointMarks found(first_of_plate.back(), 0);
    const double none = no_gap * size;
    for_each_point([&](int c, int p) {
        const double gap = gap_of(a.contacts, c, p)
            + dot(bonded_normal(a, c), relative_velocity(a.contacts, c, p, moved));
        found[index_of(c, p)] = gap <= none || damage_of(a.contacts, c, p) <= 0.0;
    });
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        const Plate& plate = a.plates[i];
        for (int k = 0; k < plate_points(plate); ++k) {
            const bool shut = gap(i, k, moved, plates[i]) <= none;
            found[index_of_plate(i, k)] = plate.bonded || (shut && !is_idle(plate));
        }
    }
    return found;
}

std::vector<double> OneSidedPoints::sticking(
    const PointMarks& closed, const Array<double>& moved, const std::vector<PlateWay>& plates) const
{
    std::vector<double> found(closed.size(), 0.0);
    const double none = no_gap * a.grains.radius.front();
    const auto part = [&](double now, double then) {
        return now <= none ? 1.0 : then < 0.0 ? then / (then - now) : 0.0;
    };
    for_each_point([&](int c, int p) {
        if (!closed[index_of(c, p)] || !rubs(c, p)) return;
        const double now = gap_of(a.contacts, c, p);
        const Point way = relative_velocity(a.contacts, c, p, moved);
        found[index_of(c, p)] = part(now, now + dot(bonded_normal(a, c), way));
    });
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        const Plate& plate = a.plates[i];
        for (int k = 0; k < plate_points(plate); ++k) {
            if (!closed[index_of_plate(i, k)] || plate.friction <= 0.0) continue;
            const double now = plate.bonded ? 0.0 : plate.points[k].opening;
            found[index_of_plate(i, k)] = part(now, gap(i, k, moved, plates[i]));
        }
    }
    return found;
}

Vector OneSidedPoints::point_way(
    std::size_t i, int k, const Array<double>& moved, const PlateWay& own) const
{
    const Plate& plate = a.plates[i];
    const EdgePoint p = edge_point(plate, k);
    return vector_on_edge(moved, a.facets.nodes(p.facet), p.weight) - own.at(plate, k);
}

double OneSidedPoints::gap(
    std::size_t i, int k, const Array<double>& moved, const PlateWay& own) const
{
    const Plate& plate = a.plates[i];
    return plate.points[k].opening + dot(point_normal(plate, k), point_way(i, k, moved, own));
}

GivenSprings OneSidedPoints::springs(const Bearing& now) const
{
    GivenSprings found;
    found.contacts.resize(first_of_plate.front());
    for_each_point([&](int c, int p) { found.contacts[index_of(c, p)] = spring(now, c, p); });
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        found.plates.emplace_back();
        for (int k = 0; k < plate_points(a.plates[i]); ++k)
            found.plates.back().push_back(plate_spring(now, i, k));
    }
    return found;
}

Array<double> OneSidedPoints::more_force(
    const Bearing& now, const Array<double>& moved, const std::vector<PlateWay>& plates) const
{
    Array<double> found(moved.size(), 0.0);
    for_each_point([&](int c, int p) {
        const PointTraction before = traction_of(a.contacts, c, p);
        const Point n = bonded_normal(a, c);
        const PointTraction after = traction(now, c, p, relative_velocity(a.contacts, c, p, moved));
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
            const EdgePoint p = edge_point(a.plates[i], k);
            const Vector after = point_force(now, i, k, point_way(i, k, moved, plates[i]));
            const Point more = in_plane(after - flexpm::point_force(a.plates[i], k));
            const auto n = a.facets.nodes(p.facet);
            add(found, n[0], (1.0 - p.weight) * more);
            add(found, n[1], p.weight * more);
        }
    }
    return found;
}

PointTraction OneSidedPoints::traction(const Bearing& now, int c, int p, Point way) const
{
    const PointSpring k = spring(now, c, p);
    const Point n = bonded_normal(a, c);
    const double along = dot(n, way), across = dot(tangent_of(n), way);
    const double gap = gap_of(a.contacts, c, p),
                 shear = a.contacts.point_state(c, p).shear_traction;
    if (damage_of(a.contacts, c, p) < 1.0)
        return { k.normal * (gap + along), shear + k.shear * across };
    // what a point keeps holds what would float; it must not pull across a wide gap
    const int at = index_of(c, p);
    const double normal = a.contacts.law_of(c).normal_stiffness;
    return { (now.closed[at] ? normal * gap : 0.0) + k.normal * along,
        (now.sticks[at] > 0.0 ? shear : 0.0) + k.shear * across };
}

PointSpring OneSidedPoints::spring(const Bearing& now, int c, int p) const
{
    const LawParameters& law = a.contacts.law_of(c);
    const double damage = damage_of(a.contacts, c, p);
    const int at = index_of(c, p);
    const bool shut = now.closed[at];
    if (damage <= 0.0) return { law.normal_stiffness, law.shear_stiffness };
    if (damage < 1.0) {
        const double open = law::secant(law, a.contacts.point_state(c, p).max_opening, damage);
        return { shut ? law.normal_stiffness : open, law.shear_stiffness };
    }
    return { ((shut ? 1.0 : 0.0) + now.kept) * law.normal_stiffness,
        (now.sticks[at] + now.kept) * law.shear_stiffness };
}

PointSpring OneSidedPoints::plate_spring(const Bearing& now, std::size_t i, int k) const
{
    const EdgePoint p = edge_point(a.plates[i], k);
    return { ((now.closed[index_of_plate(i, k)] ? 1.0 : 0.0) + now.kept) * p.stiffness,
        (now.sticks[index_of_plate(i, k)] + now.kept) * p.shear_stiffness };
}

Vector OneSidedPoints::point_force(const Bearing& now, std::size_t i, int k, Vector way) const
{
    const Plate& plate = a.plates[i];
    const PointSpring spring = plate_spring(now, i, k);
    const Vector normal = point_normal(plate, k), t = tangent_of(in_plane(normal));
    const double stiffness = edge_point(plate, k).stiffness;
    const double pressed =
        now.closed[index_of_plate(i, k)] ? stiffness * plate.points[k].opening : 0.0;
    const double shear = now.sticks[index_of_plate(i, k)] > 0.0 ? plate.points[k].shear.x : 0.0;
    return -(pressed + spring.normal * dot(normal, way)) * normal
        + (shear - spring.shear * dot(t, way)) * t;
}

PlatePush OneSidedPoints::plate_push(
    const Bearing& now, std::size_t i, const Array<double>& moved, const PlateWay& own) const
{
    const Plate& plate = a.plates[i];
    PlatePush sum;
    for (int k = 0; k < plate_points(plate); ++k) {
        const Vector force = point_force(now, i, k, point_way(i, k, moved, own));
        sum.force = sum.force + force;
        sum.moment += point_arm(plate, k).z * dot(force, point_normal(plate, k));
    }
    return sum;
}

}  // namespace flexpm
