# SPDX-License-Identifier: BSD-3-Clause
# What an author of plugins needs of an installed Toposcope: headers, geometry, manifest writer, toposcope_add_plugin.

set(package_dir lib/cmake/Toposcope)
set_target_properties(toposcope_api PROPERTIES EXPORT_NAME api)
set_target_properties(toposcope_geometry PROPERTIES EXPORT_NAME geometry)
set_target_properties(toposcope_labeling PROPERTIES EXPORT_NAME labeling)
set_target_properties(toposcope_write_manifest PROPERTIES EXPORT_NAME write_manifest)
install(TARGETS toposcope_api toposcope_geometry toposcope_labeling toposcope_write_manifest EXPORT ToposcopeTargets
  ARCHIVE DESTINATION lib RUNTIME DESTINATION bin)
install(EXPORT ToposcopeTargets NAMESPACE Toposcope:: DESTINATION ${package_dir})
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/../core/include/toposcope DESTINATION include)
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/../schemas DESTINATION share/toposcope)

include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/ToposcopeConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/ToposcopeConfig.cmake ${CMAKE_CURRENT_LIST_DIR}/ToposcopePlugin.cmake
              ${CMAKE_CURRENT_LIST_DIR}/plugin.map ${CMAKE_CURRENT_BINARY_DIR}/ToposcopeConfigVersion.cmake
  DESTINATION ${package_dir})
