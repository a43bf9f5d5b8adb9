// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Words for the compiler that GCC and Clang spell differently or at length.
#pragma once

/// A function that becomes part of its caller, and with it of the caller's instruction set.
/// FLEXPM_ONE_COPY: it stays one function, and so do the variants for instruction sets, for builds
/// that count what runs. FLEXPM_INLINED says the same of a function without a name, behind its
/// parameters.
#ifdef FLEXPM_ONE_COPY
#define FLEXPM_INLINE inline
#define FLEXPM_INLINED
#else
#define FLEXPM_INLINE __attribute__((always_inline)) inline
#define FLEXPM_INLINED __attribute__((always_inline))
#endif

/// No iteration of the loop that follows reads what another one writes.
#ifdef __clang__
#define FLEXPM_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define FLEXPM_INDEPENDENT _Pragma("GCC ivdep")
#endif

/// Tell the core that a loop waits for another thread.
#if defined(__x86_64__) || defined(__i386__)
#define FLEXPM_PAUSE() __builtin_ia32_pause()
#else
#define FLEXPM_PAUSE() static_cast<void>(0)
#endif
