// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Every state that the kernel makes passes the check of saved states, and each kind of
/// damage is refused.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/topology/erasure.hpp>

#include "support/sample_runs.hpp"

#include <functional>

using flexpm::Assembly;

TEST_CASE("The states of all sample runs pass the check of saved states")
{
    for (const sample_runs::Run& run : sample_runs::all()) {
        INFO(run.name);
        CHECK_NOTHROW(flexpm::check_state(run.end_state()));
    }
    CHECK_NOTHROW(flexpm::check_state(Assembly()));
    Assembly erased = sample_runs::squeezed(false);
    flexpm::erase(erased, { { 2, 5 }, { 0 } }, 1.0);
    sample_runs::step(erased, 20);
    CHECK_NOTHROW(flexpm::check_state(erased));
}

TEST_CASE("A damaged state is refused by the part that does not fit")
{
    struct Damage {
        const char* message;
        std::function<void(Assembly&)> make;
    };
    const Damage damages[] = {
        { "grains = -1", [](Assembly& a) { a.grains.count = -1; } },
        { "components of a vector", [](Assembly& a) { a.grains.layout.dimension = 3; } },
        { "values to the next node", [](Assembly& a) { a.grains.layout.node_stride = 4; } },
        { "slots of grains", [](Assembly& a) { ++a.grains.count; } },
        { "slot of a grain", [](Assembly& a) { a.grains.slot[3] = 4096; } },
        { "grain in a slot", [](Assembly& a) { std::swap(a.grains.slot[0], a.grains.slot[1]); } },
        { "slots with a grain",
            [](Assembly& a) {
                for (int& grain : a.grains.in_slot)
                    grain = grain < 0 ? 0 : grain;
            } },
        { "mesh of a block", [](Assembly& a) { a.grains.block_group[0] = 99; } },
        { "place of nodes", [](Assembly& a) { a.grains.block_nodes[1] += 8; } },
        { "place of triangles", [](Assembly& a) { a.grains.block_triangles[1] += 8; } },
        { "corners of a grain", [](Assembly& a) { a.grains.groups[0].vertices = 2; } },
        { "nodes of a grain", [](Assembly& a) { a.grains.groups[0].nodes = 3; } },
        { "node of a triangle", [](Assembly& a) { a.grains.groups[0].triangles[4] = 99; } },
        { "nodes of a triangle = 2", [](Assembly& a) { a.grains.groups[0].triangles.pop_back(); } },
        { "nodes of a rigid grain", [](Assembly& a) { a.grains.groups[0].rigid = true; } },
        { "values of nodes", [](Assembly& a) { a.grains.velocity.pop_back(); } },
        { "masses", [](Assembly& a) { a.grains.inverse_mass.clear(); } },
        { "rotations", [](Assembly& a) { a.grains.spin.clear(); } },
        { "values of grains", [](Assembly& a) { a.grains.radius.pop_back(); } },
        { "values of grains", [](Assembly& a) { a.grains.erased.clear(); } },
        { "values of contacts", [](Assembly& a) { a.contacts.erased.clear(); } },
        { "material of a grain", [](Assembly& a) { a.grains.material[0] = 1; } },
        { "grain of a particle", [](Assembly& a) { a.grains.parent[0] = -1; } },
        { "corners of a contact", [](Assembly& a) { a.contacts.group.corners = 3; } },
        { "points of a contact", [](Assembly& a) { a.contacts.group.points = 4; } },
        { "rows of contacts", [](Assembly& a) { a.contacts.group.points = 2; } },
        { "values of contacts", [](Assembly& a) { a.contacts.law.pop_back(); } },
        { "laws of contacts", [](Assembly& a) { a.contacts.laws.clear(); } },
        { "law of a contact", [](Assembly& a) { a.contacts.law[0] = -1; } },
        { "number of a contact", [](Assembly& a) { a.contacts.next_id = 1; } },
        { "first grain of a pair", [](Assembly& a) { a.contacts.pairs[0][0] = 99; } },
        { "second grain of a pair", [](Assembly& a) { a.contacts.pairs[0][1] = 99; } },
        { "node of a contact", [](Assembly& a) { ++a.contacts.nodes[0]; } },
        { "place of a centre",
            [](Assembly& a) { a.contacts.nodes[flexpm::NodeRow::centre_b * flexpm::lanes] = -2; } },
        { "mode of a crack", [](Assembly& a) { a.contacts.crack_modes[0] = 4; } },
        { "values of boundary edges", [](Assembly& a) { ++a.facets.count; } },
        { "grain of a boundary edge", [](Assembly& a) { a.facets.grain[0] = -1; } },
        { "edge", [](Assembly& a) { a.facets.node_offsets[0] = 1 << 20; } },
        { "edge of a plate", [](Assembly& a) { a.plates[0].points[0].facet = a.facets.count; } },
        { "works of damping", [](Assembly& a) { a.ledger.damping_work.pop_back(); } },
        { "kinetic energies", [](Assembly& a) { a.ledger.kinetic.clear(); } },
        { "step = -1", [](Assembly& a) { a.step = -1; } },
    };
    const Assembly sound = sample_runs::squeezed(false);
    for (const Damage& damage : damages) {
        INFO(damage.message);
        Assembly a = sound;
        damage.make(a);
        CHECK_THROWS_WITH(flexpm::check_state(a),
            Catch::Contains("saved state: ") && Catch::Contains(damage.message)
                && Catch::Contains("the file is damaged, build and run the specimen again"));
    }
}
