# SPDX-License-Identifier: BSD-3-Clause

# toposcope_add_plugin(KIND ID [LIBRARIES lib...])
# Builds <ID>.cpp of the present folder as a plugin library, writes its manifest from the compiled descriptor beside it
# and installs both. KIND is worksets, shapes, relations, labelers or filters; ID is the plugin's id. Further files:
# target_sources(plugin_<KIND>_<ID> PRIVATE ...). Serves this tree and, through find_package(Toposcope), yours.
function(toposcope_add_plugin kind id)
  cmake_parse_arguments(arg "" "" "LIBRARIES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "toposcope_add_plugin(${kind} ${id}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(kinds worksets shapes relations labelers filters)
  if(NOT kind IN_LIST kinds)
    message(FATAL_ERROR "toposcope_add_plugin(${kind} ${id}): the kind must be one of ${kinds}")
  endif()
  set(map ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/plugin.map)
  set(target plugin_${kind}_${id})
  add_library(${target} MODULE ${id}.cpp)
  target_compile_features(${target} PRIVATE cxx_std_20)
  # Results must be the same on every run and machine of one architecture.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # A link to the manifest writer makes the library, and so the manifest, anew when the writer changes.
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${id}
    CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/plugins/${kind}
    LINK_DEPENDS "${map};$<TARGET_FILE:Toposcope::write_manifest>")
  target_link_libraries(${target} PRIVATE Toposcope::geometry Toposcope::labeling ${arg_LIBRARIES})
  target_link_options(${target} PRIVATE -Wl,--no-undefined -Wl,--version-script=${map})
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
    COMMAND Toposcope::write_manifest ${kind} ${id} $<TARGET_FILE:${target}>
    BYPRODUCTS ${CMAKE_BINARY_DIR}/plugins/${kind}/${id}.plugin.json)
  set_property(GLOBAL APPEND PROPERTY TOPOSCOPE_PLUGIN_TARGETS ${target})
  install(TARGETS ${target} LIBRARY DESTINATION lib/toposcope/plugins/${kind})
  install(FILES ${CMAKE_BINARY_DIR}/plugins/${kind}/${id}.plugin.json DESTINATION lib/toposcope/plugins/${kind})
endfunction()
