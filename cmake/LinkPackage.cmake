# SPDX-License-Identifier: GPL-3.0-or-later
# Make PACKAGE hold a link to each Python and data file of SOURCE, and no link to a file that is gone.
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE wanted RELATIVE ${SOURCE} ${SOURCE}/*.py ${SOURCE}/*.toml ${SOURCE}/py.typed)
file(GLOB_RECURSE present RELATIVE ${PACKAGE} LIST_DIRECTORIES false ${PACKAGE}/*.py ${PACKAGE}/*.toml)
foreach(name IN LISTS present)
    if(NOT name IN_LIST wanted)
        file(REMOVE ${PACKAGE}/${name})
    endif()
endforeach()
foreach(name IN LISTS wanted)
    if(NOT IS_SYMLINK ${PACKAGE}/${name})
        get_filename_component(folder ${PACKAGE}/${name} DIRECTORY)
        file(MAKE_DIRECTORY ${folder})
        file(CREATE_LINK ${SOURCE}/${name} ${PACKAGE}/${name} SYMBOLIC)
    endif()
endforeach()
