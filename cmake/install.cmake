# What `cmake --install` puts under a prefix, and the Debian package that `run/package` makes of it.
#   bin                 the programs, and pounding-tools, which starts the tools below
#   share/pounding      scenes and meshes as in the repository, how ranks are started (run), the Python package with the tools (python)
#   share/doc/pounding  the pages
#   share/man           man pages of the programs
#   share/bash-completion/completions  completion of their options
include(GNUInstallDirs)
set(POUNDING_SHARE ${CMAKE_INSTALL_DATADIR}/pounding)

install(TARGETS pounding pounding-mesh pounding-spectra RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(PROGRAMS cmake/pounding-tools DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY meshes octave petsc-options python DESTINATION ${POUNDING_SHARE}
  PATTERN __pycache__ EXCLUDE)
install(FILES run/environment DESTINATION ${POUNDING_SHARE}/run)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Man pages and completion are made of what the programs say when asked for help; none where these do not run here.
set(manual ${CMAKE_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${manual}/made
  COMMAND ${CMAKE_SOURCE_DIR}/packaging/manual.py ${CMAKE_BINARY_DIR} ${PROJECT_VERSION} ${manual}
  DEPENDS pounding pounding-spectra ${CMAKE_SOURCE_DIR}/packaging/manual.py VERBATIM)
add_custom_target(manual ALL DEPENDS ${manual}/made)
install(FILES ${manual}/pounding.1 ${manual}/pounding-mesh.1 ${manual}/pounding-spectra.1
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
install(FILES ${manual}/pounding ${manual}/pounding-spectra
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions OPTIONAL)
# `import pounding` in Debian's Python finds the package where the prefix is /usr.
install(CODE "
  set(modules \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/python3/dist-packages\")
  file(MAKE_DIRECTORY \"\${modules}\")
  file(CREATE_LINK ../../../${POUNDING_SHARE}/python/pounding \"\${modules}/pounding\" SYMBOLIC)")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pounding)
set(CPACK_PACKAGE_CONTACT "The authors of pounding <authors@pounding.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Seismic pounding between plant buildings, floor spectra to 400 Hz")
set(CPACK_PACKAGE_DESCRIPTION "Explicit finite-element dynamics with unilateral contact, in parallel\
 with MPI and PETSc: what floors and equipment feel when two buildings hit each other. Scenes, tools\
 that draw and compare results, and a Python package come with it.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "openmpi-bin, python3, python3-h5py, python3-jinja2, python3-matplotlib, python3-numpy, python3-scipy, python3-yaml")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libopenblas0-serial)
# Of the system that it is for, whose libraries it needs: pounding_0.2.0-debian12_amd64.deb.
cmake_host_system_information(RESULT system QUERY DISTRIB_ID DISTRIB_VERSION_ID)
list(JOIN system "" CPACK_DEBIAN_PACKAGE_RELEASE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
include(CPack)
