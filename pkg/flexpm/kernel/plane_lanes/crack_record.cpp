// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points that crack.
#include <flexpm/kernel/plane_lanes/crack_record.hpp>

#include <flexpm/kernel/assembly/access.hpp>

namespace flexpm {

namespace {

/// Where a point is now: the middle of its places on the two edges.
Point point_position(const Assembly& a, int contact, int point, double dt)
{
    const auto moved = [&](int node) {
        return a.grains.point_at(node) + dt * a.grains.velocity_at(node);
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
    return contacts.area(contact, point) * energy_of(contacts, contact, point).damage;
}

}  // namespace

void record_cracks(Assembly& a, int block, double dt, const std::uint8_t* cracked)
{
    Contacts& contacts = a.contacts;
    for (int p = 0; p < contacts.points_in(block); ++p) {
        for (int l = 0; l < lanes; ++l) {
            const int contact = block * lanes + l;
            if (!cracked[p * lanes + l] || contact >= contacts.count) continue;
            const bool opens = gap_of(contacts, contact, p) > 0.0;
            contacts.set_crack(contact, p,
                { static_cast<int>(a.step + 1), opens ? tensile_crack : shear_crack,
                    point_position(a, contact, p, dt), point_damage_energy(contacts, contact, p) });
        }
    }
}

void record_erasure(Assembly& a, int contact)
{
    Contacts& contacts = a.contacts;
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        if (contacts.crack(contact, p).mode != intact) continue;
        contacts.set_crack(contact, p,
            { static_cast<int>(a.step), erased_point, point_position(a, contact, p, 0.0),
                point_damage_energy(contacts, contact, p) });
        take_strength(contacts, contact, p);
    }
}

}  // namespace flexpm
