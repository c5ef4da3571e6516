# SPDX-License-Identifier: BSD-3-Clause

# toposcope_add_plugin(KIND ID [LIBRARIES lib...])
# Builds <ID>.cpp of the present folder as a plugin library and writes its manifest from the compiled descriptor.
function(toposcope_add_plugin kind id)
  cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
  set(target plugin_${kind}_${id})
  add_library(${target} MODULE ${id}.cpp)
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${id}
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/plugins/${kind})
  target_link_libraries(${target} PRIVATE Toposcope::geometry ${arg_LIBRARIES})
endfunction()
