// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Marks the leaf functions that are compiled for several instruction sets.
#pragma once

/// The variant is chosen when the library is loaded; without contraction of products and sums all
/// variants give the same bits.
#define FLEXPM_MULTIVERSION __attribute__((target_clones("avx512f", "avx2", "default")))
