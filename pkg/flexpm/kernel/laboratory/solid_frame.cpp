// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_frame.hpp>

#include <flexpm/kernel/core/mean.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/measure/centre_strain.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/parts/surface_pieces.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

int triangles(const SolidState& s) { return static_cast<int>(s.surface.side.size()); }

double mean_on(const SolidState& s, const Array<double>& values, SolidSide side)
{
    const std::vector<int> nodes = side_nodes(s, side);
    return mean_of(static_cast<int>(nodes.size()),
        [&](int i) { return values[s.grains.component(nodes[i], z_axis)]; });
}

/// Force along z on the specimen at an end.
double end_force(const SolidState& s, SolidSide side)
{
    const int plate = find_plate(s, side);
    return plate >= 0 ? s.plates[plate].force.z : holding_force(s, side_nodes(s, side), z_axis);
}

/// Axial strain between bands of grain centres.
double centre_strain(const SolidState& s)
{
    const double bottom = mean_on(s, s.grains.reference, SolidSide::bottom);
    const double height = mean_on(s, s.grains.reference, SolidSide::top) - bottom;
    const double diameter = mean_diameter(s.grains);
    Station stations[2];
    const double at[] = { 0.25 * height, 0.75 * height };
    for (int g = 0; g < s.grains.count; ++g) {
        const int i = s.grains.component(s.grains.centre(g), z_axis);
        const double place = s.grains.reference[i];
        for (int k = 0; k < 2; ++k)
            if (in_band(place - bottom, at[k], diameter))
                stations[k].add(1.0, place, s.grains.displacement[i]);
    }
    for (int k = 0; k < 2; ++k)
        need_grains(stations[k], at[k]);
    need_apart(stations[0], stations[1]);
    return strain_between(stations[0], stations[1]);
}

double axial_strain(const SolidState& s)
{
    if (!s.bodies.empty()) return centre_strain(s);
    const double way = mean_on(s, s.grains.displacement, SolidSide::top)
        - mean_on(s, s.grains.displacement, SolidSide::bottom);
    return way / extent_of(s).height;
}

/// Heights between which the lateral strain is measured [m].
struct Waist {
    double from = 0.0;
    double to = 0.0;
};

/// The middle third of the surface.
Waist waist_of(const SolidState& s)
{
    double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
    for (const auto& nodes : s.surface.nodes) {
        for (int n : nodes) {
            const double z = space_vector(s.grains.reference, n).z;
            bottom = std::min(bottom, z);
            top = std::max(top, z);
        }
    }
    return { bottom + (top - bottom) / 3.0, top - (top - bottom) / 3.0 };
}

/// Part of a surface triangle at the waist; most lie within or beyond it as a whole.
Piece piece_at(const SolidState& s, int triangle, const Waist& waist)
{
    const auto& nodes = s.surface.nodes[triangle];
    double low = waist.to, high = waist.from;
    for (int n : nodes) {
        const double z = space_vector(s.grains.reference, n).z;
        low = std::min(low, z);
        high = std::max(high, z);
    }
    if (low >= waist.to || high <= waist.from) return {};
    if (low < waist.from || high > waist.to) {
        return piece_of(
            s, triangle, { { { 0.0, 0.0, 1.0 }, waist.to }, { { 0.0, 0.0, -1.0 }, -waist.from } });
    }
    constexpr double third = 1.0 / 3.0;
    return { 1.0, { third, third, third }, middle(s.grains.reference, nodes) };
}

/// Mean of a vector over a piece of a surface triangle; of a rigid grain that of its centre.
Vector mean_at(const SolidState& s, int triangle, const Piece& piece, const Array<double>& values)
{
    if (!s.bodies.empty()) return space_vector(values, s.grains.centre(s.surface.grain[triangle]));
    Vector sum;
    for (int k = 0; k < 3; ++k)
        sum = sum + piece.middle[k] * space_vector(values, s.surface.nodes[triangle][k]);
    return sum;
}

/// Two sides of the mantle across from each other, by the areas of their pieces across.
struct Across {
    Station faces[2], grains[2];

    void add(double area, double face, double place, double way)
    {
        const bool far = area > 0.0;
        faces[far].add(std::fabs(area), face, way);
        grains[far].add(std::fabs(area), place, way);
    }
    /// Both distances are one for deformable grains; for rigid grains side by side that of the
    /// centres is half or more. Less of it belongs to a layer of one grain, which has no strain.
    bool has_strain() const
    {
        return apart(grains[0], grains[1]) > 0.25 * apart(faces[0], faces[1]);
    }
};

/// Mean of the lateral strains along x and y at the waist, extension positive.
double lateral_extension(const SolidState& s, const Array<double>& moved)
{
    Across along_x, along_y;
    const Waist waist = waist_of(s);
    for (int t = 0; t < triangles(s); ++t) {
        const int side = s.surface.side[t];
        if (is_end(static_cast<SolidSide>(side)) || is_of_hole(side)) continue;
        const Piece piece = piece_at(s, t, waist);
        if (piece.share == 0.0) continue;
        const Vector area = piece.share * area_vector(s, t);
        const Vector place = mean_at(s, t, piece, s.grains.reference);
        const Vector way = mean_at(s, t, piece, moved);
        along_x.add(area.x, piece.place.x, place.x, way.x);
        along_y.add(area.y, piece.place.y, place.y, way.y);
    }
    double sum = 0.0;
    int ways = 0;
    for (const Across* way : { &along_x, &along_y }) {
        if (!way->has_strain()) continue;
        sum += strain_between(way->grains[0], way->grains[1]);
        ++ways;
    }
    return ways > 0 ? sum / ways : std::numeric_limits<double>::quiet_NaN();
}

/// Growth of the distance between the outermost grains of a disc on both sides along x [m].
double widening(const SolidState& s)
{
    const double reach = mean_diameter(s.grains);
    double farthest = 0.0, ways[2] = { 0.0, 0.0 };
    int grains[2] = { 0, 0 };
    const auto place = [&](int g) { return s.grains.reference[s.grains.centre(g)]; };
    for (int g = 0; g < s.grains.count; ++g)
        farthest = std::max(farthest, std::fabs(place(g)));
    for (int g = 0; g < s.grains.count; ++g) {
        if (std::fabs(place(g)) < farthest - reach) continue;
        const int side = place(g) > 0.0;
        ways[side] += s.grains.displacement[s.grains.centre(g)];
        ++grains[side];
    }
    return ways[1] / std::max(grains[1], 1) - ways[0] / std::max(grains[0], 1);
}

double volume_of(const SolidState& s)
{
    double sum = 0.0;
    for (int block = 0; block < s.grains.blocks(); ++block)
        for_each_tetrahedron(s, block,
            [&](const TetrahedronShape& t, const std::array<int, 4>&) { sum += t.volume; });
    return sum;
}

double mean_modulus(const SolidState& s)
{
    const double of_contacts =
        contact_modulus(grain_mean(s.grains, [&](int g) { return own_law(s, g).normal_stiffness; }),
            mean_diameter(s.grains));
    if (!s.bodies.empty()) return of_contacts;
    return series_modulus(
        grain_mean(s.grains, [&](int g) { return s.grains.elastic[s.grains.material[g]].young; }),
        of_contacts);
}

}  // namespace

SolidExtent extent_of(const SolidState& s)
{
    SolidExtent extent;
    for (int t = 0; t < triangles(s); ++t)
        if (s.surface.side[t] == static_cast<int>(SolidSide::bottom))
            extent.area += norm(area_vector(s, t));
    check_positive("area of the bottom", extent.area, "m^2");
    extent.height = mean_on(s, s.grains.reference, SolidSide::top)
        - mean_on(s, s.grains.reference, SolidSide::bottom);
    return extent;
}

SolidFrame solid_frame(const SolidState& s, Sense sense)
{
    const SolidExtent extent = extent_of(s);
    const double sign = sense == Sense::compression ? -1.0 : 1.0;
    SolidFrame frame;
    frame.area = extent.area;
    frame.height = extent.height;
    frame.sense = sense;
    frame.ends = end_forces;
    frame.strains = [sign, sense](const SolidState& now) {
        return TestStrains { sign * axial_strain(now), lateral_strain(now, sense) };
    };
    frame.confinement = [](const SolidState& now) { return side_pressures(now).least; };
    return frame;
}

SolidFrame solid_disc_frame(const SolidState& s, double diameter, double depth)
{
    check_positive("diameter", diameter, "m");
    check_positive("depth", depth, "m");
    const int lower = find_plate(s, SolidSide::bottom), upper = find_plate(s, SolidSide::top);
    if (lower < 0 || upper < 0) {
        refuse("solid_disc_frame: plates", static_cast<double>(s.plates.size()), "",
            "must be a lower and an upper one; add them first");
    }
    SolidFrame frame;
    frame.area = splitting_area(diameter, depth);
    frame.height = diameter;
    frame.ends = end_forces;
    frame.strains = [=](const SolidState& now) {
        const double closure = now.plates[lower].displacement.z - now.plates[upper].displacement.z;
        return TestStrains { closure / diameter, widening(now) / diameter };
    };
    return frame;
}

double lateral_strain(const SolidState& s, Sense sense)
{
    return lateral_strain(s, sense, s.grains.displacement);
}

double lateral_strain(const SolidState& s, Sense sense, const Array<double>& moved)
{
    const double extension = lateral_extension(s, moved);
    return sense == Sense::compression ? extension : -extension;
}

EndForces end_forces(const SolidState& s)
{
    return { end_force(s, SolidSide::bottom), end_force(s, SolidSide::top) };
}

ScaleInputs scale_inputs(const SolidState& s, Sense sense, double thickness, double dt)
{
    ScaleInputs in;
    in.modulus = mean_modulus(s);
    for (double m : s.grains.inverse_mass)
        in.mass += m > 0.0 ? 1.0 / m : 0.0;
    in.thickness = thickness;
    in.dt = dt;
    const std::vector<int>& joint = s.contacts.joint;
    take_bonds(in, s, sense, [&](int c) { return joint.empty() || joint[c] < 0; });
    return in;
}

TestScales solid_scales(const SolidState& s, Sense sense, double dt)
{
    const SolidExtent extent = extent_of(s);
    const double width = std::sqrt(extent.area);
    return rectangle_scales(scale_inputs(s, sense, width, dt), width, extent.height);
}

TestScales solid_disc_scales(const SolidState& s, double diameter, double depth, double dt)
{
    check_positive("diameter", diameter, "m");
    check_positive("depth", depth, "m");
    return disc_scales(scale_inputs(s, Sense::tension, depth, dt), diameter);
}

double ball_crossing_steps(const SolidState& s, double diameter, double dt)
{
    // the shape does not matter: a cube has the same volume
    const double edge = std::cbrt(volume_of(s));
    const ScaleInputs in = scale_inputs(s, Sense::compression, edge, dt);
    return rectangle_scales(in, edge, edge).crossing_steps * diameter / edge;
}

}  // namespace flexpm
