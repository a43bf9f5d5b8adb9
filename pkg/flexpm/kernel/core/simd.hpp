// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Marks the leaf functions that are compiled for several instruction sets.
#pragma once

/// The variant is chosen when the library is loaded; without contraction of products and sums all
/// variants give the same bits.
#define FLEXPM_MULTIVERSION __attribute__((target_clones("avx512f", "avx2", "default")))

/// The same for a function that does better if it knows whether a register holds a row of eight values:
/// its body sees that as `Wide`.
#define FLEXPM_MULTIVERSION_WIDE(head, ...)                                                        \
    FLEXPM_VERSION("avx512f", true, head, __VA_ARGS__)                                             \
    FLEXPM_VERSION("avx2", false, head, __VA_ARGS__)                                               \
    FLEXPM_VERSION("default", false, head, __VA_ARGS__)
#define FLEXPM_VERSION(set, is_wide, head, ...)                                                    \
    __attribute__((target(set))) head                                                              \
    {                                                                                              \
        constexpr bool Wide = is_wide;                                                             \
        __VA_ARGS__                                                                                \
    }

namespace flexpm {

/// Some values of an array in one register, or in as many as an instruction set needs.
typedef double Two __attribute__((vector_size(16), may_alias));
typedef double Four __attribute__((vector_size(32), may_alias));
typedef double Eight __attribute__((vector_size(64), may_alias));

/// Transpose four times four values: `rows` apart from row to row, `columns` in the result.
__attribute__((always_inline)) inline void transpose(
    const double* from, int rows, double* to, int columns)
{
    typedef long long Which __attribute__((vector_size(32)));
    const auto row = [&](int i) { return reinterpret_cast<const Four*>(from + i * rows); };
    const auto column = [&](int i) { return reinterpret_cast<Four*>(to + i * columns); };
    const Which even = { 0, 4, 2, 6 }, odd = { 1, 5, 3, 7 };
    const Four a = __builtin_shuffle(*row(0), *row(1), even);
    const Four b = __builtin_shuffle(*row(0), *row(1), odd);
    const Four c = __builtin_shuffle(*row(2), *row(3), even);
    const Four d = __builtin_shuffle(*row(2), *row(3), odd);
    const Which low = { 0, 1, 4, 5 }, high = { 2, 3, 6, 7 };
    *column(0) = __builtin_shuffle(a, c, low);
    *column(1) = __builtin_shuffle(b, d, low);
    *column(2) = __builtin_shuffle(a, c, high);
    *column(3) = __builtin_shuffle(b, d, high);
}

/// Rows of x and of y of eight pairs at(0) to at(7). Rows that one register holds are stored at once: a
/// load of such a row would wait for two halves on their way to the cache. Without such registers the
/// compiler would store them value by value.
template <bool Wide, class Pair>
__attribute__((always_inline)) inline void unzip(Pair&& at, double* to)
{
    typedef long long Which __attribute__((vector_size(32)));
    const Which even = { 0, 4, 2, 6 }, odd = { 1, 5, 3, 7 };
    Four x[2], y[2];
    for (int half = 0; half < 2; ++half) {
        const int i = 4 * half;
        const Four a = __builtin_shufflevector(at(i), at(i + 2), 0, 1, 2, 3);
        const Four b = __builtin_shufflevector(at(i + 1), at(i + 3), 0, 1, 2, 3);
        x[half] = __builtin_shuffle(a, b, even);
        y[half] = __builtin_shuffle(a, b, odd);
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
