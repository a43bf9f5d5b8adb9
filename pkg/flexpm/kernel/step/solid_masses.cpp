// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/step/solid_masses.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/fem/tetrahedron.hpp>
#include <flexpm/kernel/pairs/pair_forces.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace flexpm {

namespace {

double sum_of_sizes(Vector a) { return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z); }

/// Bound of the largest singular value of a block: the mean of its largest row and column sums.
double norm_of(const SpaceGradient& k)
{
    const double rows = std::max({ sum_of_sizes(k.x), sum_of_sizes(k.y), sum_of_sizes(k.z) });
    const double columns = std::max({ sum_of_sizes({ k.x.x, k.y.x, k.z.x }),
        sum_of_sizes({ k.x.y, k.y.y, k.z.y }), sum_of_sizes({ k.x.z, k.y.z, k.z.z }) });
    return std::sqrt(rows * columns);
}

void add_tetrahedra(const SolidState& s, int block, Array<double>& bound)
{
    const Grains& grains = s.grains;
    const int nodes = grains.group(block).nodes, origin = grains.block_nodes[block];
    const auto c =
        load_rows<PlaneStiffness>(&grains.stiffness[block * row_count<PlaneStiffness> * lanes], 0);
    const auto number = [&](int node) { return (node - origin) / grains.layout.node_stride; };
    std::vector<SpaceGradient> rows(static_cast<std::size_t>(nodes) * nodes);
    for_each_tetrahedron(s, block, [&](const TetrahedronShape& shape, std::array<int, 4> of) {
        for (int i = 0; i < 4; ++i) {
            for (int k = 0; k < 4; ++k) {
                const SpaceGradient part = stiffness_block(shape, c, i, k);
                SpaceGradient& sum = rows[number(of[i]) * nodes + number(of[k])];
                sum = { sum.x + part.x, sum.y + part.y, sum.z + part.z };
            }
        }
    });
    const int first = grains.scalar_index(origin);
    for (int i = 0; i < nodes; ++i)
        for (int k = 0; k < nodes; ++k)
            bound[first + i] += norm_of(rows[i * nodes + k]);
}

/// What one point does to a side: the sum of its shares, and of a rigid grain the arm over its
/// radius.
struct PointSide {
    double size = 0.0;
    double arm = 0.0;
};

PointSide point_side(const SolidState& s, int contact, int point, int side)
{
    const FaceContacts& c = s.contacts;
    const int grain = c.pairs[contact][side];
    PointSide result;
    Vector place;
    for (int k = 0; k < c.corners_of(contact); ++k) {
        const double share = c.share(contact, point, k);
        result.size += std::fabs(share);
        place = place + share * space_vector(s.grains.reference, c.node(contact, side, k));
    }
    if (!s.grains.is_rigid(grain)) return result;
    const Vector centre = space_vector(s.grains.reference, s.grains.centre(grain));
    result.arm = norm(place - centre) / s.grains.radius[grain];
    result.size = 1.0 + result.arm;
    return result;
}

void add_point(const SolidState& s, int contact, int point, SolidBound& bound)
{
    const FaceContacts& c = s.contacts;
    const LawParameters& law = c.law_of(contact);
    const double stiffness = std::max(law.normal_stiffness, law.shear_stiffness);
    const PointSide sides[2] = { point_side(s, contact, point, 0),
        point_side(s, contact, point, 1) };
    const double all = c.area(contact, point) * stiffness * (sides[0].size + sides[1].size);
    for (int side = 0; side < 2; ++side) {
        const int grain = c.pairs[contact][side];
        if (s.grains.is_rigid(grain)) {
            const double r = s.grains.radius[grain];
            bound.node[s.grains.scalar_index(s.grains.centre(grain))] += all;
            bound.turn[grain] += r * r * sides[side].arm * all;
            continue;
        }
        for (int k = 0; k < c.corners_of(contact); ++k) {
            bound.node[s.grains.scalar_index(c.node(contact, side, k))] +=
                std::fabs(c.share(contact, point, k)) * all;
        }
    }
}

/// A contact of a plate, which gives way itself if a load moves it.
void add_touch(const SolidState& s, const Plate& plate, int index, SolidBound& bound)
{
    const int triangle = plate.points[index].facet, grain = s.surface.grain[triangle];
    const double sides = plate.loaded ? 2.0 : 1.0;
    if (!s.grains.is_rigid(grain)) {
        for (int k = 0; k < 3; ++k)
            bound.node[s.grains.scalar_index(s.surface.nodes[triangle][k])] +=
                3.0 * corner_share(plate, index, k) * (sides * point_stiffness(plate, index) / 3.0);
        return;
    }
    const double r = s.grains.radius[grain];
    Vector place;
    for (int k = 0; k < 3; ++k)
        place = place
            + corner_share(plate, index, k)
                * space_vector(s.grains.reference, s.surface.nodes[triangle][k]);
    const double arm = norm(place - space_vector(s.grains.reference, s.grains.centre(grain))) / r;
    const double all = point_stiffness(plate, index) * (sides + arm);
    bound.node[s.grains.scalar_index(s.grains.centre(grain))] += all;
    bound.turn[grain] += r * r * arm * all;
}

/// Stiffness that a pair adds to a grain [N/m], and to the turn of a rigid one [N m].
struct PairStiffness {
    std::vector<std::pair<int, double>> nodes;  ///< the centre of a rigid grain
    double turn = 0.0;
};

/// Stiffness that the bonds of a face gave to each of its corners, over their area [Pa/m].
std::vector<double> bonded_stiffness(
    const SolidState& s, int grain, const std::vector<int>& contacts, const std::vector<int>& nodes)
{
    const FaceContacts& c = s.contacts;
    std::vector<double> sums(nodes.size(), 0.0);
    double area = 0.0;
    for (int contact : contacts) {
        const LawParameters& law = c.law_of(contact);
        const double stiffness = std::max(law.normal_stiffness, law.shear_stiffness);
        const int side = c.pairs[contact][0] == grain ? 0 : 1;
        for (int p = 0; p < c.points_of(contact); ++p) {
            area += c.area(contact, p);
            const double sides =
                point_side(s, contact, p, 0).size + point_side(s, contact, p, 1).size;
            for (int k = 0; k < c.corners_of(contact); ++k) {
                const auto at = std::find(nodes.begin(), nodes.end(), c.node(contact, side, k));
                if (at != nodes.end())
                    sums[at - nodes.begin()] +=
                        stiffness * std::fabs(c.share(contact, p, k)) * c.area(contact, p) * sides;
            }
        }
    }
    for (double& sum : sums)
        sum = area > 0.0 ? sum / area : 0.0;
    return sums;
}

/// What masses do not bear yet of a pressed area: they bear contacts that have ended, but not that a
/// corner that stands for little of its face has as much of a pair as any other.
PairStiffness stiffness_of(const SolidState& s, int number, int side, double area)
{
    const PairContact& pair = s.pairs[number];
    const BodyFaces& faces = s.plan.pairs.faces;
    const LawParameters& law = s.contacts.laws[pair.law];
    const double stiffness = std::max(law.normal_stiffness, law.shear_stiffness);
    const int grain = pair.grains[side], centre = s.grains.centre(grain);
    PairStiffness found;
    for (int face : s.plan.pairs.pairs[number].loads[side].faces) {
        const std::vector<int> contacts(faces.contacts.begin() + faces.first_contact[face],
            faces.contacts.begin() + faces.first_contact[face + 1]);
        if (s.grains.is_rigid(grain)) {
            if (!faces.outer[face]) continue;
            const double r = s.grains.radius[grain];
            const double arm = norm(pair.place - s.grains.position(centre)) / r;
            found.nodes.assign(1, { centre, (2.0 + arm) * stiffness * area });
            found.turn = r * r * arm * found.nodes[0].second;
            continue;
        }
        const std::vector<int> nodes(faces.corners.begin() + faces.first_corner[face],
            faces.corners.begin() + faces.first_corner[face + 1]);
        std::vector<Vector> corners;
        for (int node : nodes)
            corners.push_back(
                space_vector(s.grains.reference, node) - space_vector(s.grains.reference, centre));
        const std::vector<double> shares = largest_shares(corners);
        const std::vector<double> bonded = bonded_stiffness(s, grain, contacts, nodes);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            // both sides give way, and friction acts at the same corners
            const double more = 3.0 * shares[k] * stiffness - bonded[k];
            if (more > 0.0) found.nodes.emplace_back(nodes[k], more * area);
        }
    }
    return found;
}

/// Pairs by the areas that masses have been raised for.
void add_pairs(const SolidState& s, SolidBound& bound)
{
    // of a state that was loaded the next step finds the nodes
    if (s.plan.pairs.pairs.size() != s.pairs.size()) return;
    for (std::size_t i = 0; i < s.pairs.size(); ++i) {
        for (int side = 0; side < 2; ++side) {
            const auto number = static_cast<int>(i);
            const PairStiffness found = stiffness_of(s, number, side, s.pairs[i].mass_area);
            for (const auto& [node, stiffness] : found.nodes)
                bound.node[s.grains.scalar_index(node)] += stiffness;
            if (found.turn > 0.0) bound.turn[s.pairs[i].grains[side]] += found.turn;
        }
    }
}

/// Masses are found anew, without pairs: bear_pairs() adds theirs.
void forget_pairs(SolidState& s)
{
    for (PairContact& pair : s.pairs)
        pair.mass_area = 0.0;
}

/// Add to the mass of a node. It keeps its momentum; the kinetic energy that it loses is damped.
void add_mass(SolidState& s, int node, double more)
{
    double& inverse = s.grains.inverse_mass[s.grains.scalar_index(node)];
    if (inverse == 0.0) return;
    const double before = 1.0 / inverse, kept = before / (before + more);
    inverse = 1.0 / (before + more);
    for (int i = node; i < node + 3; ++i) {
        if (s.grains.prescribed[i]) continue;
        double& velocity = s.grains.velocity[i];
        s.ledger.damping_work[0] += 0.5 * before * (1.0 - kept) * velocity * velocity;
        velocity *= kept;
    }
}

/// The same of the inertia of a rigid grain, which is that of a sphere where masses are scaled.
void add_inertia(SolidState& s, int grain, double more)
{
    RigidBody& body = s.bodies[grain];
    const double before = body.inertia.xx, kept = before / (before + more);
    body.inertia.xx += more;
    body.inertia.yy += more;
    body.inertia.zz += more;
    if (!body.spin_held) {
        s.ledger.damping_work[0] += 0.5 * before * (1.0 - kept) * dot(body.spin, body.spin);
        body.spin = kept * body.spin;
    }
    set_spin(s, grain, body.spin, body.spin_held);
}

/// Stiffness that a plate feels as it moves against rigid grains that move and turn.
double bound_of(const Plate& plate)
{
    double sum = 0.0;
    for (int i = 0; i < plate_points(plate); ++i)
        sum += 3.0 * point_stiffness(plate, i);
    return sum;
}

/// Call visit(index) for the mass of each node that has one.
template <class Visit> void for_each_mass(const Grains& grains, Visit visit)
{
    for (int g = 0; g < grains.count; ++g) {
        if (grains.is_rigid(g)) {
            visit(grains.scalar_index(grains.centre(g)));
            continue;
        }
        for (int n = 0; n < grains.nodes_of(g); ++n)
            visit(grains.scalar_index(grains.node(g, n)));
    }
}

/// A rigid grain that nothing touches, or that no force turns, gets what one contact of its size
/// would ask for, so that its masses are finite.
void complete_rigid(const SolidState& s, SolidBound& bound)
{
    for (std::size_t g = 0; g < bound.turn.size(); ++g) {
        const int grain = static_cast<int>(g);
        const double square = s.grains.radius[g] * s.grains.radius[g];
        double& node = bound.node[s.grains.scalar_index(s.grains.centre(grain))];
        if (node == 0.0) node = s.contacts.laws.front().normal_stiffness * square;
        bound.turn[g] = std::max(bound.turn[g], 0.01 * square * node);
    }
}

/// Masses of loaded plates, for a factor on the stiffness.
void scale_plates(SolidState& s, double factor)
{
    for (Plate& plate : s.plates)
        if (plate.loaded) plate.mass = factor * bound_of(plate);
}

/// Mass over stiffness at a time step [s^2].
double mass_factor(double damping, double dt)
{
    return mass_margin * (1.0 + damping) * dt * dt / 4.0;
}

SpaceTensor times(double factor, const SpaceTensor& t)
{
    return { factor * t.xx, factor * t.yy, factor * t.zz, factor * t.yz, factor * t.xz,
        factor * t.xy };
}

/// Mass of a rigid grain to its centre, and its inertia.
void set_real_body(SolidState& s, int grain)
{
    const SolidMass whole = real_mass(s, grain);
    s.bodies[grain].inertia = whole.inertia;
    s.grains.inverse_mass[s.grains.scalar_index(s.grains.centre(grain))] = 1.0 / whole.mass;
}

}  // namespace

SolidBound stiffness_bound(const SolidState& s)
{
    SolidBound bound { Array<double>(s.grains.inverse_mass.size(), 0.0),
        std::vector<double>(s.bodies.size(), 0.0) };
    for (int block = 0; block < s.grains.blocks(); ++block)
        if (!s.grains.group(block).rigid) add_tetrahedra(s, block, bound.node);
    for (int c = 0; c < s.contacts.count; ++c)
        for (int p = 0; p < s.contacts.points_of(c); ++p)
            add_point(s, c, p, bound);
    for (const Plate& plate : s.plates)
        for (int i = 0; i < plate_points(plate); ++i)
            add_touch(s, plate, i, bound);
    add_pairs(s, bound);
    complete_rigid(s, bound);
    return bound;
}

void scale_masses(SolidState& s, double damping, double dt)
{
    check_damping(damping);
    check_positive("time step", dt, "s");
    forget_pairs(s);
    const SolidBound bound = stiffness_bound(s);
    const double factor = mass_factor(damping, dt);
    for_each_mass(
        s.grains, [&](int i) { s.grains.inverse_mass[i] = 1.0 / (factor * bound.node[i]); });
    scale_plates(s, factor);
    for (std::size_t g = 0; g < s.bodies.size(); ++g) {
        const double i = factor * bound.turn[g];
        s.bodies[g].inertia = { i, i, i, 0.0, 0.0, 0.0 };
    }
}

bool bear_pairs(SolidState& s, double damping, double dt)
{
    constexpr double slack = 1.25;
    const double factor = dt > 0.0 ? mass_factor(damping, dt) : 0.0;
    bool any = false;
    for (std::size_t i = 0; i < s.pairs.size(); ++i) {
        PairContact& pair = s.pairs[i];
        if (!(pair.area > pair.mass_area)) continue;
        any = true;
        const double more = slack * pair.area - pair.mass_area;
        pair.mass_area += more;
        for (int side = 0; side < 2 && factor > 0.0; ++side) {
            const auto number = static_cast<int>(i);
            const PairStiffness found = stiffness_of(s, number, side, more);
            for (const auto& [node, stiffness] : found.nodes)
                add_mass(s, node, factor * stiffness);
            if (found.turn > 0.0) add_inertia(s, pair.grains[side], factor * found.turn);
        }
    }
    return any;
}

SolidMass real_mass(const SolidState& s, int grain)
{
    const double density = s.grains.elastic[s.grains.material[grain]].density;
    const Vector centre = space_vector(s.grains.reference, s.grains.centre(grain));
    double volume = 0.0;
    SpaceTensor sum {};
    for_each_tetrahedron(
        s, s.grains.block_of(grain), [&](const TetrahedronShape& t, std::array<int, 4> nodes) {
            std::array<Vector, 4> r;
            for (int k = 0; k < 4; ++k)
                r[k] = space_vector(s.grains.reference, nodes[k]) - centre;
            const SpaceTensor m = second_moments(r[0], r[1], r[2], r[3]);
            sum = { sum.xx + m.xx, sum.yy + m.yy, sum.zz + m.zz, sum.yz + m.yz, sum.xz + m.xz,
                sum.xy + m.xy };
            volume += t.volume;
        });
    return { density * volume, times(density, inertia_of(sum)) };
}

void set_real_masses(SolidState& s)
{
    forget_pairs(s);
    Array<double> mass(s.grains.inverse_mass.size(), 0.0);
    for (int g = 0; g < s.grains.count; ++g) {
        const double density = s.grains.elastic[s.grains.material[g]].density;
        if (s.grains.is_rigid(g)) {
            set_real_body(s, g);
            continue;
        }
        for_each_tetrahedron(
            s, s.grains.block_of(g), [&](const TetrahedronShape& t, std::array<int, 4> nodes) {
                for (int n : nodes)
                    mass[s.grains.scalar_index(n)] += 0.25 * density * t.volume;
            });
    }
    for_each_mass(s.grains, [&](int i) {
        if (mass[i] > 0.0) s.grains.inverse_mass[i] = 1.0 / mass[i];
    });
}

double set_real_masses(SolidState& s, double damping)
{
    set_real_masses(s);
    const double dt = stable_step(s, damping);
    scale_plates(s, mass_factor(damping, dt));
    return dt;
}

double stable_step(const SolidState& s, double damping)
{
    check_damping(damping);
    const SolidBound bound = stiffness_bound(s);
    double most = 0.0;  // of stiffness / mass
    for_each_mass(
        s.grains, [&](int i) { most = std::max(most, bound.node[i] * s.grains.inverse_mass[i]); });
    for (std::size_t g = 0; g < s.bodies.size(); ++g)
        most = std::max(most, bound.turn[g] / least_moment(s.bodies[g].inertia));
    return 2.0 / std::sqrt(mass_margin * (1.0 + damping) * most);
}

}  // namespace flexpm
