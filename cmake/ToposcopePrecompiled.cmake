# SPDX-License-Identifier: BSD-3-Clause
# Precompiled headers. Toposcope's own headers are none of them, so that they are made once; sources name what they use all
# the same, and `make lint` reads them without.
set(precompiled_mathematics <algorithm> <array> <cmath> <functional> <map> <memory> <numeric> <optional> <random> <set>
    <span> <string> <vector> <Eigen/Eigenvalues> <Eigen/Geometry>)
set(precompiled_documents ${precompiled_mathematics} <charconv> <filesystem> <fstream> <sstream> <fmt/format.h>
    <fmt/ranges.h> <nlohmann/json.hpp>)

# The compiler takes them only where every macro stands that stood when they were made: so they are made by libraries of
# their own, which link no more than the headers need.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
foreach(name mathematics documents)
  add_library(precompiled_${name} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(precompiled_${name} PRIVATE Eigen3::Eigen)
  target_precompile_headers(precompiled_${name} PRIVATE ${precompiled_${name}})
endforeach()
target_link_libraries(precompiled_documents PRIVATE fmt::fmt nlohmann_json::nlohmann_json)

# toposcope_unity(TARGET): its sources go together where TOPOSCOPE_UNITY says so. What one file takes for itself may then
# hide what another has: builds without it warn of that.
function(toposcope_unity target)
  if(TOPOSCOPE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    target_compile_options(${target} PRIVATE -Wno-shadow
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()
