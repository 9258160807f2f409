# SPDX-License-Identifier: Apache-2.0
# cmake -DROOT=<idl folder> -DOUT=<gen folder> -DFASTDDSGEN=... -P generate.cmake
# All types in one call, for a start of Java takes longer than the work. fastddsgen writes flat into
# its output folder, so no two files may share a name; and it may report an error and still exit 0,
# so its log is read.
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/*.idl)
set(stems "")
foreach(file ${files})
  cmake_path(GET file STEM stem)
  if(stem IN_LIST stems)
    message(FATAL_ERROR "two IDL files are named ${stem}.idl: give ${file} another name")
  endif()
  list(APPEND stems ${stem})
endforeach()

set(work ${OUT}/.work)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work}/out ${work}/tmp)
execute_process(
  COMMAND ${FASTDDSGEN} -cs -typeros2 -replace -I . -d ${work}/out -t ${work}/tmp ${files}
  WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE status OUTPUT_VARIABLE log ERROR_VARIABLE log)
if(NOT status EQUAL 0 OR log MATCHES "ERROR")
  message(FATAL_ERROR "fastddsgen:\n${log}")
endif()
foreach(file ${files})
  cmake_path(REMOVE_EXTENSION file OUTPUT_VARIABLE name)
  cmake_path(GET name FILENAME stem)
  foreach(ext h cxx)
    file(COPY_FILE ${work}/out/${stem}.${ext} ${OUT}/${name}.${ext} ONLY_IF_DIFFERENT)
  endforeach()
endforeach()
file(REMOVE_RECURSE ${work})
