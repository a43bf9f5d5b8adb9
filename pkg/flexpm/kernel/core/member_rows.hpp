// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Structs of numbers kept as rows, one lane of which is one struct: a row for each member,
/// `lanes` values apart, in the order in which the struct's visit_members() names them. That list
/// is the only one.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/compiler.hpp>

namespace flexpm {

/// Number of the members that a struct lists; all of them are doubles.
template <class Part> constexpr int count_members()
{
    const Part part {};
    int count = 0;
    Part::visit_members(part, [&](const char*, const double&) { ++count; });
    return count;
}

/// Row of a member.
template <class Part> constexpr int member_row(double Part::*member)
{
    const Part part {};
    int row = 0, found = -1;
    Part::visit_members(part, [&](const char*, const double& value) {
        if (&value == &(part.*member)) found = row;
        ++row;
    });
    return found;
}

/// The same as constants, for rows that lanes read one by one.
template <class Part> constexpr int row_count = count_members<Part>();
template <auto member> constexpr int row_of = member_row(member);

template <class Part> FLEXPM_INLINE Part load_rows(const double* rows, int lane)
{
    static_assert(sizeof(Part) == row_count<Part> * sizeof(double), "a row for each member");
    Part part;
    const double* from = rows + lane;
    Part::visit_members(part, [&](const char*, double& value) FLEXPM_INLINED {
        value = *from;
        from += lanes;
    });
    return part;
}

template <class Part> FLEXPM_INLINE void store_rows(const Part& part, double* rows, int lane)
{
    static_assert(sizeof(Part) == row_count<Part> * sizeof(double), "a row for each member");
    double* to = rows + lane;
    Part::visit_members(part, [&](const char*, const double& value) FLEXPM_INLINED {
        *to = value;
        to += lanes;
    });
}

}  // namespace flexpm
