// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/linear_solid.hpp>

#include <flexpm/kernel/core/thread_team.hpp>
#include <flexpm/kernel/fem/gradient_products.hpp>
#include <flexpm/kernel/statics/wide_motions.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace flexpm {

namespace {

using Face = LinearSolid::Face;
using Spring = LinearSolid::Spring;

/// Force of a spring that is stretched by `jump`.
Vector spring_force(const Face& face, const Spring& s, Vector jump)
{
    return s.area
        * (face.shear_stiffness * jump
            + ((face.normal_stiffness - face.shear_stiffness) * dot(face.normal, jump))
                * face.normal);
}

/// Stiffness against a turn, times the radius, of what moves by it as turn x arm.
SpaceGradient turning_block(const SpaceGradient& k, Vector arm, double radius)
{
    const auto column = [&](Vector turn) {
        return (1.0 / (radius * radius)) * cross(arm, product(k, cross(turn, arm)));
    };
    // symmetric, so columns are rows
    return { column({ 1.0, 0.0, 0.0 }), column({ 0.0, 1.0, 0.0 }), column({ 0.0, 0.0, 1.0 }) };
}

}  // namespace

SpaceGradient spring_block(const LinearSolid::Face& face, const LinearSolid::Spring& s)
{
    return { spring_force(face, s, { 1.0, 0.0, 0.0 }), spring_force(face, s, { 0.0, 1.0, 0.0 }),
        spring_force(face, s, { 0.0, 0.0, 1.0 }) };
}

SpaceGradient press_block(const LinearSolid::Press& p)
{
    const Vector n = (p.stiffness - p.sliding) * p.normal;
    return { n.x * p.normal + Vector { p.sliding, 0.0, 0.0 },
        n.y * p.normal + Vector { 0.0, p.sliding, 0.0 },
        n.z * p.normal + Vector { 0.0, 0.0, p.sliding } };
}

LinearSolid::Spring spring_at(double area, std::vector<double> shares)
{
    const auto whole = std::find(shares.begin(), shares.end(), 1.0);
    const auto none = std::count(shares.begin(), shares.end(), 0.0);
    if (whole == shares.end() || none + 1 != static_cast<std::ptrdiff_t>(shares.size()))
        return { area, -1, std::move(shares) };
    return { area, static_cast<int>(whole - shares.begin()), {} };
}

LinearSolid::Share LinearSolid::share_of(int node, int end_node) const
{
    const auto first_of = [&](int n) {
        const auto at = std::partition_point(elements.begin(), elements.end(),
            [n](const Element& e) { return e.nodes.front() < n; });
        return static_cast<std::size_t>(at - elements.begin());
    };
    Share own { node, end_node, first_of(node), first_of(end_node), {} };
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
        if (own.owns(faces[f].nodes[0].front()) || own.owns(faces[f].nodes[1].front()))
            own.faces.push_back(f);
    return own;
}

void LinearSolid::share_among(int threads)
{
    shares_.clear();
    int node = 0;
    for (int t = 1; t <= threads; ++t) {
        const auto part = static_cast<long long>(first_nodes.back()) * t / threads;
        const int end = *std::lower_bound(first_nodes.begin(), first_nodes.end(), part);
        shares_.push_back(share_of(node, end));
        node = end;
    }
}

void LinearSolid::add_elements(const Share& own, const double* u, double* forces) const
{
    for (std::size_t i = own.element; i < own.end_element; ++i) {
        const Element& e = elements[i];
        const auto& n = e.nodes;
        const SpaceGradient h = displacement_gradient(e.shape, triple_at(u, n[0]),
            triple_at(u, n[1]), triple_at(u, n[2]), triple_at(u, n[3]));
        const SpaceTensor s = stress(kinds[e.kind],
            SpaceTensor { h.x.x, h.y.y, h.z.z, 0.5 * (h.y.z + h.z.y), 0.5 * (h.x.z + h.z.x),
                0.5 * (h.x.y + h.y.x) });
        const Vector f1 = e.shape.volume * (s * e.shape.g1), f2 = e.shape.volume * (s * e.shape.g2),
                     f3 = e.shape.volume * (s * e.shape.g3);
        add_triple(forces, n[0], -(f1 + f2 + f3));
        add_triple(forces, n[1], f1);
        add_triple(forces, n[2], f2);
        add_triple(forces, n[3], f3);
    }
}

void LinearSolid::add_faces(const Share& own, const double* u, double* forces) const
{
    for (int f : own.faces) {
        const Face& face = faces[f];
        const int corners = static_cast<int>(face.nodes[0].size());
        const auto give = [&](int side, int k, Vector force) {
            add_triple(forces, face.nodes[side][k], side == 0 ? -force : force);
        };
        const bool owns[] = { own.owns(face.nodes[0].front()), own.owns(face.nodes[1].front()) };
        for (const Spring& s : face.springs) {
            const bool at_corner = s.corner >= 0;  // the other corners have no part in it
            const int first = at_corner ? s.corner : 0, end = at_corner ? first + 1 : corners;
            Vector jump;
            for (int k = first; k < end; ++k) {
                const Vector apart =
                    triple_at(u, face.nodes[1][k]) - triple_at(u, face.nodes[0][k]);
                jump = jump + (at_corner ? apart : s.shares[k] * apart);
            }
            const Vector force = spring_force(face, s, jump);
            for (int side = 0; side < 2; ++side)
                for (int k = first; owns[side] && k < end; ++k)
                    give(side, k, at_corner ? force : s.shares[k] * force);
        }
    }
}

void LinearSolid::add_presses(const double* u, double* forces) const
{
    const std::vector<Vector> motions = following(u, [](const Press&) { return 0.0; });
    for (const Press& p : presses) {
        const Vector way = way_before(p, u), across = dot(p.normal, way) * p.normal;
        const Vector pressed = across + dot(p.opens, motions[p.plate]) * p.normal;
        const Vector force = p.stiffness * pressed + p.sliding * (way - across);
        for (int k = 0; k < 3; ++k)
            add_triple(forces, p.nodes[k], p.shares[k] * force);
    }
}

void LinearSolid::add(const double* u, double* forces) const
{
    const auto add_own = [&](const Share& own) {
        add_elements(own, u, forces);
        add_faces(own, u, forces);
    };
    if (shares_.empty()) {
        add_own(share_of(0, static_cast<int>(places.size())));
    } else {
        team_of(static_cast<int>(shares_.size())).run([&](int thread) {
            add_own(shares_[thread]);
        });
    }
    add_presses(u, forces);
}

std::vector<PlateStiffness> LinearSolid::plate_stiffness() const
{
    std::vector<PlateStiffness> found;
    for (const Press& p : presses) {
        if (p.plate >= static_cast<int>(found.size())) found.resize(p.plate + 1);
        found[p.plate].add(p.stiffness, p.opens);
    }
    return found;
}

Vector LinearSolid::way_before(const Press& p, const double* u) const
{
    Vector way;
    for (int k = 0; k < 3; ++k)
        way = way + p.shares[k] * triple_at(u, p.nodes[k]);
    return way;
}

Vector LinearSolid::place_of(const Press& p) const
{
    Vector place;
    for (int k = 0; k < 3; ++k)
        place = place + p.shares[k] * places[p.nodes[k]];
    return place;
}

/// Group of each node: those on both sides of a corner of a face, whose springs may be much stiffer
/// than grains.
std::vector<int> LinearSolid::joined_nodes() const
{
    std::vector<int> parent(places.size()), group(places.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto first_of = [&](int n) {
        while (parent[n] != n)
            n = parent[n] = parent[parent[n]];
        return n;
    };
    for (const Face& face : faces) {
        for (std::size_t k = 0; k < face.nodes[0].size(); ++k) {
            const int a = first_of(face.nodes[0][k]), b = first_of(face.nodes[1][k]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    int groups = 0;
    for (int n = 0; n < static_cast<int>(group.size()); ++n)
        group[n] = parent[n] == n ? groups++ : group[first_of(n)];
    return group;
}

DiagonalBlocks LinearSolid::diagonal_blocks() const
{
    DiagonalBlocks blocks(joined_nodes());
    for (const Element& e : elements)
        for (int n : { 0, 1, 2, 3 })
            blocks.add(e.nodes[n], e.nodes[n], 1.0, stiffness_block(e.shape, kinds[e.kind], n, n));
    for (const Face& face : faces) {
        const auto& [a, b] = face.nodes;
        for (const Spring& s : face.springs) {
            const SpaceGradient block = spring_block(face, s);
            for (int k = 0; k < static_cast<int>(a.size()); ++k) {
                const double share = s.share(k) * s.share(k);
                blocks.add(a[k], a[k], share, block);
                blocks.add(b[k], b[k], share, block);
                blocks.add(a[k], b[k], -share, block);
                blocks.add(b[k], a[k], -share, block);
            }
        }
    }
    for (const Press& p : presses)
        for (int k = 0; k < 3; ++k)
            blocks.add(p.nodes[k], p.nodes[k], p.shares[k] * p.shares[k], press_block(p));
    return blocks;
}

std::vector<std::unique_ptr<WideMotions>> LinearSolid::wide_motions(
    const std::vector<std::uint8_t>& held) const
{
    return wide_motions_of(*this, held);
}

void RigidSolid::gather(const double* on_nodes, double* forces) const
{
    for (int n = 0; n < static_cast<int>(grain.size()); ++n) {
        const int g = grain[n];
        const Vector force = triple_at(on_nodes, n);
        add_triple(forces, 2 * g, force);
        const Vector moment = cross(solid.places[n] - centres[g], force);
        add_triple(forces, 2 * g + 1, (1.0 / radii[g]) * moment);
    }
}

std::vector<double> RigidSolid::on_nodes(const double* u) const
{
    std::vector<double> ways(3 * grain.size(), 0.0);
    for_each_node(u, [&](int n, Vector way) { add_triple(ways.data(), n, way); });
    return ways;
}

void RigidSolid::add(const double* u, double* forces) const
{
    std::vector<double> sums(3 * grain.size(), 0.0);
    solid.add(on_nodes(u).data(), sums.data());
    gather(sums.data(), forces);
}

DiagonalBlocks RigidSolid::diagonal_blocks() const
{
    std::vector<int> alone(2 * centres.size());
    std::iota(alone.begin(), alone.end(), 0);
    DiagonalBlocks blocks(alone);
    const auto add_to = [&](int g, Vector place, const SpaceGradient& block) {
        blocks.add(2 * g, 2 * g, 1.0, block);
        blocks.add(2 * g + 1, 2 * g + 1, 1.0, turning_block(block, place - centres[g], radii[g]));
    };
    for (const Face& face : solid.faces) {
        for (const Spring& s : face.springs) {
            const SpaceGradient block = spring_block(face, s);
            for (const auto& nodes : face.nodes) {
                Vector place;
                for (int k = 0; k < static_cast<int>(nodes.size()); ++k)
                    place = place + s.share(k) * solid.places[nodes[k]];
                add_to(grain[nodes[0]], place, block);
            }
        }
    }
    for (const LinearSolid::Press& p : solid.presses)
        add_to(grain[p.nodes[0]], solid.place_of(p), press_block(p));
    for (const Hold& h : holds)
        add_to(grain[h.node], solid.places[h.node], h.k);
    return blocks;
}

std::vector<std::unique_ptr<WideMotions>> RigidSolid::wide_motions(
    const std::vector<std::uint8_t>& held) const
{
    return wide_motions_of(*this, held);
}

}  // namespace flexpm
