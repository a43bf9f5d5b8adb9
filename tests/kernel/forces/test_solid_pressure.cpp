// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pressure on the surface of a solid: sums, works against volumes, the strains of a
/// confined specimen, what is loose, the same bits.
#include "support/catch.hpp"

#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/measure/mean_stress.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/kernel/topology/loose_grains.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include "assembly/members.hpp"
#include "support/solid_states.hpp"

#include <map>
#include <tuple>

using namespace solid_states;

namespace {

constexpr double pressure = 7e6;
const StepOptions each { 1.0, 0.7, 1, true };

constexpr int bottom = static_cast<int>(SolidSide::bottom), top = static_cast<int>(SolidSide::top);

Vector place(const SolidState& s, int node)
{
    return space_vector(s.grains.reference, node) + space_vector(s.grains.displacement, node);
}

using Nodes = std::array<int, 3>;

/// Vector of the present area of a triangle, outwards.
Vector area_of(const SolidState& s, const Nodes& n)
{
    const Vector a = place(s, n[0]);
    return 0.5 * cross(place(s, n[1]) - a, place(s, n[2]) - a);
}
Vector area_of(const SolidState& s, int t) { return area_of(s, s.surface.nodes[t]); }

Vector middle_of(const SolidState& s, const Nodes& nodes)
{
    Vector sum;
    for (int n : nodes)
        sum = sum + (1.0 / 3.0) * place(s, n);
    return sum;
}
Vector middle_of(const SolidState& s, int t) { return middle_of(s, s.surface.nodes[t]); }

int triangles(const SolidState& s) { return static_cast<int>(s.surface.side.size()); }

/// Volume within triangles, by Gauss's theorem, which is exact of flat ones.
double enclosed(const SolidState& s, const std::vector<Nodes>& triangles)
{
    double sum = 0.0;
    for (const Nodes& n : triangles)
        sum += dot(middle_of(s, n), area_of(s, n)) / 3.0;
    return sum;
}
double enclosed(const SolidState& s) { return enclosed(s, s.surface.nodes); }

/// Triangles across the slits that a bond's give leaves between the surfaces of two grains, and
/// at corners of more: with those of the surface they are closed.
std::vector<Nodes> slits_of(const SolidState& s)
{
    const auto corner = [&](int node) {
        const Vector r = space_vector(s.grains.reference, node);
        return std::array<double, 3> { r.x, r.y, r.z };
    };
    std::map<std::array<double, 3>, int> first;  // node at each corner
    std::map<std::array<double, 6>, std::array<int, 2>> edges;
    const auto edge = [&](int from, int to) {
        const auto a = corner(from), b = corner(to);
        return std::array<double, 6> { a[0], a[1], a[2], b[0], b[1], b[2] };
    };
    for (const Nodes& n : s.surface.nodes)
        for (int k = 0; k < 3; ++k) {
            const int from = n[k], to = n[(k + 1) % 3];
            first.emplace(corner(from), from);
            REQUIRE(edges.emplace(edge(from, to), std::array<int, 2> { from, to }).second);
        }
    std::vector<Nodes> slits;
    for (const auto& [key, nodes] : edges) {
        const auto [a, b] = nodes;
        const auto [to, from] = edges.at(edge(b, a));
        if (a == from || key > edge(b, a)) continue;
        slits.insert(slits.end(),
            { { b, a, from }, { b, from, to }, { from, a, first[corner(a)] },
                { b, to, first[corner(b)] } });
    }
    return slits;
}

/// Watches the volume within the surface of a solid, and what triangles without pressure sweep.
class VolumeWatch {
public:
    explicit VolumeWatch(const SolidState& s) : slits_(slits_of(s)), all_(s.surface.nodes)
    {
        all_.insert(all_.end(), slits_.begin(), slits_.end());
        look(s);
        swept_ = 0.0;
    }
    void look(const SolidState& s)
    {
        volume_ = enclosed(s, all_);
        std::vector<std::array<Vector, 2>> now;
        for (const Nodes& n : slits_)
            now.push_back({ area_of(s, n), middle_of(s, n) });
        for (std::size_t i = 0; i < before_.size(); ++i)
            swept_ += 0.5 * dot(before_[i][0] + now[i][0], now[i][1] - before_[i][1]);
        before_ = now;
    }
    /// Within the triangles of the surface and those across slits, which are closed.
    double volume() const { return volume_; }
    /// Volume that slits have swept since the start.
    double swept() const { return swept_; }
    /// Sum of all areas, which is zero of a closed surface.
    Vector area(const SolidState& s) const
    {
        Vector sum;
        for (const Nodes& n : all_)
            sum = sum + area_of(s, n);
        return sum;
    }

private:
    std::vector<Nodes> slits_, all_;
    std::vector<std::array<Vector, 2>> before_;
    double volume_ = 0.0, swept_ = 0.0;
};

/// A smooth motion that leaves neighbours together and both ends flat, to a share of its end.
Vector way_at(Vector r, double height, double share)
{
    const double up = r.z / height, a = 0.02 * share;
    return { a * (r.x + 0.4 * r.y + height * up * up), a * (0.3 * r.x - r.y * up + r.x * up),
        -a * (0.5 * r.z + r.x * up * (1.0 - up)) };
}

template <class Way> void put(SolidState& s, Way way)
{
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        set_space_vector(s.grains.displacement, node, way(space_vector(s.grains.reference, node)));
    });
    find_forces(s);
}

struct Sums {
    Vector force, moment;
    double whole = 0.0;  ///< pressure times area
};

Sums sums_of(const SolidState& s)
{
    Sums sums;
    for (int t = 0; t < triangles(s); ++t) {
        const Vector push = pressure_on(s, t);
        sums.force = sums.force + push;
        for (int n : s.surface.nodes[t])
            sums.moment = sums.moment + cross(place(s, n), (1.0 / 3.0) * push);
        sums.whole += pressure * norm(area_of(s, t));
    }
    return sums;
}

SolidState made(const Packing& p, bool rigid, double stiffer = 1.0)
{
    SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
    input.contacts.front().normal_stiffness *= stiffer;
    SolidState s = make_solid(p.cells, p.solid, input);
    hold_end(s, SolidSide::bottom, { false, false });
    hold_against_sliding(s);
    scale_masses(s, each.damping);
    return s;
}

/// Under pressures on x, y and the top, which rise over `ramp` steps, until nothing moves.
void confine(SolidState& s, double along_x, double along_y, double on_top, int ramp, int rest)
{
    for (int k = 1; k <= ramp + rest; ++k) {
        const double t = std::min(1.0, static_cast<double>(k) / ramp);
        const double part = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
        for (int side : { 1, 3 })
            set_pressure(s, side, part * along_x);
        for (int side : { 4, 5 })
            set_pressure(s, side, part * along_y);
        set_pressure(s, top, part * on_top);
        step(s, { each.dt, each.damping, 1, k == ramp + rest });
    }
}

double balance_of(const Energies& e)
{
    return e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag - e.boundary_work
        - e.initial;
}

}  // namespace

TEST_CASE("A pressure all around a solid has neither force nor moment", "[solids]")
{
    const Packing p = packing(40, 3);
    SolidState s = make_solid(p.cells, p.solid, granite());
    for (int side = 0; side < 6; ++side)
        set_pressure(s, side, pressure);
    for (const double share : { 0.0, 1.0 }) {
        put(s, [&](Vector r) { return way_at(r, p.solid.high.z, share); });
        const Sums sums = sums_of(s);
        CAPTURE(share, sums.whole);
        CHECK(norm(sums.force) < 1e-12 * sums.whole);
        CHECK(norm(sums.moment) < 1e-12 * sums.whole * p.solid.high.z);
    }
}

TEST_CASE("A pressure on the mantle lifts by the difference of the ends", "[solids]")
{
    const Packing p = packing(40, 3);
    SolidState s = make_solid(p.cells, p.solid, granite());
    for (int side : { 1, 3, 4, 5 })
        set_pressure(s, side, pressure);
    put(s, [&](Vector r) { return way_at(r, p.solid.high.z, 1.0); });
    double ends[] = { 0.0, 0.0 };
    for (int t = 0; t < triangles(s); ++t)
        if (s.surface.side[t] == bottom || s.surface.side[t] == top)
            ends[s.surface.side[t] == top] += norm(area_of(s, t));
    const Sums sums = sums_of(s);
    CHECK(std::fabs(ends[1] - ends[0]) > 1e-3 * ends[0]);
    CHECK(std::fabs(sums.force.x) < 1e-12 * sums.whole);
    CHECK(std::fabs(sums.force.y) < 1e-12 * sums.whole);
    CHECK(sums.force.z == Approx(pressure * (ends[1] - ends[0])).epsilon(1e-10));
}

TEST_CASE("The work of a pressure is that on the change of the volume", "[solids]")
{
    const Packing p = packing(30, 4);
    SolidState s = make_solid(p.cells, p.solid, granite());
    for (int side = 0; side < 6; ++side)
        set_pressure(s, side, pressure);
    std::vector<int> nodes;
    for_each_node(s, [&](int g, int n) { nodes.push_back(s.grains.node(g, n)); });
    for (int axis = 0; axis < 3; ++axis)
        prescribe(s, nodes, axis, 0.0);
    find_forces(s);
    const double before = enclosed(s);
    const int steps = 200;
    for (int k = 0; k < steps; ++k) {
        for (int n : nodes) {
            const Vector r = space_vector(s.grains.reference, n);
            const double height = p.solid.high.z;
            set_space_vector(s.grains.velocity, n,
                way_at(r, height, static_cast<double>(k + 1) / steps)
                    - way_at(r, height, static_cast<double>(k) / steps));
        }
        step(s, each);
    }
    const double change = enclosed(s) - before;
    CHECK(std::fabs(change) > 1e-4 * before);
    CHECK(s.ledger.pressure_work == Approx(-pressure * change).epsilon(1e-6));
    CHECK(energies(s).boundary_work != s.ledger.pressure_work);  // held nodes work, too
}

TEST_CASE("A confined solid has the work of its pressure on the change of its volume", "[solids]")
{
    const auto chosen =
        GENERATE(table<bool, double>({ { false, 1.0 }, { false, 100.0 }, { true, 1.0 } }));
    const bool rigid = std::get<0>(chosen);
    const double stiffer = std::get<1>(chosen);
    const Packing p = box(30, 2);
    SolidState s = made(p, rigid, stiffer);
    VolumeWatch watch(s);
    const double start = watch.volume();
    double raw = 0.0, expected = 0.0, before = 0.0;
    const auto step_at = [&](double now) {
        const double volume = watch.volume(), swept = watch.swept();
        for (int side = 0; side < 6; ++side)
            set_pressure(s, side, now);
        step(s, each);
        watch.look(s);
        // linear within a step, as the work is booked
        const double mean = 0.5 * (before + now), change = watch.volume() - volume;
        raw -= mean * change;
        expected -= mean * (change - (watch.swept() - swept));
        before = now;
    };
    const auto check_work = [&](double work, double wanted, double with_slits) {
        CAPTURE(rigid, stiffer, work / wanted - 1.0, work / with_slits - 1.0);
        CHECK(work == Approx(wanted).epsilon(1e-6));
        // a slit bears no pressure, and its share is the give of the bonds over the grains' size
        CHECK(work == Approx(with_slits).epsilon(stiffer > 1.0 ? 1e-6 : 1e-4));
    };
    const int ramp = 300;
    for (int k = 1; k <= 3 * ramp; ++k) {
        const double t = std::min(1.0, static_cast<double>(k) / ramp);
        step_at(pressure * t * t * (3.0 - 2.0 * t));
    }
    CHECK(norm(watch.area(s)) < 1e-12 * p.solid.volume / p.solid.high.z);
    CHECK(watch.volume() - start < -1e-5 * start);
    check_work(s.ledger.pressure_work, expected, raw);

    if (!rigid) {  // ends of rigid grains lie on plates, which bear instead of the pressure
        const double work = s.ledger.pressure_work, volume = watch.volume(), swept = watch.swept();
        hold_ends(s, { false, false });
        scale_masses(s, each.damping);
        take_over(s, drive_of_top(s), elastic_field(s), -3e-7 * p.solid.high.z, true, each.dt);
        for (int k = 0; k < 300; ++k)
            step_at(pressure);
        const double change = watch.volume() - volume;
        CAPTURE(change / start);
        CHECK(change < -1e-5 * start);
        check_work(s.ledger.pressure_work - work, -pressure * (change - (watch.swept() - swept)),
            -pressure * change);
    }
    CHECK(count_cracks(s).tensile + count_cracks(s).shear == 0);
}

TEST_CASE("Three equal pressures strain a stiffly bonded solid as elasticity says", "[solids]")
{
    const Packing p = box(30, 2);
    SolidState s = made(p, false, 100.0);
    confine(s, pressure, pressure, pressure, 2000, 16000);
    const auto grain = specimens::granite();
    const double expected = pressure * (1.0 - 2.0 * grain.poisson) / grain.young;
    const AxialObservation now = observe(s, solid_frame(s, Sense::compression));
    for (const auto axis : { &Vector::x, &Vector::y, &Vector::z }) {
        const double strain = mean_strain(s, axis);
        CAPTURE(-strain / expected - 1.0);
        CHECK(strain == Approx(-expected).epsilon(5e-3));
    }
    CHECK(now.axial_strain == Approx(expected).epsilon(5e-3));
    CHECK(-now.lateral_strain == Approx(expected).epsilon(5e-3));
    CHECK(now.confinement == pressure);
    CHECK(std::fabs(balance_of(now.energies)) < 1e-4 * now.energies.elastic);
    const SolidSnapshot seen = take_snapshot(s);
    double worst = 0.0;
    for (std::size_t g = 0; g < seen.grain_stress.size(); g += 6)
        for (std::size_t k = 0; k < 6; ++k)
            worst = std::max(worst, std::fabs(seen.grain_stress[g + k] + (k < 3 ? pressure : 0.0)));
    CHECK(worst < 0.01 * pressure);
    const Balance found = balance(s);
    CHECK(found.mean_stress.xx == Approx(-pressure).epsilon(1e-3));
    CHECK(found.mean_stress.yy == Approx(-pressure).epsilon(1e-3));
    CHECK(found.mean_stress.zz == Approx(-pressure).epsilon(1e-3));
    CHECK(std::fabs(found.mean_stress.xy) < 1e-3 * pressure);
    CHECK(norm(found.missing_force) < 1e-3 * pressure * p.solid.volume / p.solid.high.z);
}

TEST_CASE("Each side of a box stands at its own pressure, and the ends take over", "[solids]")
{
    const double along_x = 4e6, along_y = 9e6;
    for (const bool rigid : { false, true }) {
        const Packing p = box(60, 2);
        SolidState s = made(p, rigid);
        confine(s, along_x, along_y, along_y, 400, 1000);
        const Balance found = balance(s);
        CAPTURE(rigid, found.mean_stress.xx, found.mean_stress.yy, found.mean_stress.zz);
        CHECK(found.mean_stress.xx == Approx(-along_x).epsilon(2e-3));
        CHECK(found.mean_stress.yy == Approx(-along_y).epsilon(2e-3));
        CHECK(found.mean_stress.zz == Approx(-along_y).epsilon(2e-3));
        CHECK(found.outside_stress.xx == Approx(found.mean_stress.xx).epsilon(1e-3));
        CHECK(side_pressures(s).least == along_x);
        CHECK(side_pressures(s).largest == along_y);
        const double area = p.solid.volume / p.solid.high.z;
        CHECK(end_forces(s).bottom == Approx(along_y * area).epsilon(2e-3));
        set_pressure(s, top, 0.0);
        hold_ends(s, { false, false });
        scale_masses(s, each.damping);
        take_over(s, drive_of_top(s), elastic_field(s), -1e-9 * p.solid.high.z, true, each.dt);
        step(s, each);
        CHECK(end_forces(s).top == Approx(-along_y * area).epsilon(2e-3));
        double worst = 0.0;
        for (int k = 0; k < 300; ++k) {
            step(s, each);
            const Energies e = energies(s);
            worst = std::max(worst, std::fabs(balance_of(e)) / e.elastic);
        }
        CHECK(worst < 1e-3);
        const AxialObservation now = observe(s, solid_frame(s, Sense::compression));
        CHECK(now.end_mismatch < 0.01);
        CHECK(now.axial_stress > along_y);
    }
}

TEST_CASE("A solid under pressures neither slides nor turns between smooth ends", "[solids]")
{
    for (const bool rigid : { false, true }) {
        SolidState s = made(box(30, 2), rigid);
        // a couple about z and a thrust, as of a mantle that has cracked
        for (int t = 0; t < triangles(s); ++t) {
            s.surface.pressure.resize(s.surface.side.size(), 0.0);
            if (s.surface.side[t] == 1)
                s.surface.pressure[t] = middle_of(s, t).y > 6e-3 ? 1e4 : 0.0;
        }
        const std::vector<double> wanted = s.surface.pressure;
        s.surface.pressure.clear();
        set_pressure(s, 1, 1.0);
        s.surface.pressure = wanted;
        for (int k = 0; k < 2000; ++k)
            step(s, each);
        double fastest = 0.0, farthest = 0.0;
        for_each_node(s, [&](int grain, int number) {
            const int node = s.grains.node(grain, number);
            farthest = std::max(farthest, norm(space_vector(s.grains.displacement, node)));
            if (!rigid) fastest = std::max(fastest, norm(space_vector(s.grains.velocity, node)));
        });
        CAPTURE(rigid, farthest, fastest);
        CHECK(farthest > 0.0);
        CHECK(farthest < 1e-6);
        CHECK(fastest < 1e-3 * farthest);
    }
}

TEST_CASE("A pressure leaves alone what has come loose", "[solids]")
{
    const Packing p = packing(40, 3);
    for (const bool rigid : { false, true }) {
        SolidState s = made(p, rigid);
        for (int side : { 1, 3, 4, 5 })
            set_pressure(s, side, pressure);
        find_loose(s);
        CHECK(std::count(s.grains.loose.begin(), s.grains.loose.end(), 1) == 0);
        // a grain of the mantle, not at the bottom, loses all its bonds, which open
        std::vector<int> ends(s.grains.count, 0);
        for (int t = 0; t < triangles(s); ++t)
            if (s.surface.side[t] == bottom) ends[s.surface.grain[t]] = 1;
        int triangle = 0;
        while (s.surface.side[triangle] == bottom || s.surface.side[triangle] == top
            || ends[s.surface.grain[triangle]])
            ++triangle;
        const int grain = s.surface.grain[triangle];
        FaceContacts& c = s.contacts;
        for (int contact = 0; contact < c.count; ++contact) {
            if (c.pairs[contact][0] != grain && c.pairs[contact][1] != grain) continue;
            for (int point = 0; point < c.points_of(contact); ++point)
                c.set_crack(contact, point, { 0, tensile_crack, {}, 0.0 });
        }
        const Vector centre = space_vector(s.grains.reference, s.grains.centre(grain));
        for (int n = 0; n < s.grains.nodes_of(grain); ++n) {
            const int node = s.grains.node(grain, n);
            const Vector arm = space_vector(s.grains.reference, node) - centre;
            set_space_vector(s.grains.displacement, node, -1e-3 * arm);
        }
        find_loose(s);
        CHECK(std::count(s.grains.loose.begin(), s.grains.loose.end(), 1) == 1);
        CHECK(s.grains.loose[grain] == 1);
        add_pressure_forces(s, s.grains.block_of(grain));
        CHECK(norm(pressure_on(s, triangle)) == 0.0);
        for (int side : { 1, 3, 4, 5 })
            set_pressure(s, side, 0.0);
        find_loose(s);
        CHECK(s.grains.loose[grain] == 0);
    }
}

TEST_CASE("A pressed solid has the same bits on all threads and after it was saved", "[solids]")
{
    for (const bool rigid : { false, true }) {
        SolidState one = made(box(100, 5), rigid);
        for (int side : { 1, 2, 3, 4, 5 })
            set_pressure(one, side, pressure);
        SolidState two = one;
        for (int k = 0; k < 30; ++k) {
            step(one, each);
            step(two, { each.dt, each.damping, 3, true });
            if (k != 15) continue;
            two = same_bits::copy_of_members(two);
            prepare_step(two);
        }
        CHECK(same_bits::difference(one, two).empty());
        CHECK(one.ledger.pressure_work > 0.0);
    }
}

TEST_CASE("A pressure is none that pulls, and acts on a side that is there", "[solids]")
{
    const Packing p = packing(10, 3);
    SolidState s = make_solid(p.cells, p.solid, granite());
    CHECK_THROWS_WITH(set_pressure(s, 1, -1.0), Catch::Contains("pressure = -1 Pa"));
    CHECK_THROWS_WITH(set_pressure(s, 6, 1.0), Catch::Contains("side = 6"));
    CHECK_FALSE(is_pressed(s));
    CHECK(side_pressures(s).largest == 0.0);
    CHECK(norm(pressure_on(s, 0)) == 0.0);
}
