# cmake -DIDL=<pkg>/msg/<Name>.idl -DROOT=<idl folder> -DOUT=<gen folder> -DFASTDDSGEN=... -P generate.cmake
# fastddsgen writes every included type flat into its output folder, and may report an error and
# still exit 0. So: a private folder for each file, keep only that file's outputs, read the log.
cmake_path(REMOVE_EXTENSION IDL OUTPUT_VARIABLE name)
cmake_path(GET name FILENAME stem)
set(work ${OUT}/.work/${name})
file(MAKE_DIRECTORY ${work}/out ${work}/tmp)
execute_process(
  COMMAND ${FASTDDSGEN} -cs -typeros2 -replace -I . -d ${work}/out -t ${work}/tmp ${IDL}
  WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE status OUTPUT_VARIABLE log ERROR_VARIABLE log)
if(NOT status EQUAL 0 OR log MATCHES "ERROR")
  message(FATAL_ERROR "fastddsgen ${IDL}:\n${log}")
endif()
foreach(ext h cxx)
  file(COPY_FILE ${work}/out/${stem}.${ext} ${OUT}/${name}.${ext} ONLY_IF_DIFFERENT)
endforeach()
file(REMOVE_RECURSE ${work})
