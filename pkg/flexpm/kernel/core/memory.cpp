// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/core/memory.hpp>

#include <malloc.h>

namespace flexpm {

void give_back_memory()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

}  // namespace flexpm
