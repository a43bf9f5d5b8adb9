# SPDX-License-Identifier: GPL-3.0-or-later
# Language, flags and compiler cache common to all targets.

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
endif()
# No -DNDEBUG: asserts sit outside hot loops and guard the scheme's own invariants.
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# Never -march or -ffast-math, here or at link time: they change the layout of Eigen's and YADE's classes,
# leak through inline functions into code that must run everywhere, and flush denormals process-wide.
if("${CMAKE_CXX_FLAGS} ${CMAKE_SHARED_LINKER_FLAGS}" MATCHES "-march=|-ffast-math|-Ofast")
    message(FATAL_ERROR "compiler flags = ${CMAKE_CXX_FLAGS}, must not hold -march, -Ofast or -ffast-math; remove them")
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # Without the sloppiness ccache gives up on sources that use a precompiled header. Paths are hashed relative to
    # the sources, so that one checkout is served by what another one has compiled.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
        CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true ${CCACHE_PROGRAM})
endif()

add_library(flexpm_warnings INTERFACE)
target_compile_options(flexpm_warnings INTERFACE -Wall -Wextra $<$<BOOL:${FLEXPM_WERROR}>:-Werror>)
# Clang warns of a loop that it was asked to vectorise and did not: an error in a build that optimises.
target_compile_options(flexpm_warnings INTERFACE
    $<$<AND:$<CXX_COMPILER_ID:Clang>,$<NOT:$<CONFIG:Release>>>:-Wno-pass-failed>)
