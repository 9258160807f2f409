# SPDX-License-Identifier: Apache-2.0
# Compiler settings and the three kinds of target: a core stage, a service library, a test.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

find_program(CCACHE ccache)
if(CCACHE)
  # What precompiled headers need of it.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)

# How our own code is compiled: warnings are errors, and no contraction, so that results do not
# depend on the machine. Folders say link_libraries(foretrack_options) once, and no library exports it,
# so that nothing of it reaches those who embed us.
add_library(foretrack_options INTERFACE)
target_compile_options(foretrack_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror -ffp-contract=off)
target_include_directories(foretrack_options INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(foretrack_options INTERFACE Eigen3::Eigen)
if(FORETRACK_SANITIZE)
  # Left out: what doubles the time to compile and AddressSanitizer mostly finds too, and what keeps
  # GCC 12 from comparing a function with null in a constant expression. Assertions stay. In sanitized
  # code it takes the copy of an empty optional for a use of what is not there.
  target_compile_options(foretrack_options INTERFACE -O1 -g1 -UNDEBUG -fno-omit-frame-pointer
    -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
    -fno-sanitize=nonnull-attribute,returns-nonnull-attribute -fno-sanitize-recover=undefined
    -Wno-maybe-uninitialized)
  target_link_options(foretrack_options INTERFACE -fsanitize=address,undefined)
endif()

# Half of the time to compile a file goes into reading Eigen, GoogleTest or CLI11: read them once.
# Files include what they use all the same, so that the build holds without (FORETRACK_PCH=OFF).
function(foretrack_precompiled name)  # name HEADERS … [DEPENDS …] [OPTIONS …]
  cmake_parse_arguments(ARG "" "" "HEADERS;DEPENDS;OPTIONS" ${ARGN})
  if(FORETRACK_PCH)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "")
    add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE foretrack_options ${ARG_DEPENDS})
    target_compile_options(${name} PRIVATE -fpch-preprocess ${ARG_OPTIONS})
    target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  endif()
endfunction()
function(foretrack_use_precompiled target name)
  if(FORETRACK_PCH)
    target_compile_options(${target} PRIVATE -fpch-preprocess)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()
foretrack_precompiled(foretrack_pch HEADERS <Eigen/Dense> <algorithm> <array> <cmath> <functional>
  <map> <memory> <optional> <string> <vector>)

# All sources in a folder of the calling one and, where they are named, in folders of it.
function(foretrack_sources variable folder)  # VARIABLE FOLDER [INNER …]
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE inner)
  list(TRANSFORM inner APPEND /*.cpp)
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${folder}/*.cpp ${inner})
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# A static library foretrack_<name> from all sources in a folder and, where it has them, in FOLDERS
# of it. <name> is the last part of the folder's path.
function(foretrack_library folder)
  cmake_parse_arguments(ARG "" "" "FOLDERS;DEPENDS" ${ARGN})
  cmake_path(GET folder FILENAME name)
  foretrack_sources(sources ${folder} ${ARG_FOLDERS})
  if(NOT sources)
    message(FATAL_ERROR "the library ${folder} has no sources")
  endif()
  add_library(foretrack_${name} STATIC ${sources})
  target_include_directories(foretrack_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/foretrack>)
  target_link_libraries(foretrack_${name} PUBLIC Eigen3::Eigen ${ARG_DEPENDS})
  foretrack_use_precompiled(foretrack_${name} foretrack_pch)
endfunction()

# A GoogleTest program from all sources of a folder (and of FOLDERS in it); ctest runs it as one
# test, or, with PARTS, each of these suites as one, and the rest.
# foretrack_test(core/planning LABEL unit DEPENDS foretrack_planning)
function(foretrack_test folder)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "FOLDERS;DEPENDS;PARTS" ${ARGN})
  foretrack_sources(sources ${folder} ${ARG_FOLDERS})
  if(NOT sources)
    message(FATAL_ERROR "the tests ${folder} are registered and have no sources")
  endif()
  string(REPLACE "/" "_" name ${folder})
  add_executable(test_${name} ${sources})
  set_target_properties(test_${name} PROPERTIES UNITY_BUILD OFF)
  if(folder MATCHES "^core/")
    add_dependencies(core_tests test_${name})
    set_target_properties(test_${name} PROPERTIES UNITY_BUILD ${FORETRACK_UNITY}
      UNITY_BUILD_BATCH_SIZE 8)
  endif()
  target_link_libraries(test_${name} PRIVATE foretrack_options ${ARG_DEPENDS}
    GTest::gmock GTest::gtest_main)
  foretrack_use_precompiled(test_${name} foretrack_test_pch)
  target_compile_options(test_${name} PRIVATE -O1)
  target_compile_definitions(test_${name} PRIVATE FORETRACK_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  set(tests ${folder})
  set(filter_${folder} "")
  if(ARG_PARTS)
    set(tests "")
    list(TRANSFORM ARG_PARTS APPEND ".*" OUTPUT_VARIABLE patterns)
    list(JOIN patterns ":" named)
    foreach(part ${ARG_PARTS})
      string(TOLOWER ${folder}/${part} test)
      set(filter_${test} --gtest_filter=${part}.*)
      list(APPEND tests ${test})
    endforeach()
    set(filter_${folder}/rest --gtest_filter=-${named})
    list(APPEND tests ${folder}/rest)
  endif()
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(FORETRACK_SANITIZE)
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")  # sanitized code takes ten times as long
  endif()
  foreach(test ${tests})
    add_test(NAME ${test} COMMAND test_${name} ${filter_${test}}
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${test} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT})
  endforeach()
endfunction()
