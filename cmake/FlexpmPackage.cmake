# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian package, made by scripts/package: what it holds beside the installed files, and what it depends on.

set(package_docs ${PROJECT_BINARY_DIR}/package) # written by scripts/package
install(FILES ${package_docs}/man/flexpm.1.gz DESTINATION share/man/man1)
install(FILES ${package_docs}/completion/flexpm DESTINATION share/bash-completion/completions)
install(FILES ${package_docs}/completion/_flexpm DESTINATION share/zsh/vendor-completions)
install(DIRECTORY ${package_docs}/html DESTINATION share/doc/flexpm)
install(FILES ${package_docs}/changelog.gz ${package_docs}/NEWS.gz ${PROJECT_SOURCE_DIR}/cmake/debian/copyright
    DESTINATION share/doc/flexpm)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts/tutorials ${PROJECT_SOURCE_DIR}/scripts/yade-check
    DESTINATION share/doc/flexpm/examples PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts/studies DESTINATION share/doc/flexpm/examples
    FILES_MATCHING PATTERN "*.toml" PATTERN "*.table" PATTERN "cohesion_batch.py" PATTERN "__pycache__" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian/lintian-overrides DESTINATION share/lintian/overrides RENAME flexpm)
install(DIRECTORY ${PROJECT_BINARY_DIR}/python/flexpm/vendor DESTINATION ${site_dir}/flexpm
    PATTERN "__pycache__" EXCLUDE PATTERN "bin" EXCLUDE)

# The class layouts are those of one release of YADE: this one, up to the next.
execute_process(COMMAND dpkg-query -W -f "\${source:Upstream-Version}" yade
    OUTPUT_VARIABLE yade_version COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS /etc/os-release os REGEX "^VERSION_ID=")
string(REGEX REPLACE "[^0-9]" "" debian "${os}")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME flexpm)
string(REPLACE ".dev" "~dev" version "${flexpm_version}") # Debian takes it for older than the release
set(CPACK_PACKAGE_VERSION ${version}+deb${debian})
set(CPACK_PACKAGE_CONTACT "The flexpm developers <flexpm@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "flexible particle model of rock fracture for YADE")
set(CPACK_PACKAGE_DESCRIPTION "A plugin of the discrete-element code YADE that models rock by
deformable grains: Laguerre cells of a disc packing, meshed with
triangles and bonded along their edges by contacts with bilinear
softening. It brings laboratory tests, parameter studies and
calibrations as Python functions and as the command flexpm.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${YADE_LIBDIR})
string(JOIN ", " CPACK_DEBIAN_PACKAGE_DEPENDS
    "yade (>= ${yade_version})" "yade (<< ${yade_version}.0~)" python3
    python3-numpy python3-scipy python3-matplotlib python3-pil python3-vtk9 python3-click
    python3-tqdm
    python3-dask python3-distributed python3-pandas python3-tomli-w
    python3-jinja2 libjs-chart.js libjs-three)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS python3-h5py) # volumes of DREAM3D
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
