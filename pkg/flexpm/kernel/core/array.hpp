// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Arrays that start on a cache line, and the number of grains or contacts in a block of
/// them.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace flexpm {

/// Number of grains (and of contacts) in a block, which are stepped together, one in each lane. It
/// is fixed, so that results do not depend on the instruction set chosen at run time.
constexpr int lanes = 8;

/// Allocator that begins on a cache line, so that a block of eight doubles never straddles two of
/// them.
template <class T> struct AlignedAllocator {
    using value_type = T;
    static constexpr std::align_val_t alignment { 64 };

    AlignedAllocator() = default;
    template <class U> AlignedAllocator(const AlignedAllocator<U>&) { }

    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
    void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }

    template <class U> bool operator==(const AlignedAllocator<U>&) const { return true; }
    template <class U> bool operator!=(const AlignedAllocator<U>&) const { return false; }
};

template <class T> using Array = std::vector<T, AlignedAllocator<T>>;

}  // namespace flexpm
