# `cpack` in the build folder makes throng_VERSION_ARCH.deb: the program, its scenarios and character library, manual page,
# completion and documentation. Dependencies are those of the linked libraries (dpkg-shlibdeps) and what is opened by name:
# the software renderer of Mesa and a font for plans.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME throng)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "throng maintainers <throng@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)  # the library is for developers: cmake --install BUILD --component library
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME throng)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
  "libegl1, libegl-mesa0, libgl1-mesa-dri, libopengl0, fonts-dejavu-core, fonts-bebas-neue")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "synthetic crowd datasets
 Simulates crowds and quadcopters, renders the drones' cameras without a
 GPU, and writes images with exact ground truth and evacuation figures.")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${CPACK_DEBIAN_PROGRAM_DESCRIPTION}")
include(CPack)

if(TARGET throng)
  install(FILES "${PROJECT_SOURCE_DIR}/NOTICE" "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
    "${PROJECT_SOURCE_DIR}/SECURITY.md"
    DESTINATION share/doc/throng COMPONENT program)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION share/doc/throng RENAME copyright COMPONENT program)
  install(FILES "${PROJECT_SOURCE_DIR}/server/throng.service" DESTINATION lib/systemd/system COMPONENT program)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION share/doc/throng COMPONENT program)
endif()

# Removes the files that `cmake --install` wrote.
add_custom_target(uninstall
  COMMAND "${CMAKE_COMMAND}" -P "${PROJECT_SOURCE_DIR}/cmake/Uninstall.cmake"
  WORKING_DIRECTORY "${PROJECT_BINARY_DIR}" VERBATIM)
