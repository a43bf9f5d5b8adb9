// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "fuzz/bytes.hpp"
#include "fuzz/targets.hpp"
#include "fuzz/use_state.hpp"
#include "support/specimens.hpp"

#include <stdexcept>
#include <vector>

namespace fuzz {

namespace {

using flexpm::AssemblyOptions;

/// Numbers for each of `count` things, seldom for more or fewer.
template <class Whole> std::vector<Whole> draw_choices(Bytes& bytes, std::size_t count, int last)
{
    std::vector<Whole> choices;
    const int kind = bytes.byte();
    if (kind < 128) return choices;
    if (kind > 250) count += kind - 253;
    const bool wrong = bytes.byte() > 240;
    for (std::size_t i = 0; i < count; ++i)
        choices.push_back(static_cast<Whole>(bytes.whole(wrong ? -1 : 0, wrong ? last + 1 : last)));
    return choices;
}

flexpm::ElasticMaterial draw_elastic(Bytes& bytes)
{
    flexpm::ElasticMaterial m = specimens::granite();
    m.young = bytes.wild(m.young);
    m.poisson = bytes.wild(m.poisson);
    m.density = bytes.wild(m.density);
    if (bytes.flag()) m.plane = flexpm::Plane::strain;
    return m;
}

AssemblyOptions draw_options(Bytes& bytes, const flexpm::Tessellation& cells)
{
    AssemblyOptions o;
    o.thickness = bytes.wild(0.08);
    o.rigid = bytes.flag();
    o.mesh = bytes.flag() ? flexpm::MeshKind::fan : flexpm::MeshKind::refined;
    const int points = bytes.byte();
    o.points = points < 240 ? 1 + points % 3 : points - 247;
    o.on_centre_line = bytes.byte() > 200;
    const int kinds = bytes.byte() % 4, pairs = kinds * kinds;
    for (int i = 0; i < kinds; ++i)
        o.elastic.push_back(draw_elastic(bytes));
    const int kind = bytes.byte();
    const int laws = kind < 220 ? pairs : kind - 220;
    for (int i = 0; i < laws; ++i) {
        flexpm::ContactMaterial m = specimens::granite_contact();
        m.normal_stiffness = bytes.wild(m.normal_stiffness);
        m.tensile_strength = bytes.wild(m.tensile_strength);
        o.laws.push_back(m);
    }
    const std::size_t grains = cells.disc_of_cell.size(), edges = cells.shared_edges.size();
    o.grain_material = draw_choices<int>(bytes, grains, kinds - 1);
    o.parent = draw_choices<int>(bytes, grains, static_cast<int>(grains) - 1);
    o.edge_law = draw_choices<int>(bytes, edges, laws - 1);
    o.edge_normal = draw_choices<std::uint8_t>(bytes, edges, 1);
    return o;
}

void add_plates(Bytes& bytes, flexpm::Assembly& a)
{
    const flexpm::PlateContact contact = { bytes.wild(1e14), bytes.wild(0.3), bytes.flag() };
    switch (bytes.byte() % 4) {
    case 1:
        flexpm::add_side_plates(a, bytes.whole(-1, 5), bytes.whole(-1, 9), contact);
        return;
    case 2:
        flexpm::add_touching_plate(a, { bytes.wild(0.0), bytes.wild(1.0) }, contact);
        return;
    case 3:
        flexpm::add_wall(
            a, { 0.0, bytes.wild(-1.0) }, { bytes.wild(0.0), bytes.wild(1.0) }, contact);
        return;
    default:
        return;
    }
}

}  // namespace

void assemble(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    specimens::Specimen s =
        specimens::random_grains(6e-3 + 6e-3 * bytes.share(), 9e-3, 3e-3, bytes.byte());
    // a disc too few or none at all
    if (bytes.byte() > 250) s.discs.resize(s.discs.size() * (bytes.byte() % 2));
    try {
        flexpm::Assembly a = specimens::assemble(s, draw_options(bytes, s.cells));
        flexpm::check_state(a);
        add_plates(bytes, a);
        flexpm::scale_masses(a, bytes.wild(0.7));
        use_state(a);
    } catch (const std::invalid_argument&) {
    } catch (const std::runtime_error&) {
    }
}

}  // namespace fuzz
