# The package that other projects find: find_package(meshrepair) gives meshrepair::bsp, meshrepair::extract,
# meshrepair::repair, meshrepair::boolean and meshrepair::hollow.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/meshrepair)
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/meshrepairConfig.cmake.in ${PROJECT_BINARY_DIR}/meshrepairConfig.cmake
  INSTALL_DESTINATION ${package_folder})
# Before 1.0 a minor version may break its callers.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/meshrepairConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/meshrepairConfig.cmake
              ${PROJECT_BINARY_DIR}/meshrepairConfigVersion.cmake DESTINATION ${package_folder})
install(EXPORT meshrepair-targets NAMESPACE meshrepair:: DESTINATION ${package_folder})
