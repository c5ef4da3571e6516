# SPDX-License-Identifier: BSD-3-Clause
# find_package(Toposcope): targets Toposcope::api, Toposcope::geometry and Toposcope::labeling, function toposcope_add_plugin.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4)
include(${CMAKE_CURRENT_LIST_DIR}/ToposcopeTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/ToposcopePlugin.cmake)
