# SPDX-License-Identifier: Apache-2.0
# The door for embedders: every library of core as foretrack::<stage>, its headers, and
# find_package(foretrack). `cmake --install build --component core` installs this and no more.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(libraries DIRECTORY PROPERTY BUILDSYSTEM_TARGETS)
foreach(library ${libraries})
  string(REPLACE foretrack_ "" stage ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${stage})
  add_library(foretrack::${stage} ALIAS ${library})
endforeach()

add_custom_target(core_libraries DEPENDS ${libraries})

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/foretrack)
install(TARGETS ${libraries} EXPORT foretrack
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
install(EXPORT foretrack NAMESPACE foretrack:: FILE foretrackTargets.cmake
  DESTINATION ${package} COMPONENT core)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core ${PROJECT_BINARY_DIR}/generated/core
  DESTINATION include/foretrack COMPONENT core FILES_MATCHING PATTERN "*.hpp")
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/foretrackConfig.cmake.in
  ${PROJECT_BINARY_DIR}/foretrackConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/foretrackConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/foretrackConfig.cmake
  ${PROJECT_BINARY_DIR}/foretrackConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindXNNPACK.cmake
  DESTINATION ${package} COMPONENT core)
