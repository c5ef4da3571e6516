# SPDX-License-Identifier: BSD-3-Clause
# docs/plugins.md keeps its word: its example, copied from the page, builds against an installed Toposcope and gets its
# manifest. Run with -DBUILD=... -DSOURCE=... -DBUILD_TYPE=... -DFLAGS=... -P.
set(folder ${BUILD}/plugin_page_test)
file(REMOVE_RECURSE ${folder})

function(check)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
endfunction()

# The first fenced block of a language.
function(copy_block language file)
  file(READ ${SOURCE}/docs/plugins.md page)
  set(fence "```${language}\n")
  string(FIND "${page}" "${fence}" first)
  string(LENGTH "${fence}" length)
  math(EXPR first "${first} + ${length}")
  string(SUBSTRING "${page}" ${first} -1 page)
  string(FIND "${page}" "```" last)
  string(SUBSTRING "${page}" 0 ${last} block)
  file(WRITE ${file} "${block}")
endfunction()

copy_block(cpp ${folder}/ball.cpp)
copy_block(cmake ${folder}/CMakeLists.txt)
check(${CMAKE_COMMAND} --install ${BUILD} --prefix ${folder}/prefix)
check(${CMAKE_COMMAND} -S ${folder} -B ${folder}/build -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
  -DCMAKE_PREFIX_PATH=${folder}/prefix "-DCMAKE_CXX_FLAGS=${FLAGS} -Wall -Wextra -Wpedantic -Werror")
check(${CMAKE_COMMAND} --build ${folder}/build)
if(NOT EXISTS ${folder}/build/plugins/shapes/ball.plugin.json)
  message(FATAL_ERROR "the build wrote no manifest")
endif()
check(${folder}/prefix/bin/toposcope plugins check ${folder}/build/plugins/shapes)
