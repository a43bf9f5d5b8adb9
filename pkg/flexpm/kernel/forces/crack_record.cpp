// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points that crack.
#include <flexpm/kernel/forces/crack_record.hpp>

namespace flexpm {

namespace {

/// Where a point is now: the middle of its places on the two edges.
Point point_position(const Assembly& a, int contact, int point, double dt)
{
    const auto moved = [&](int node) {
        return a.grains.position(node) + dt * a.grains.velocity_at(node);
    };
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const auto [n0, n1] = a.contacts.edge(contact, side);
        const double w = a.contacts.weight(contact, point, side);
        sum = sum + 0.5 * ((1.0 - w) * moved(n0) + w * moved(n1));
    }
    return sum;
}

/// What a point that is about to lose its bond has dissipated by damage.
double point_damage_energy(const Contacts& contacts, int contact, int point)
{
    return contacts.area(contact, point)
        * contacts.state(contact, point, &PointState::damage_energy);
}

}  // namespace

void record_cracks(Assembly& a, int block, double dt, const std::uint8_t* cracked)
{
    Contacts& contacts = a.contacts;
    for (int p = 0; p < contacts.points_in(block); ++p) {
        for (int l = 0; l < lanes; ++l) {
            const int contact = block * lanes + l;
            if (!cracked[p * lanes + l] || contact >= contacts.count) continue;
            const int index = contacts.point_index(contact, p);
            const bool opens =
                law::gap(contacts.law_of(contact), contacts.point_state(contact, p)) > 0.0;
            contacts.crack_steps[index] = static_cast<int>(a.step + 1);
            contacts.crack_modes[index] = opens ? tensile_crack : shear_crack;
            contacts.set_crack_position(contact, p, point_position(a, contact, p, dt));
            contacts.crack_energies[index] = point_damage_energy(contacts, contact, p);
        }
    }
}

void record_erasure(Assembly& a, int contact)
{
    Contacts& contacts = a.contacts;
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const int index = contacts.point_index(contact, p);
        if (contacts.crack_modes[index] != intact) continue;
        contacts.crack_steps[index] = static_cast<int>(a.step);
        contacts.crack_modes[index] = erased_point;
        contacts.set_crack_position(contact, p, point_position(a, contact, p, 0.0));
        contacts.crack_energies[index] = point_damage_energy(contacts, contact, p);
        contacts.state(contact, p, &PointState::shear_damage) = 1.0;  // nothing is left to crack
    }
}

}  // namespace flexpm
