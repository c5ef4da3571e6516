# SPDX-License-Identifier: BSD-3-Clause

# toposcope_add_plugin(KIND ID [LIBRARIES lib...] [SOURCES file...])
# Builds <ID>.cpp of the present folder, and further SOURCES, as a plugin library, writes its manifest from the compiled
# descriptor beside it and installs both. KIND is worksets, shapes, relations, labelers or filters; ID is the plugin's id.
# The target is plugin_<KIND>_<ID>. Serves this tree and, through find_package(Toposcope), yours.
function(toposcope_add_plugin kind id)
  cmake_parse_arguments(arg "" "" "LIBRARIES;SOURCES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "toposcope_add_plugin(${kind} ${id}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(kinds worksets shapes relations labelers filters)
  if(NOT kind IN_LIST kinds)
    message(FATAL_ERROR "toposcope_add_plugin(${kind} ${id}): the kind must be one of ${kinds}")
  endif()
  set(map ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/plugin.map)
  set(target plugin_${kind}_${id})
  add_library(${target} MODULE ${id}.cpp ${arg_SOURCES})
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
  install(TARGETS ${target} LIBRARY DESTINATION lib/toposcope/plugins/${kind} COMPONENT plugins)
  install(FILES ${CMAKE_BINARY_DIR}/plugins/${kind}/${id}.plugin.json
    DESTINATION lib/toposcope/plugins/${kind} COMPONENT plugins)
endfunction()

# toposcope_add_plugin_test(KIND ID)
# For a plugin of toposcope_add_plugin: builds <ID>_test.cpp (toposcope/testing/plugin_test.h) and adds two tests, <ID>, which
# runs it with the plugin's library as its argument, and <ID>_check, which runs `toposcope plugins check` on the library.
function(toposcope_add_plugin_test kind id)
  set(plugin plugin_${kind}_${id})
  add_executable(${plugin}_test ${id}_test.cpp)
  target_compile_features(${plugin}_test PRIVATE cxx_std_20)
  target_link_libraries(${plugin}_test PRIVATE Toposcope::geometry Toposcope::labeling ${CMAKE_DL_LIBS})
  add_dependencies(${plugin}_test ${plugin})
  add_test(NAME ${id} COMMAND ${plugin}_test $<TARGET_FILE:${plugin}>)
  if(Toposcope_PROGRAM)
    add_test(NAME ${id}_check COMMAND ${Toposcope_PROGRAM} plugins check $<TARGET_FILE:${plugin}>)
  else()
    message(STATUS "the program toposcope was not found: test ${id}_check is left out")
  endif()
endfunction()
