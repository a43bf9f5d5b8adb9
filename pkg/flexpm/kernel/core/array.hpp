// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Arrays that start on a cache line, and the number of grains or contacts in a block of
/// them.
#pragma once

#include <flexpm/kernel/core/memory.hpp>

#include <cstddef>
#include <new>
#include <vector>

namespace flexpm {

/// Number of grains (and of contacts) in a block, which are stepped together, one in each lane. It
/// is fixed, so that results do not depend on the instruction set chosen at run time.
constexpr int lanes = 8;

/// Allocator that begins on a cache line, so that a block of eight doubles never straddles two of
/// them. Large arrays begin on a page of 2 MB and ask Linux for such pages: a step that streams
/// through them waits less for addresses.
template <class T> struct AlignedAllocator {
    using value_type = T;
    static constexpr std::size_t line = 64, large_page = std::size_t(1) << 21;

    AlignedAllocator() = default;
    template <class U> AlignedAllocator(const AlignedAllocator<U>&) { }

    static std::align_val_t alignment(std::size_t n)
    {
        return std::align_val_t { n * sizeof(T) < 2 * large_page ? line : large_page };
    }
    T* allocate(std::size_t n)
    {
        void* const p = ::operator new(n * sizeof(T), alignment(n));
        if (n * sizeof(T) >= 2 * large_page) ask_for_large_pages(p, n * sizeof(T));
        return static_cast<T*>(p);
    }
    void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }

    template <class U> bool operator==(const AlignedAllocator<U>&) const { return true; }
    template <class U> bool operator!=(const AlignedAllocator<U>&) const { return false; }
};

template <class T> using Array = std::vector<T, AlignedAllocator<T>>;

}  // namespace flexpm
