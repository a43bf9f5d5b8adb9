// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rows of contact points: state and law of a point in one lane of rows that lie `lanes` values apart.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/law/bilinear.hpp>

#include <cstddef>

namespace flexpm {

/// Rows of a point's state: the members of PointState in their order.
struct PointRow {
    enum : int {
        opening,
        max_opening,
        shear_traction,
        slip,
        shear_damage,
        damage_energy,
        friction_energy,
        count
    };
};

/// Rows of a point's law: the members of LawParameters in their order.
struct LawRow {
    enum : int {
        normal_stiffness,
        shear_stiffness,
        tensile_strength,
        cohesion,
        friction,
        elastic_opening,
        critical_opening,
        critical_slip,
        inverse_softening_length,
        slip_compliance,
        dilation_compliance,
        dilation_limit,
        count
    };
};

static_assert(sizeof(PointState) == PointRow::count * sizeof(double), "a row for each member");
static_assert(sizeof(LawParameters) == LawRow::count * sizeof(double), "a row for each member");

FLEXPM_INLINE PointState load_state(const double* rows, int lane)
{
    const auto at = [r = rows + lane](int row) { return r[row * lanes]; };
    return { at(PointRow::opening), at(PointRow::max_opening), at(PointRow::shear_traction),
        at(PointRow::slip), at(PointRow::shear_damage), at(PointRow::damage_energy),
        at(PointRow::friction_energy) };
}

FLEXPM_INLINE void store_state(const PointState& s, double* rows, int lane)
{
    double* r = rows + lane;
    r[PointRow::opening * lanes] = s.opening;
    r[PointRow::max_opening * lanes] = s.max_opening;
    r[PointRow::shear_traction * lanes] = s.shear_traction;
    r[PointRow::slip * lanes] = s.slip;
    r[PointRow::shear_damage * lanes] = s.shear_damage;
    r[PointRow::damage_energy * lanes] = s.damage_energy;
    r[PointRow::friction_energy * lanes] = s.friction_energy;
}

FLEXPM_INLINE LawParameters load_law(const double* rows, int lane)
{
    const auto at = [r = rows + lane](int row) { return r[row * lanes]; };
    return { at(LawRow::normal_stiffness), at(LawRow::shear_stiffness),
        at(LawRow::tensile_strength), at(LawRow::cohesion), at(LawRow::friction),
        at(LawRow::elastic_opening), at(LawRow::critical_opening), at(LawRow::critical_slip),
        at(LawRow::inverse_softening_length), at(LawRow::slip_compliance),
        at(LawRow::dilation_compliance), at(LawRow::dilation_limit) };
}

inline void store_law(const LawParameters& p, double* rows, int lane)
{
    double* r = rows + lane;
    r[LawRow::normal_stiffness * lanes] = p.normal_stiffness;
    r[LawRow::shear_stiffness * lanes] = p.shear_stiffness;
    r[LawRow::tensile_strength * lanes] = p.tensile_strength;
    r[LawRow::cohesion * lanes] = p.cohesion;
    r[LawRow::friction * lanes] = p.friction;
    r[LawRow::elastic_opening * lanes] = p.elastic_opening;
    r[LawRow::critical_opening * lanes] = p.critical_opening;
    r[LawRow::critical_slip * lanes] = p.critical_slip;
    r[LawRow::inverse_softening_length * lanes] = p.inverse_softening_length;
    r[LawRow::slip_compliance * lanes] = p.slip_compliance;
    r[LawRow::dilation_compliance * lanes] = p.dilation_compliance;
    r[LawRow::dilation_limit * lanes] = p.dilation_limit;
}

}  // namespace flexpm
