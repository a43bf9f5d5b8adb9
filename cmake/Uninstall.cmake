# SPDX-License-Identifier: GPL-3.0-or-later
# Remove the files of MANIFEST, which the last installation has written, and the folders of the package.
cmake_minimum_required(VERSION 3.25)

if(NOT EXISTS ${MANIFEST})
    message(FATAL_ERROR "MANIFEST = ${MANIFEST}, does not exist; nothing was installed from this build")
endif()
file(STRINGS ${MANIFEST} files)
file(REMOVE ${files} ${MANIFEST})
foreach(name IN LISTS files)
    if(name MATCHES "^(.*/flexpm)/_flexpm\\.so$")
        file(REMOVE_RECURSE ${CMAKE_MATCH_1}) # holds no more than what Python has compiled there
    endif()
endforeach()
