// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/erasure.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/crack_record.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>
#include <flexpm/kernel/topology/removal.hpp>

#include <algorithm>

namespace flexpm {

namespace {

/// Energies that an assembly has at a time; what an erasure takes is a difference of two.
struct Holding {
    double stored;   ///< [J]
    double kinetic;  ///< of the velocities, which are those of half a step later [J]
    ContactLoss loss;
};

Holding holding_of(const Assembly& a)
{
    double stored = strain_energy(a.grains) + contact_energy(a.contacts) + potential_energy(a);
    for (const Plate& p : a.plates)
        stored += elastic_energy(p);
    return { stored, kinetic_of_velocities(a.grains), contact_loss(a.contacts) };
}

/// Power of all forces on a grain [W].
double power_on(const Grains& grains, int grain)
{
    if (grains.is_rigid(grain)) {
        const Resultant on = resultant_on(grains, grain);
        return dot(on.force, grains.velocity_at(grains.centre(grain)))
            + on.moment.z * grains.spin[grains.slot[grain]];
    }
    double power = 0.0;
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        power += dot(grains.force_at(node), grains.velocity_at(node));
    }
    return power;
}

/// Power of a contact on its grains [W].
double power_of(const Assembly& a, int contact)
{
    double power = 0.0;
    for (int side = 0; side < 2; ++side) {
        for (int corner = 0; corner < a.contacts.corners_of(contact); ++corner) {
            power += dot(a.contacts.force(contact, side, corner),
                a.grains.velocity_at(a.contacts.node(contact, side, corner)));
        }
    }
    return power;
}

/// Power of the forces of loaded plates on these [W]. Plates whose velocity is given count the work
/// of a step in that step.
double power_on_plates(const Assembly& a)
{
    double power = 0.0;
    for (const Plate& p : a.plates) {
        if (p.loaded) power -= dot(p.force, p.velocity);
    }
    return power;
}

/// Places of the contacts that go, ascending.
std::vector<int> contacts_that_go(const Assembly& a, const Erasure& what)
{
    std::vector<int> places;
    for (int c = 0; c < a.contacts.count; ++c) {
        const auto [first, second] = a.contacts.pairs[c];
        const bool named = std::binary_search(what.contacts.begin(), what.contacts.end(), c);
        const bool goes = named || a.grains.erased[first] || a.grains.erased[second];
        if (goes && !a.contacts.erased[c]) places.push_back(c);
    }
    return places;
}

/// A bond stays as a record; returns whether the contact is one.
bool keep_record(Assembly& a, int contact)
{
    if (!a.contacts.bonded[contact]) return false;
    record_erasure(a, contact);
    a.contacts.erased[contact] = 1;
    return true;
}

}  // namespace

void erase(Assembly& a, const Erasure& what, double dt)
{
    if (what.empty()) return;
    const Holding before = holding_of(a);
    double power = power_on_plates(a);
    for (int grain : what.grains) {
        power += power_on(a.grains, grain);
        remove_grain(a, grain);
    }
    power -= power_on_plates(a);
    std::vector<int> touches;
    for (int contact : contacts_that_go(a, what)) {
        power += power_of(a, contact);
        if (!keep_record(a, contact)) touches.push_back(contact);
        remove_contact(a.contacts, contact);
    }
    const Holding after = holding_of(a);
    a.ledger.removed_damage += before.loss.damage - after.loss.damage;
    a.ledger.removed_friction += before.loss.friction - after.loss.friction;
    a.ledger.erased += before.stored - after.stored;
    // forces work over half a step with the velocities that they have brought about
    a.ledger.erased_next += before.kinetic - after.kinetic - 0.5 * dt * power;
    change_contacts(a, touches, {}, 0.0, 0.0);
    if (touches.empty()) prepare_step(a);
}

}  // namespace flexpm
