// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Nodes of space, x y z 0 in a register of four, and their components in rows of lanes.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/simd.hpp>
#include <flexpm/kernel/core/space_vector.hpp>

namespace flexpm {

/// Values of a vector in lanes: rows of x, of y and of z.
constexpr int vector_rows = 3 * lanes;

FLEXPM_INLINE Vector load_vector(const double* rows, int l)
{
    return { rows[l], rows[lanes + l], rows[2 * lanes + l] };
}
FLEXPM_INLINE void store_vector(Vector v, double* rows, int l)
{
    rows[l] = v.x;
    rows[lanes + l] = v.y;
    rows[2 * lanes + l] = v.z;
}

FLEXPM_INLINE const Four& row_of_four(const double* values)
{
    return *reinterpret_cast<const Four*>(values);
}
FLEXPM_INLINE Four& row_of_four(double* values) { return *reinterpret_cast<Four*>(values); }

/// Rows of x, y and z of eight nodes; at(i, row) fills the row of a node.
template <bool Wide, class At> FLEXPM_INLINE void to_lanes(At&& at, double* to)
{
    if constexpr (Wide) {
        const auto fill = [&](int i, Eight& two) FLEXPM_INLINED {
            Four a, b;
            at(i, a);
            at(i + 1, b);
            two = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
        };
        Eight r01, r23, r45, r67;  // x y z 0 of two nodes each
        fill(0, r01);
        fill(2, r23);
        fill(4, r45);
        fill(6, r67);
        const Eight xy03 = __builtin_shufflevector(r01, r23, 0, 4, 8, 12, 1, 5, 9, 13);
        const Eight xy47 = __builtin_shufflevector(r45, r67, 0, 4, 8, 12, 1, 5, 9, 13);
        const Eight z03 = __builtin_shufflevector(r01, r23, 2, 6, 10, 14, 3, 7, 11, 15);
        const Eight z47 = __builtin_shufflevector(r45, r67, 2, 6, 10, 14, 3, 7, 11, 15);
        Eight* rows = reinterpret_cast<Eight*>(to);
        rows[0] = __builtin_shufflevector(xy03, xy47, 0, 1, 2, 3, 8, 9, 10, 11);
        rows[1] = __builtin_shufflevector(xy03, xy47, 4, 5, 6, 7, 12, 13, 14, 15);
        rows[2] = __builtin_shufflevector(z03, z47, 0, 1, 2, 3, 8, 9, 10, 11);
        return;
    }
    for (int half = 0; half < 2; ++half) {
        const int i = 4 * half;
        Four r0, r1, r2, r3;
        at(i, r0);
        at(i + 1, r1);
        at(i + 2, r2);
        at(i + 3, r3);
        const Four xz01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
        const Four y01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
        const Four xz23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
        const Four y23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
        row_of_four(to + i) = __builtin_shufflevector(xz01, xz23, 0, 1, 4, 5);
        row_of_four(to + lanes + i) = __builtin_shufflevector(y01, y23, 0, 1, 4, 5);
        row_of_four(to + 2 * lanes + i) = __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7);
    }
}

/// Call take(lane, row) with x y z 0 of each lane in its order, from rows of x, y and z.
template <bool Wide, class Take> FLEXPM_INLINE void from_lanes(const double* from, Take&& take)
{
    if constexpr (Wide) {
        const Eight* all = reinterpret_cast<const Eight*>(from);
        const Eight x = all[0], y = all[1], z = all[2], none {};
        const Eight xy_even = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
        const Eight xy_odd = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
        const Eight z_even = __builtin_shufflevector(z, none, 0, 8, 2, 10, 4, 12, 6, 14);
        const Eight z_odd = __builtin_shufflevector(z, none, 1, 9, 3, 11, 5, 13, 7, 15);
        const Eight r02 = __builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9, 2, 3, 10, 11);
        const Eight r46 = __builtin_shufflevector(xy_even, z_even, 4, 5, 12, 13, 6, 7, 14, 15);
        const Eight r13 = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9, 2, 3, 10, 11);
        const Eight r57 = __builtin_shufflevector(xy_odd, z_odd, 4, 5, 12, 13, 6, 7, 14, 15);
        take(0, __builtin_shufflevector(r02, r02, 0, 1, 2, 3));
        take(1, __builtin_shufflevector(r13, r13, 0, 1, 2, 3));
        take(2, __builtin_shufflevector(r02, r02, 4, 5, 6, 7));
        take(3, __builtin_shufflevector(r13, r13, 4, 5, 6, 7));
        take(4, __builtin_shufflevector(r46, r46, 0, 1, 2, 3));
        take(5, __builtin_shufflevector(r57, r57, 0, 1, 2, 3));
        take(6, __builtin_shufflevector(r46, r46, 4, 5, 6, 7));
        take(7, __builtin_shufflevector(r57, r57, 4, 5, 6, 7));
        return;
    }
    for (int half = 0; half < 2; ++half) {
        const int i = 4 * half;
        const Four x = row_of_four(from + i), y = row_of_four(from + lanes + i),
                   z = row_of_four(from + 2 * lanes + i), none {};
        Four rows[4];
        const Four xy02 = __builtin_shufflevector(x, y, 0, 4, 2, 6);
        const Four xy13 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
        const Four z02 = __builtin_shufflevector(z, none, 0, 4, 2, 6);
        const Four z13 = __builtin_shufflevector(z, none, 1, 5, 3, 7);
        rows[0] = __builtin_shufflevector(xy02, z02, 0, 1, 4, 5);
        rows[1] = __builtin_shufflevector(xy13, z13, 0, 1, 4, 5);
        rows[2] = __builtin_shufflevector(xy02, z02, 2, 3, 6, 7);
        rows[3] = __builtin_shufflevector(xy13, z13, 2, 3, 6, 7);
        for (int l = 0; l < 4; ++l)
            take(i + l, rows[l]);
    }
}

}  // namespace flexpm
