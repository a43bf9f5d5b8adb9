# SPDX-License-Identifier: GPL-3.0-or-later
# Make PACKAGE hold a link to each Python and data file of SOURCE, and no link to a file that is gone.
cmake_minimum_required(VERSION 3.25)

set(kinds *.py *.pyi *.toml *.html *.css *.js py.typed)
list(TRANSFORM kinds PREPEND ${SOURCE}/ OUTPUT_VARIABLE in_source)
list(TRANSFORM kinds PREPEND ${PACKAGE}/ OUTPUT_VARIABLE in_package)
file(GLOB_RECURSE wanted RELATIVE ${SOURCE} ${in_source})
file(GLOB_RECURSE present RELATIVE ${PACKAGE} LIST_DIRECTORIES false ${in_package})
list(FILTER present EXCLUDE REGEX "^vendor/") # packages of others, which the set-up puts there
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
