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

/// Rows of x, y and z of eight nodes; at(i, row) fills the row of a node. Rows that one register
/// holds are stored at once: a load of such a row would wait for two halves on their way to the
/// cache.
template <bool Wide, class At> FLEXPM_INLINE void to_lanes(At&& at, double* to)
{
    Four rows[3][2];
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
        rows[0][half] = __builtin_shufflevector(xz01, xz23, 0, 1, 4, 5);
        rows[1][half] = __builtin_shufflevector(y01, y23, 0, 1, 4, 5);
        rows[2][half] = __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7);
    }
    for (int axis = 0; axis < 3; ++axis) {
        if constexpr (Wide) {
            *reinterpret_cast<Eight*>(to + axis * lanes) =
                __builtin_shufflevector(rows[axis][0], rows[axis][1], 0, 1, 2, 3, 4, 5, 6, 7);
        } else {
            for (int half = 0; half < 2; ++half)
                row_of_four(to + axis * lanes + 4 * half) = rows[axis][half];
        }
    }
}

/// Call take(lane, row) with x y z 0 of each lane, from rows of x, y and z.
template <class Take> FLEXPM_INLINE void from_lanes(const double* from, Take&& take)
{
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
