# cmake --install puts the program and its data, and the crowd engine as a library: headers below include/throng, static
# libraries, and throngConfig.cmake, so that find_package(throng) gives throng::crowd and throng::world to other programs.
# The library alone: cmake --install BUILD --component library.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Modules that other programs may link. Libraries that they use must be in the list, and their third-party libraries in
# cmake/throngConfig.cmake.in.
set(THRONG_LIBRARY_MODULES base crowd/description world crowd)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/throng")

set(targets throng_recast)
foreach(module IN LISTS THRONG_LIBRARY_MODULES)
  string(REPLACE "/" "_" name "${module}")
  set_target_properties(throng_${name} PROPERTIES EXPORT_NAME "${name}")
  target_compile_features(throng_${name} PUBLIC cxx_std_20)
  list(APPEND targets throng_${name})
  throng_interface_headers(${module} headers)
  foreach(header IN LISTS headers)
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${PROJECT_SOURCE_DIR}/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/throng/${folder}"
      COMPONENT library)
  endforeach()
endforeach()
install(TARGETS ${targets} EXPORT throng_targets ARCHIVE COMPONENT library)
install(EXPORT throng_targets FILE throngTargets.cmake NAMESPACE throng:: DESTINATION "${package_folder}"
  COMPONENT library)

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/throngConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/throngConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/throngConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/throngConfig.cmake" "${PROJECT_BINARY_DIR}/throngConfigVersion.cmake"
  DESTINATION "${package_folder}" COMPONENT library)
