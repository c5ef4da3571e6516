# SPDX-License-Identifier: BSD-3-Clause
# Third-party libraries that bring no CMake package, as targets under our own names.

# Debian's Ceres::ceres is the static library and adds 3.8 MB to every plugin that links it: take the shared one.
if(NOT TARGET Toposcope::ceres_shared)
  find_package(Eigen3 3.4 REQUIRED)
  find_library(TOPOSCOPE_CERES_LIBRARY NAMES libceres.so REQUIRED)
  find_library(TOPOSCOPE_GLOG_LIBRARY NAMES libglog.so REQUIRED)
  find_path(TOPOSCOPE_CERES_INCLUDE_DIR ceres/ceres.h REQUIRED)
  add_library(Toposcope::ceres_shared SHARED IMPORTED GLOBAL)
  set_target_properties(Toposcope::ceres_shared PROPERTIES
    IMPORTED_LOCATION ${TOPOSCOPE_CERES_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${TOPOSCOPE_CERES_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES "Eigen3::Eigen;${TOPOSCOPE_GLOG_LIBRARY}")
endif()

# The C library and its header-only C++ wrapper (nlopt.hpp).
if(NOT TARGET Toposcope::nlopt)
  find_library(TOPOSCOPE_NLOPT_LIBRARY NAMES libnlopt.so REQUIRED)
  find_path(TOPOSCOPE_NLOPT_INCLUDE_DIR nlopt.hpp REQUIRED)
  add_library(Toposcope::nlopt SHARED IMPORTED GLOBAL)
  set_target_properties(Toposcope::nlopt PROPERTIES
    IMPORTED_LOCATION ${TOPOSCOPE_NLOPT_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${TOPOSCOPE_NLOPT_INCLUDE_DIR})
endif()

# Hash functions; a library that Debian's own dpkg links.
if(NOT TARGET Toposcope::md)
  find_library(TOPOSCOPE_MD_LIBRARY NAMES libmd.so REQUIRED)
  find_path(TOPOSCOPE_MD_INCLUDE_DIR sha2.h REQUIRED)
  add_library(Toposcope::md SHARED IMPORTED GLOBAL)
  set_target_properties(Toposcope::md PROPERTIES
    IMPORTED_LOCATION ${TOPOSCOPE_MD_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${TOPOSCOPE_MD_INCLUDE_DIR})
endif()

# Draco decompresses glTF, where it is installed.
if(NOT TARGET Toposcope::draco)
  find_library(TOPOSCOPE_DRACO_LIBRARY NAMES libdraco.so)
  find_path(TOPOSCOPE_DRACO_INCLUDE_DIR draco/compression/decode.h)
  if(TOPOSCOPE_DRACO_LIBRARY AND TOPOSCOPE_DRACO_INCLUDE_DIR)
    add_library(Toposcope::draco SHARED IMPORTED GLOBAL)
    set_target_properties(Toposcope::draco PROPERTIES
      IMPORTED_LOCATION ${TOPOSCOPE_DRACO_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${TOPOSCOPE_DRACO_INCLUDE_DIR}
      INTERFACE_COMPILE_DEFINITIONS TOPOSCOPE_DRACO)
  else()
    message(STATUS "Without Draco: glTF that it has compressed is refused (apt-get install libdraco-dev)")
  endif()
endif()
