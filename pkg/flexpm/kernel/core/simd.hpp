// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rows of values as vectors: shuffles that the compilers do not find by themselves.
#pragma once

#include <flexpm/kernel/core/compiler.hpp>

namespace flexpm {

/// Some values of an array in one register, or in as many as an instruction set needs.
typedef double Two __attribute__((vector_size(16), may_alias));
typedef double Four __attribute__((vector_size(32), may_alias));
typedef double Eight __attribute__((vector_size(64), may_alias));

/// Transpose four times four values: `rows` apart from row to row, `columns` in the result.
FLEXPM_INLINE void transpose(const double* from, int rows, double* to, int columns)
{
    const auto row = [&](int i) { return reinterpret_cast<const Four*>(from + i * rows); };
    const auto column = [&](int i) { return reinterpret_cast<Four*>(to + i * columns); };
    const Four a = __builtin_shufflevector(*row(0), *row(1), 0, 4, 2, 6);
    const Four b = __builtin_shufflevector(*row(0), *row(1), 1, 5, 3, 7);
    const Four c = __builtin_shufflevector(*row(2), *row(3), 0, 4, 2, 6);
    const Four d = __builtin_shufflevector(*row(2), *row(3), 1, 5, 3, 7);
    *column(0) = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    *column(1) = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    *column(2) = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    *column(3) = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// Rows of x and of y of eight pairs at(0) to at(7). Rows that one register holds are stored at
/// once: a load of such a row would wait for two halves on their way to the cache. Without such
/// registers the compiler would store them value by value.
template <bool Wide, class Pair> FLEXPM_INLINE void unzip(Pair&& at, double* to)
{
    Four x[2], y[2];
    for (int half = 0; half < 2; ++half) {
        const int i = 4 * half;
        const Four a = __builtin_shufflevector(at(i), at(i + 2), 0, 1, 2, 3);
        const Four b = __builtin_shufflevector(at(i + 1), at(i + 3), 0, 1, 2, 3);
        x[half] = __builtin_shufflevector(a, b, 0, 4, 2, 6);
        y[half] = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    }
    if constexpr (Wide) {
        Eight* rows = reinterpret_cast<Eight*>(to);
        rows[0] = __builtin_shufflevector(x[0], x[1], 0, 1, 2, 3, 4, 5, 6, 7);
        rows[1] = __builtin_shufflevector(y[0], y[1], 0, 1, 2, 3, 4, 5, 6, 7);
    } else {
        Four* rows = reinterpret_cast<Four*>(to);
        for (int half = 0; half < 2; ++half) {
            rows[half] = x[half];
            rows[2 + half] = y[half];
        }
    }
}

}  // namespace flexpm
