# SPDX-License-Identifier: BSD-3-Clause
# What the tests of the installed SDK share. Run with -DBUILD=... -DSOURCE=... -DBUILD_TYPE=... -DFLAGS=... -P: they work
# in BUILD/sdk_test, on the prefix that install.cmake fills.
cmake_minimum_required(VERSION 3.25)
set(folder ${BUILD}/sdk_test)
set(prefix ${folder}/prefix)
set(program ${prefix}/bin/toposcope)
set(warnings "-Wall -Wextra -Wpedantic -Werror")
# Nothing of this tree: plugins and resources are those of the prefix.
unset(ENV{TOPOSCOPE_PLUGIN_PATH})
unset(ENV{TOPOSCOPE_DATA_PATH})

# check(COMMAND...) runs a command that must succeed; its output is in `output`.
function(check)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "exit code ${result}: ${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# refuse(CODE WORDS COMMAND...) runs a command that must fail with that exit code and say those words.
function(refuse code words)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(FIND "${output}" "${words}" found)
  if(NOT result EQUAL code OR found EQUAL -1)
    message(FATAL_ERROR "wanted exit code ${code} and '${words}', not ${result}: ${ARGN}\n${output}")
  endif()
endfunction()

# expect_text(WORDS) in the output of the last check.
macro(expect_text words)
  string(FIND "${output}" "${words}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "'${words}' is not in:\n${output}")
  endif()
endmacro()

# configure_and_build(SOURCE BINARY [OPTION...]) as an author would, all warnings on.
function(configure_and_build source binary)
  check(${CMAKE_COMMAND} -S ${source} -B ${binary} -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_PREFIX_PATH=${prefix}
    "-DCMAKE_CXX_FLAGS=${FLAGS} ${warnings}" ${ARGN})
  check(${CMAKE_COMMAND} --build ${binary} --parallel 2)
endfunction()
