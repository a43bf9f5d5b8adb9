// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/core/memory.hpp>

#include <malloc.h>
#include <sys/mman.h>

namespace flexpm {

void give_back_memory()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

void ask_for_large_pages(void* first, std::size_t bytes) { madvise(first, bytes, MADV_HUGEPAGE); }

}  // namespace flexpm
