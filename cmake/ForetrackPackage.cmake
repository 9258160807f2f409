# SPDX-License-Identifier: Apache-2.0
# What is installed beside core's libraries, and Debian packages of it all: `./run package`.
# Components: program (foretrack), core (foretrack-dev), station (foretrack-station).
include(GNUInstallDirs)

set(share share/foretrack)
set(units lib/systemd/system)
install(TARGETS foretrack foretrack_perceive_program RUNTIME DESTINATION bin COMPONENT program)
install(DIRECTORY qos DESTINATION ${share} COMPONENT program)
install(DIRECTORY deploy/params deploy/scenarios deploy/plot DESTINATION ${share}/deploy
  COMPONENT program PATTERN __pycache__ EXCLUDE)
install(FILES deploy/models/SHA256SUMS DESTINATION ${share}/deploy/models COMPONENT program)
install(PROGRAMS deploy/models/fetch.sh DESTINATION ${share}/deploy/models COMPONENT program)
install(PROGRAMS deploy/packages/foretrack-fetch-models DESTINATION sbin COMPONENT program)
install(FILES deploy/packages/vehicle.yaml DESTINATION ${share} COMPONENT program)
install(FILES deploy/systemd/foretrack-gate@.service deploy/systemd/foretrack-stages@.service
  deploy/systemd/foretrack-recorder@.service deploy/systemd/foretrack-onboard@.target DESTINATION ${units} COMPONENT program)
install(DIRECTORY deploy/systemd/secured DESTINATION ${share}/systemd COMPONENT program)
install(DIRECTORY idl DESTINATION ${share} COMPONENT core FILES_MATCHING PATTERN "*.idl"
  PATTERN "README.md")
install(DIRECTORY services/ground_station/web/dist/ DESTINATION ${share}/page COMPONENT station OPTIONAL)
install(FILES deploy/systemd/foretrack-station.service DESTINATION ${units} COMPONENT station)

# Of each package: who may copy it, and what is new.
set(made ${PROJECT_BINARY_DIR}/packages)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "foretrack developers <foretrack@users.noreply.github.com>")
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(package foretrack foretrack-dev foretrack-station)
  configure_file(deploy/packages/changelog.in ${made}/${package}/changelog.Debian @ONLY)
  execute_process(COMMAND gzip -9nf ${made}/${package}/changelog.Debian)
endforeach()
foreach(pair program:foretrack core:foretrack-dev station:foretrack-station)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  install(FILES ${made}/${package}/changelog.Debian.gz deploy/packages/copyright
    DESTINATION share/doc/${package} COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME foretrack)
set(CPACK_PACKAGE_VENDOR foretrack)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program core station)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
  GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE https://github.com/foretrack/foretrack)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME foretrack)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "sweethome3d-furniture")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-matplotlib, python3-jinja2")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "foretrack-station, npm, chrony")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/deploy/packages/program/postinst
  ${PROJECT_SOURCE_DIR}/deploy/packages/program/prerm ${PROJECT_SOURCE_DIR}/deploy/packages/program/postrm)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Services over DDS that estimate a person's state from camera landmarks, give
each intention a probability, predict the paths, and plan a trajectory that
keeps the person in view; a safety gate in front of a PX4 flight controller,
a simulator, and tools for operators.")

set(CPACK_DEBIAN_CORE_PACKAGE_NAME foretrack-dev)
set(CPACK_DEBIAN_CORE_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_CORE_PACKAGE_DEPENDS
  "libeigen3-dev, liboctomap-dev, libxnnpack-dev, libpthreadpool-dev")
set(CPACK_COMPONENT_CORE_DESCRIPTION "Libraries, headers and message types: the algorithms of foretrack as static
libraries with a CMake package, for programs that step them in their own process without DDS, and the IDL files of
all its topics.")

set(CPACK_DEBIAN_STATION_PACKAGE_NAME foretrack-station)
set(CPACK_DEBIAN_STATION_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_STATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_STATION_PACKAGE_DEPENDS "foretrack (>= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_STATION_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/deploy/packages/station/postinst
  ${PROJECT_SOURCE_DIR}/deploy/packages/station/prerm ${PROJECT_SOURCE_DIR}/deploy/packages/station/postrm)
set(CPACK_COMPONENT_STATION_DESCRIPTION "The ground station: the page on which operators watch, record and command
vehicles from a browser, and the unit that serves it.")
include(CPack)
