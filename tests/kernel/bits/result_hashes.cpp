// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A hash for each of the kernel's results, one a line, on every instruction set: builds of
/// two compilers must print the same. Geometry first: what follows is made of it.
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/geometry/disc_sizes.hpp>
#include <flexpm/kernel/geometry/insertion.hpp>
#include <flexpm/kernel/geometry/subdivision.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/preload.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/specimen_strain.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include "support/sample_runs.hpp"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

using flexpm::Assembly;
using flexpm::Disc;
using flexpm::Outline;
using flexpm::Tessellation;

namespace {

/// FNV-1a over the bytes of numbers.
class Hash {
public:
    void add(const void* from, std::size_t bytes)
    {
        const auto* byte = static_cast<const unsigned char*>(from);
        for (std::size_t i = 0; i < bytes; ++i)
            value = (value ^ byte[i]) * 0x100000001b3;
    }
    /// For types without padding, whose bytes say nothing.
    template <class T> void add(const std::vector<T>& values)
    {
        static_assert(std::has_unique_object_representations_v<
                          T> || std::is_same_v<T, double> || std::is_same_v<T, flexpm::Point>,
            "bytes of a value");
        add(values.data(), values.size() * sizeof(T));
    }
    void add(double number) { add(&number, sizeof number); }

    std::uint64_t value = 0xcbf29ce484222325;
};

void add_state(Hash& hash, const Assembly& a)
{
    for (const auto& [name, bytes] : same_bits::bytes(a)) {
        hash.add(name.data(), name.size());
        hash.add(bytes.data(), bytes.size());
    }
}

void print(const std::string& name, const Hash& hash)
{
    std::printf("%016llx  %s\n", static_cast<unsigned long long>(hash.value), name.c_str());
}

void print_cells(const std::string& name, const Tessellation& t)
{
    Hash hash;
    hash.add(t.vertices);
    hash.add(t.cell_vertices);
    hash.add(t.shared_edges);
    hash.add(t.boundary_edges);
    print(name, hash);
}

/// Grains of a packing that has only been inserted, and their inner particles.
void print_geometry(const std::string& name, const Outline& outline, double area)
{
    const double d_min = 2e-3, d_max = 4e-3;  // [m]
    const int count = flexpm::disc_count(area, d_min, d_max, 0.3);
    const std::vector<double> radii = flexpm::disc_radii(count, d_min, d_max, 3);
    std::vector<Disc> discs;
    for (const flexpm::Point& centre : flexpm::insert_discs(radii, outline, 0.6, 5))
        discs.push_back({ centre, radii[discs.size()] });
    Hash hash;
    for (const Disc& disc : discs) {
        hash.add(disc.centre.x);
        hash.add(disc.centre.y);
        hash.add(disc.radius);
    }
    print("discs in a " + name, hash);
    flexpm::TessellationOptions o;
    o.short_edge = 0.35e-3;
    o.allow_hidden = true;
    const Tessellation cells = flexpm::tessellate(discs, outline, o);
    print_cells("cells in a " + name, cells);
    print_cells("inner particles in a " + name, flexpm::make_inner_cells(cells, 8.0).cells);
}

void print_elastic()
{
    const auto grains = specimens::random_grains(12e-3, 15e-3, 3e-3, 9);
    for (bool rigid : { false, true }) {
        flexpm::AssemblyOptions o = specimens::options();
        o.rigid = rigid;
        const flexpm::ElasticConstants found =
            flexpm::elastic_constants(specimens::assemble(grains, o));
        Hash hash;
        hash.add(found.youngs_modulus);
        hash.add(found.poissons_ratio);
        print(rigid ? "elastic constants, rigid" : "elastic constants", hash);
    }
    Assembly a = specimens::assemble(grains, specimens::options());
    flexpm::scale_masses(a, 0.7);
    flexpm::grip_bottom(a);
    flexpm::move_top(a, -1e-8);
    const std::vector<int> held = flexpm::preload(a, { 0.5, 50, 1.0 });
    sample_runs::step(a, 50);
    flexpm::release_preload(a, held, -1e-8, 1.0, false);
    sample_runs::step(a, 50);
    const flexpm::SpecimenStrain strain = flexpm::specimen_strain(a);
    Hash hash;
    add_state(hash, a);
    hash.add(strain.axial);
    hash.add(strain.lateral);
    print("preload along the elastic solution", hash);
}

void print_run(const sample_runs::Run& run, flexpm::InstructionSet set)
{
    const Assembly a = run.end_state();
    Hash hash;
    add_state(hash, a);
    const flexpm::Energies e = flexpm::energies(a);
    for (double part : { e.kinetic, e.elastic, e.damage, e.friction, e.damping, e.potential,
             e.boundary_work, e.initial, flexpm::unbalanced_ratio(a) }) {
        hash.add(part);
    }
    const flexpm::Snapshot seen = flexpm::take_snapshot(a);
    hash.add(seen.positions);
    hash.add(seen.element_stress);
    hash.add(seen.point_traction);
    hash.add(seen.crack_position);
    print(run.name + ", " + flexpm::name_of(set), hash);
}

}  // namespace

int main()
{
    try {
        const double width = 20e-3, height = 30e-3;  // [m]
        print_geometry("rectangle",
            Outline::polygon({ { 0.0, 0.0 }, { width, 0.0 }, { width, height }, { 0.0, height } }),
            width * height);
        print_geometry("circle", Outline::circle({ 0.0, 0.0 }, width), 3.14 * width * width);
        print_elastic();
        for (const flexpm::InstructionSet set : flexpm::available_instruction_sets()) {
            flexpm::use_instruction_set(set);
            for (const sample_runs::Run& run : sample_runs::all())
                print_run(run, set);
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "result_hashes: %s\n", error.what());
        return 1;
    }
}
