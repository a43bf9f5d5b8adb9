// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_masses.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/fem/tetrahedron.hpp>
#include <flexpm/kernel/solids/tetrahedron_forces.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include <algorithm>
#include <cmath>

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

void add_contact(const SolidState& s, int contact, Array<double>& bound)
{
    const FaceContacts& c = s.contacts;
    const LawParameters& law = c.law_of(contact);
    const double stiffness = std::max(law.normal_stiffness, law.shear_stiffness);
    for (int p = 0; p < c.points_of(contact); ++p) {
        double sizes = 0.0;
        for (int k = 0; k < c.corners_of(contact); ++k)
            sizes += std::fabs(c.share(contact, p, k));
        const double all = c.area(contact, p) * stiffness * (sizes + sizes);
        for (int side = 0; side < 2; ++side) {
            for (int k = 0; k < c.corners_of(contact); ++k) {
                bound[s.grains.scalar_index(c.node(contact, side, k))] +=
                    std::fabs(c.share(contact, p, k)) * all;
            }
        }
    }
}

}  // namespace

Array<double> stiffness_bound(const SolidState& s)
{
    Array<double> bound(s.grains.inverse_mass.size(), 0.0);
    for (int block = 0; block < s.grains.blocks(); ++block)
        add_tetrahedra(s, block, bound);
    for (int c = 0; c < s.contacts.count; ++c)
        add_contact(s, c, bound);
    return bound;
}

void scale_masses(SolidState& s, double damping, double dt)
{
    check_damping(damping);
    check_positive("time step", dt, "s");
    const Array<double> bound = stiffness_bound(s);
    const double factor = mass_margin * (1.0 + damping) * dt * dt / 4.0;
    for_each_node(s, [&](int grain, int number) {
        const int i = s.grains.scalar_index(s.grains.node(grain, number));
        s.grains.inverse_mass[i] = 1.0 / (factor * bound[i]);
    });
}

void set_real_masses(SolidState& s)
{
    Array<double> mass(s.grains.inverse_mass.size(), 0.0);
    for (int g = 0; g < s.grains.count; ++g) {
        const double density = s.grains.elastic[s.grains.material[g]].density;
        for_each_tetrahedron(
            s, s.grains.block_of(g), [&](const TetrahedronShape& t, std::array<int, 4> nodes) {
                for (int n : nodes)
                    mass[s.grains.scalar_index(n)] += 0.25 * density * t.volume;
            });
    }
    for_each_node(s, [&](int grain, int number) {
        const int i = s.grains.scalar_index(s.grains.node(grain, number));
        s.grains.inverse_mass[i] = 1.0 / mass[i];
    });
}

double stable_step(const SolidState& s, double damping)
{
    check_damping(damping);
    const Array<double> bound = stiffness_bound(s);
    double most = 0.0;  // of stiffness / mass
    for (std::size_t i = 0; i < bound.size(); ++i)
        most = std::max(most, bound[i] * s.grains.inverse_mass[i]);
    return 2.0 / std::sqrt(mass_margin * (1.0 + damping) * most);
}

}  // namespace flexpm
