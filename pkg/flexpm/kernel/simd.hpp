// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Marks the leaf functions that are compiled for several instruction sets.
#pragma once

/// The variant is chosen when the library is loaded; without contraction of products and sums all
/// variants give the same bits.
#define FLEXPM_MULTIVERSION __attribute__((target_clones("avx512f", "avx2", "default")))

namespace flexpm {

/// Some values of an array in one register, or in as many as an instruction set needs.
typedef double Two __attribute__((vector_size(16), may_alias));
typedef double Four __attribute__((vector_size(32), may_alias));

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

}  // namespace flexpm
