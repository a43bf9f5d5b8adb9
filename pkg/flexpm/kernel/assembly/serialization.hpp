// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The one list of what an assembly must keep to continue a run to the same bits.
#pragma once

namespace flexpm {

template <class GroupType, class Visitor> void visit_group(GroupType& g, Visitor&& visit)
{
    visit("vertices", g.vertices);
    visit("nodes", g.nodes);
    visit("triangles", g.triangles);
    visit("rigid", g.rigid);
}

template <class MaterialType, class Visitor> void visit_elastic(MaterialType& m, Visitor&& visit)
{
    visit("young", m.young);
    visit("poisson", m.poisson);
    visit("density", m.density);
    visit("plane", m.plane);
}

template <class LawType, class Visitor> void visit_law(LawType& p, Visitor&& visit)
{
    visit("normal_stiffness", p.normal_stiffness);
    visit("shear_stiffness", p.shear_stiffness);
    visit("tensile_strength", p.tensile_strength);
    visit("cohesion", p.cohesion);
    visit("friction", p.friction);
    visit("elastic_opening", p.elastic_opening);
    visit("critical_opening", p.critical_opening);
    visit("critical_slip", p.critical_slip);
    visit("opening_rate", p.opening_rate);
    visit("slip_rate", p.slip_rate);
}

/// Calls visit(array, rows, index) for all arrays with rows per contact; index(contact, row, rows) is the
/// place of a value.
template <class AssemblyType, class Visitor>
void visit_contact_rows(AssemblyType& a, Visitor&& visit)
{
    visit(a.contact_nodes, ContactRows::nodes, row_index);
    visit(a.weight, 2 * a.points, row_index);
    visit(a.area, a.points, row_index);
    visit(a.span, 2, row_index);
    visit(a.edge_reach, 2, row_index);
    visit(a.normal, 2, row_index);
    visit(a.point_state, a.points * ContactRows::state, row_index);
    visit(a.crack_step, a.points, row_index);
    visit(a.crack_mode, a.points, row_index);
    visit(a.crack_position, 2 * a.points, row_index);
    visit(a.contact_force, ContactRows::forces, record_index);
}

template <class AssemblyType, class Visitor> void visit_state(AssemblyType& a, Visitor&& visit)
{
    visit("grains", a.grains);
    visit("contacts", a.contacts);
    visit("edges", a.edges);
    visit("points", a.points);
    visit("thickness", a.thickness);
    visit("gravity_x", a.gravity.x);
    visit("gravity_y", a.gravity.y);
    visit("groups", a.groups);
    visit("block_group", a.block_group);
    visit("block_nodes", a.block_nodes);
    visit("block_triangles", a.block_triangles);
    visit("grain_slot", a.grain_slot);
    visit("slot_grain", a.slot_grain);
    visit("radius", a.radius);
    visit("aggregate", a.aggregate);
    visit("grain_material", a.grain_material);
    visit("elastic", a.elastic);
    visit("reference", a.reference);
    visit("displacement", a.displacement);
    visit("velocity", a.velocity);
    visit("force", a.force);
    visit("held", a.held);
    visit("inverse_mass", a.inverse_mass);
    visit("rotation", a.rotation);
    visit("spin", a.spin);
    visit("inverse_inertia", a.inverse_inertia);
    visit("spin_held", a.spin_held);
    visit("shape", a.shape);
    visit("stiffness", a.stiffness);
    visit("laws", a.laws);
    visit("contact_grains", a.contact_grains);
    visit("contact_law", a.contact_law);
    visit("contact_bonded", a.contact_bonded);
    visit("close_pairs", a.close_pairs);
    visit("contact_nodes", a.contact_nodes);
    visit("weight", a.weight);
    visit("area", a.area);
    visit("span", a.span);
    visit("edge_reach", a.edge_reach);
    visit("normal", a.normal);
    visit("point_state", a.point_state);
    visit("crack_step", a.crack_step);
    visit("crack_mode", a.crack_mode);
    visit("crack_position", a.crack_position);
    visit("contact_force", a.contact_force);
    visit("edge_grain", a.edge_grain);
    visit("edge_side", a.edge_side);
    visit("edge_pressure", a.edge_pressure);
    visit("edge_nodes", a.edge_nodes);
    visit("edge_force", a.edge_force);
    visit("plates", a.plates);
    visit("damping_work", a.damping_work);
    visit("driven_work", a.driven_work);
    visit("pressure_work", a.pressure_work);
    visit("past_damage", a.past_damage);
    visit("past_friction", a.past_friction);
    visit("initial_energy", a.initial_energy);
    visit("step", a.step);
    visit("kinetic", a.kinetic);
    visit("largest_force", a.largest_force);
}

}  // namespace flexpm
