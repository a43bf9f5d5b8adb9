// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/read_state.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

namespace plain {

namespace {

using flexpm::Assembly;
using flexpm::vector_at;

/// Numbers of the nodes in the plain list by their offsets in the kernel's arrays.
using Numbers = std::map<int, int>;

Node read_node(const Assembly& a, int offset)
{
    const flexpm::Grains& grains = a.grains;
    Node n;
    n.reference = vector_at(grains.reference, offset);
    n.displacement = vector_at(grains.displacement, offset);
    n.velocity = vector_at(grains.velocity, offset);
    n.undamped_velocity = vector_at(a.undamped().velocity, offset);
    n.force = vector_at(grains.force, offset);
    n.held_x = grains.prescribed[flexpm::component(offset, 0)] != 0;
    n.held_y = grains.prescribed[flexpm::component(offset, 1)] != 0;
    n.inverse_mass = grains.inverse_mass[flexpm::scalar_index(offset)];
    return n;
}

void read_grain(const Assembly& a, int g, Specimen& s, Numbers& number)
{
    const flexpm::Grains& grains = a.grains;
    Grain grain;
    for (int n = 0; n < grains.nodes_of(g); ++n) {
        const int offset = grains.node(g, n);
        number[offset] = static_cast<int>(s.nodes.size());
        grain.nodes.push_back(number[offset]);
        s.nodes.push_back(read_node(a, offset));
    }
    grain.centre = number[grains.centre(g)];
    for (int t = 0; t < flexpm::triangles_of(grains, g); ++t) {
        std::array<int, 3> nodes = flexpm::triangle_nodes(grains, g, t);
        for (int& n : nodes)
            n = grain.nodes[n];
        grain.triangles.push_back(nodes);
    }
    grain.elastic = grains.elastic[grains.material[g]];
    if (grains.is_rigid(g)) {
        const int slot = grains.slot[g];
        grain.angle = flexpm::rotation_of(grains, g);
        grain.spin = grains.spin[slot];
        grain.undamped_spin = a.undamped().spin[slot];
        grain.spin_held = grains.spin_prescribed[slot] != 0;
        grain.inverse_inertia = grains.inverse_inertia[slot];
    }
    s.grains.push_back(grain);
}

Contact read_contact(const Assembly& a, int c, const Numbers& number)
{
    const flexpm::Contacts& contacts = a.contacts;
    Contact contact;
    contact.grains = contacts.pairs[c];
    for (int side = 0; side < 2; ++side) {
        for (int end = 0; end < 2; ++end)
            contact.edge[side][end] = number.at(contacts.node(c, side, end));
        contact.per_length[side] = contacts.inverse_edge_length(c, side);
    }
    const Point branch = contacts.branch(c);
    contact.across_edges = branch.x == 0.0 && branch.y == 0.0;
    contact.branch = branch;
    contact.normal = contacts.normal(c);
    contact.law = contacts.law_of(c);
    contact.active = flexpm::is_active(contacts, c);
    for (int p = 0; p < contacts.points_of(c); ++p) {
        ContactPoint point;
        point.weight[0] = contacts.weight(c, p, 0);
        point.weight[1] = contacts.weight(c, p, 1);
        point.area = contacts.area(c, p);
        point.state = contacts.point_state(c, p);
        point.paired_slip = contacts.paired_slip(c, p);
        point.crack_slip = contacts.crack_slip(c, p);
        const flexpm::PointCrack crack = contacts.crack(c, p);
        point.crack_step = crack.step;
        point.crack_mode = crack.mode;
        point.crack_place = crack.position;
        contact.points.push_back(point);
    }
    return contact;
}

Plate read_plate(const Assembly& a, std::size_t place, const Numbers& number)
{
    const flexpm::Plate& from = a.plates[place];
    Plate plate;
    plate.normal = in_plane(from.normal);
    plate.stiffness = from.stiffness;
    plate.shear_stiffness = from.shear_stiffness;
    plate.friction = from.friction;
    plate.bonded = from.bonded;
    plate.loaded = from.loaded;
    plate.load = from.load;
    plate.mass = from.mass;
    plate.displacement = in_plane(from.displacement);
    plate.velocity = in_plane(from.velocity);
    plate.undamped_velocity = in_plane(a.loading.of_plate(place).velocity);
    plate.force = in_plane(from.force);
    for (int i = 0; i < flexpm::plate_points(from); ++i) {
        const flexpm::PlatePoint& p = from.points[i];
        const auto nodes = a.facets.nodes(p.facet);
        plate.points.push_back({ { number.at(nodes[0]), number.at(nodes[1]) }, p.weights[1], p.area,
            p.gap, p.shear.x });
    }
    return plate;
}

/// Largest difference of numbers of one kind, and the largest of them.
struct Measure {
    double difference = 0.0, largest = 0.0;

    void add(double a, double b)
    {
        const double d = std::fabs(a - b);
        if (!(d <= difference)) difference = d;  // also what is no number
        largest = std::max(largest, std::fabs(a));
    }
    void add(Point a, Point b)
    {
        add(a.x, b.x);
        add(a.y, b.y);
    }
    double part() const { return difference == 0.0 ? 0.0 : difference / largest; }
};

/// Measures of all points of contact.
struct PointMeasures {
    Measure way, damage, energy;
};

/// A jump of the law that is as near as this may be taken by one of the two and not by the other
/// [-].
constexpr double round_off = 1e-11;

bool same_record(const ContactPoint& a, const ContactPoint& b, double size)
{
    return a.crack_step == b.crack_step && a.crack_mode == b.crack_mode
        && flexpm::norm(a.crack_place - b.crack_place) <= 1e-12 * size;
}

/// Whether two states of a point differ by more than round-off: a jump.
bool differs(const ContactPoint& a, const ContactPoint& b, const flexpm::LawParameters& law)
{
    const double traction = std::fabs(a.state.shear_traction - b.state.shear_traction);
    return std::fabs(a.state.shear_damage - b.state.shear_damage) > 1e-9
        || traction > 1e-9 * law.cohesion || a.crack_step != b.crack_step;
}

void add_point(const ContactPoint& a, const ContactPoint& b, const flexpm::LawParameters& law,
    PointMeasures& m)
{
    m.way.add(a.state.opening, b.state.opening);
    m.way.add(a.state.max_opening, b.state.max_opening);
    m.way.add(a.state.slip, b.state.slip);
    m.way.add(a.crack_slip, b.crack_slip);
    m.way.add(
        a.state.shear_traction / law.shear_stiffness, b.state.shear_traction / law.shear_stiffness);
    m.damage.add(a.state.shear_damage, b.state.shear_damage);
    const double fracture =
        0.5 * (law.tensile_strength * law.critical_opening + law.cohesion * law.critical_slip);
    m.energy.add(a.state.damage_energy / fracture, b.state.damage_energy / fracture);
    m.energy.add(a.state.friction_energy / fracture, b.state.friction_energy / fracture);
}

/// Forces of a plate over its stiffness: differences of places decide them.
void add_plate(const Plate& a, const Plate& b, Measure& m)
{
    double stiffness = 0.0;
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        const double own = a.stiffness * a.points[i].area;
        stiffness += own;
        m.add(a.points[i].shear_force / own, b.points[i].shear_force / own);
    }
    m.add((1.0 / stiffness) * a.force, (1.0 / stiffness) * b.force);
}

/// Largest way of a node in the step that has led to a state [m].
double largest_way(const Specimen& before, const Specimen& after)
{
    double way = 0.0;
    for (std::size_t n = 0; n < after.nodes.size(); ++n) {
        const Point d = after.nodes[n].displacement - before.nodes[n].displacement;
        way = std::max({ way, std::fabs(d.x), std::fabs(d.y) });
    }
    return way;
}

double size_of(const Specimen& s)
{
    double size = 0.0;
    for (const Node& n : s.nodes)
        size = std::max({ size, std::fabs(n.reference.x), std::fabs(n.reference.y) });
    return size;
}

}  // namespace

Specimen read_state(const Assembly& a)
{
    Specimen s;
    Numbers number;
    for (int g = 0; g < a.grains.count; ++g)
        read_grain(a, g, s, number);
    for (int c = 0; c < a.contacts.count; ++c)
        s.contacts.push_back(read_contact(a, c, number));
    for (int e = 0; e < a.facets.count; ++e) {
        const auto nodes = a.facets.nodes(e);
        s.edges.push_back({ { number.at(nodes[0]), number.at(nodes[1]) }, a.facets.pressure[e] });
    }
    for (std::size_t p = 0; p < a.plates.size(); ++p)
        s.plates.push_back(read_plate(a, p, number));
    s.thickness = a.thickness;
    s.gravity = in_plane(a.gravity);
    s.step = a.step;
    return s;
}

Differences compare(const Specimen& before, const Specimen& kernel, const Specimen& plain)
{
    Differences d;
    std::vector<char> left_out(kernel.nodes.size(), 0);
    PointMeasures points;
    // grains that fall side by side have ways whose difference is round-off
    points.way.largest = largest_way(before, kernel);
    const double size = size_of(kernel);
    for (std::size_t c = 0; c < kernel.contacts.size(); ++c) {
        const Contact &a = kernel.contacts[c], &b = plain.contacts[c];
        if (!a.active) continue;
        for (std::size_t p = 0; p < a.points.size(); ++p) {
            ++d.points;
            if (b.points[p].doubt < round_off && differs(a.points[p], b.points[p], a.law)) {
                ++d.excepted;
                for (int grain : a.grains)
                    for (int n : kernel.grains[grain].nodes)
                        left_out[n] = 1;
                continue;
            }
            add_point(a.points[p], b.points[p], a.law, points);
            d.records += !same_record(a.points[p], b.points[p], size);
        }
    }
    Measure force, displacement, velocity, plates;
    for (std::size_t n = 0; n < kernel.nodes.size(); ++n) {
        const Node &a = kernel.nodes[n], &b = plain.nodes[n];
        force.largest = std::max(force.largest, b.largest_part);
        if (left_out[n]) continue;
        force.add(a.force, b.force);
        displacement.add(a.displacement, b.displacement);
        velocity.add(a.velocity, b.velocity);
    }
    for (std::size_t g = 0; g < kernel.grains.size(); ++g) {
        const Grain &a = kernel.grains[g], &b = plain.grains[g];
        if (!left_out[a.centre]) velocity.add(size * a.spin, size * b.spin);
    }
    plates.largest = displacement.largest;
    for (std::size_t p = 0; p < kernel.plates.size(); ++p) {
        const Plate &a = kernel.plates[p], &b = plain.plates[p];
        velocity.add(a.velocity, b.velocity);
        displacement.add(a.displacement, b.displacement);
        add_plate(a, b, plates);
    }
    d.force = force.part();
    d.displacement = displacement.part();
    d.velocity = velocity.part();
    d.opening = points.way.part();
    d.damage = points.damage.difference;
    d.energy = points.energy.difference / std::max(1.0, points.energy.largest);
    d.plate = plates.part();
    return d;
}

void Differences::take_larger(const Differences& o)
{
    const auto larger = [](double a, double b) { return b <= a ? a : b; };
    force = larger(force, o.force);
    displacement = larger(displacement, o.displacement);
    velocity = larger(velocity, o.velocity);
    opening = larger(opening, o.opening);
    damage = larger(damage, o.damage);
    energy = larger(energy, o.energy);
    plate = larger(plate, o.plate);
    points += o.points;
    excepted += o.excepted;
    records += o.records;
}

std::string Differences::text() const
{
    std::ostringstream out;
    out << std::setprecision(3) << "force " << force << ", displacement " << displacement
        << ", velocity " << velocity << ", opening and slip " << opening << ", damage " << damage
        << ", energy " << energy << ", plates " << plate;
    return out.str();
}

double Differences::largest() const
{
    return std::max({ force, displacement, velocity, opening, damage, energy, plate });
}

}  // namespace plain
