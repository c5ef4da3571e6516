# SPDX-License-Identifier: BSD-3-Clause
# What is installed, in three components: `program` (the program, its models and pipelines), `plugins` (the plugins, by
# toposcope_add_plugin), `sdk` (what an author of plugins needs: headers, static libraries, manifest writer,
# toposcope_add_plugin, schemas, templates, the author's pages).

include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Toposcope)
set(source_dir ${CMAKE_CURRENT_LIST_DIR}/..)

install(TARGETS toposcope RUNTIME DESTINATION bin COMPONENT program)
install(DIRECTORY ${source_dir}/models ${source_dir}/pipelines DESTINATION share/toposcope COMPONENT program)

# The program finds what it reads beside itself, in the build tree as when installed.
foreach(kind models pipelines templates)
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${kind} ${CMAKE_BINARY_DIR}/${kind} SYMBOLIC)
endforeach()

set_target_properties(toposcope_api PROPERTIES EXPORT_NAME api)
set_target_properties(toposcope_geometry PROPERTIES EXPORT_NAME geometry)
set_target_properties(toposcope_labeling PROPERTIES EXPORT_NAME labeling)
set_target_properties(toposcope_write_manifest PROPERTIES EXPORT_NAME write_manifest)
install(TARGETS toposcope_api toposcope_geometry toposcope_labeling toposcope_write_manifest EXPORT ToposcopeTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT sdk
  RUNTIME DESTINATION lib/toposcope COMPONENT sdk)
install(EXPORT ToposcopeTargets NAMESPACE Toposcope:: DESTINATION ${package_dir} COMPONENT sdk)
install(DIRECTORY ${source_dir}/core/include/toposcope DESTINATION include COMPONENT sdk)
install(DIRECTORY ${source_dir}/schemas ${source_dir}/templates DESTINATION share/toposcope COMPONENT sdk)
# The author's pages and all that they link to, in folders as in the tree, so that the links hold (tests/sdk/install.cmake).
set(doc_dir share/doc/libtoposcope-dev)
install(DIRECTORY ${source_dir}/docs ${source_dir}/examples ${source_dir}/schemas ${source_dir}/pipelines
        ${source_dir}/models DESTINATION ${doc_dir} COMPONENT sdk)
install(DIRECTORY ${source_dir}/plugins DESTINATION ${doc_dir} COMPONENT sdk FILES_MATCHING PATTERN *.md)
install(FILES ${source_dir}/MIGRATION.md DESTINATION ${doc_dir} COMPONENT sdk)

include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/ToposcopeConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/ToposcopeConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/ToposcopeConfig.cmake INSTALL_DESTINATION ${package_dir})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/ToposcopeConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/ToposcopeConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/ToposcopePlugin.cmake ${CMAKE_CURRENT_LIST_DIR}/plugin.map
  DESTINATION ${package_dir} COMPONENT sdk)
