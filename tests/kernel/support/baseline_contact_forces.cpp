// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  contact_forces.cpp without its variants for wider instruction sets.
#include "support/baseline_step.hpp"

#include <flexpm/kernel/core/simd.hpp>
#include <flexpm/kernel/forces/contact_forces.hpp>

#undef FLEXPM_MULTIVERSION
#define FLEXPM_MULTIVERSION
#undef FLEXPM_MULTIVERSION_WIDE
#define FLEXPM_MULTIVERSION_WIDE(head, ...)                                                        \
    head                                                                                           \
    {                                                                                              \
        constexpr bool Wide = false;                                                               \
        __VA_ARGS__                                                                                \
    }
#define update_contact_blocks baseline_update_contact_blocks
#include "../../../pkg/flexpm/kernel/forces/contact_forces.cpp"
