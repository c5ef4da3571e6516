# SPDX-License-Identifier: BSD-3-Clause
# docs/guide/plugins.md keeps its word: its example, copied from the page, builds against the installed SDK and passes the
# conformance kit.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(here ${folder}/page)
file(REMOVE_RECURSE ${here})

# The first fenced block of a language.
function(copy_block language file)
  file(READ ${SOURCE}/docs/guide/plugins.md page)
  set(fence "```${language}\n")
  string(FIND "${page}" "${fence}" first)
  string(LENGTH "${fence}" length)
  math(EXPR first "${first} + ${length}")
  string(SUBSTRING "${page}" ${first} -1 page)
  string(FIND "${page}" "```" last)
  string(SUBSTRING "${page}" 0 ${last} block)
  file(WRITE ${file} "${block}")
endfunction()

copy_block(cpp ${here}/ball.cpp)
copy_block(cmake ${here}/CMakeLists.txt)
configure_and_build(${here} ${here}/build)
if(NOT EXISTS ${here}/build/plugins/shapes/ball.plugin.json)
  message(FATAL_ERROR "the build wrote no manifest")
endif()
check(${program} plugins check ${here}/build)
