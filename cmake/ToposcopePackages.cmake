# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages: `make packages` writes toposcope, toposcope-plugins and libtoposcope-dev, one for each component.

# What is packed is what the target `program` builds; the tests need not be built for it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME toposcope)
set(CPACK_PACKAGE_VENDOR "The Toposcope authors")
set(CPACK_PACKAGE_CONTACT "The Toposcope authors <authors@toposcope.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program plugins sdk)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(same_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME toposcope)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "toposcope-plugins ${same_version}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libtoposcope-dev ${same_version}")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "names and measures the features of an object on a triangle mesh
 The program, its symbolic models and its pipelines.")

set(CPACK_DEBIAN_PLUGINS_PACKAGE_NAME toposcope-plugins)
set(CPACK_DEBIAN_PLUGINS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PLUGINS_PACKAGE_DEPENDS "toposcope ${same_version}")
set(CPACK_DEBIAN_PLUGINS_PACKAGE_SUGGESTS toulbar2)
set(CPACK_COMPONENT_PLUGINS_DESCRIPTION "plugins of toposcope
 Working-set classifiers, shapes, relations, labelers and mesh filters.")

set(CPACK_DEBIAN_SDK_PACKAGE_NAME libtoposcope-dev)
set(CPACK_DEBIAN_SDK_PACKAGE_SECTION libdevel)
# All that `toposcope plugins new`, cmake and the compiler need, so that this package alone makes a plugin.
set(CPACK_DEBIAN_SDK_PACKAGE_DEPENDS "toposcope ${same_version}, cmake (>= 3.25), g++, make, libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_SDK_PACKAGE_SUGGESTS valgrind)
set(CPACK_COMPONENT_SDK_DESCRIPTION "kit for authors of toposcope plugins
 Headers, static libraries, CMake package, templates, schemas and tutorials.")

foreach(component program plugins sdk)
  string(TOUPPER ${component} name)
  install(FILES ${CMAKE_SOURCE_DIR}/LICENSE RENAME copyright
    DESTINATION share/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME} COMPONENT ${component})
endforeach()
include(CPack)
