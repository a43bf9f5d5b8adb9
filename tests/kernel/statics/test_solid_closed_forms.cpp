// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Stiffly bonded solids are elastic bodies: their linear forces against closed forms.
#include "support/catch.hpp"

#include <flexpm/kernel/statics/solid_field.hpp>

#include "support/solid_states.hpp"

#include <functional>

using namespace solid_states;

namespace {

constexpr double radius = 15e-3, height = 9e-3;  // of the cylinder [m]
constexpr double edge = 12e-3;                   // of the cube [m]

/// Random packing with contacts a hundred times as stiff as those of Table 1.
LinearSolid stiff(const Solid& solid, int grains)
{
    SolidInput input = granite();
    input.contacts = { specimens::strong_contact(1.8e16) };
    const Polyhedra cells = polyhedra(
        flexpm_test::packed_spheres(solid, grains, 3), solid, { 0.1 * solid_samples::side, false });
    return linear_solid(make_solid(cells, solid, input));
}

/// Which axes of a node are held, and its way there.
struct Holding {
    std::array<bool, 3> axes;
    Vector way;
};

/// Forces on all nodes once those that are held have gone their ways.
std::vector<double> forces_of(
    const LinearSolid& solid, const std::function<Holding(Vector place)>& holding)
{
    const std::size_t size = 3 * solid.places.size();
    std::vector<std::uint8_t> held(size, 0);
    std::vector<double> u(size, 0.0), load(size, 0.0), forces(size, 0.0);
    for (std::size_t n = 0; n < solid.places.size(); ++n) {
        const Holding h = holding(solid.places[n]);
        const std::array<double, 3> way { h.way.x, h.way.y, h.way.z };
        for (int axis = 0; axis < 3; ++axis) {
            held[3 * n + axis] = h.axes[axis];
            if (h.axes[axis]) u[3 * n + axis] = way[axis];
        }
    }
    solid.add(u.data(), load.data());
    for (double& f : load)
        f = -f;
    const FreeSolution found = solve_free(solid, held, load, std::vector<double>(size, 0.0));
    for (std::size_t i = 0; i < size; ++i)
        u[i] += found.u[i];
    solid.add(u.data(), forces.data());
    return forces;
}

bool at(double place, double level) { return std::fabs(place - level) < 1e-9; }

}  // namespace

TEST_CASE("A cylinder twists as Saint-Venant says", "[solids][elastic_bodies]")
{
    const LinearSolid solid =
        stiff(Solid::cylinder(2.0 * radius, height, solid_samples::side), 420);
    constexpr double angle = 1e-6;
    const auto forces = forces_of(solid, [](Vector p) {
        const bool top = at(p.z, height);
        const double turn = top ? angle : 0.0;
        return Holding { { top || at(p.z, 0.0), top || at(p.z, 0.0), at(p.z, 0.0) },
            { -turn * p.y, turn * p.x, 0.0 } };
    });
    double moment = 0.0;
    for (std::size_t n = 0; n < solid.places.size(); ++n)
        if (at(solid.places[n].z, height))
            moment += solid.places[n].x * forces[3 * n + 1] - solid.places[n].y * forces[3 * n];
    const auto grain = specimens::granite();
    const double shear = grain.young / (2.0 * (1.0 + grain.poisson));
    const double polar = 0.5 * std::acos(-1.0) * std::pow(radius, 4);
    CHECK(moment == Approx(shear * polar * angle / height).epsilon(0.02));
}

TEST_CASE("A solid held sideways has the modulus of uniaxial strain", "[solids][elastic_bodies]")
{
    const LinearSolid solid = stiff(Solid::box(edge, edge, edge), 100);
    constexpr double strain = 1e-6;
    const auto forces = forces_of(solid, [](Vector p) {
        return Holding { { at(p.x, 0.0) || at(p.x, edge), at(p.y, 0.0) || at(p.y, edge),
                             at(p.z, 0.0) || at(p.z, edge) },
            { 0.0, 0.0, strain * p.z } };
    });
    double top = 0.0, right = 0.0;
    for (std::size_t n = 0; n < solid.places.size(); ++n) {
        if (at(solid.places[n].z, edge)) top += forces[3 * n + 2];
        if (at(solid.places[n].x, edge)) right += forces[3 * n];
    }
    const auto grain = specimens::granite();
    const double nu = grain.poisson;
    const double modulus = grain.young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    CHECK(top == Approx(modulus * strain * edge * edge).epsilon(0.01));
    CHECK(right == Approx(nu / (1.0 - nu) * modulus * strain * edge * edge).epsilon(0.01));
}
