# SPDX-License-Identifier: BSD-3-Clause
# Fills the prefix on which the other tests of the SDK work.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(REMOVE_RECURSE ${folder})
check(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
foreach(file bin/toposcope include/toposcope/plugin.h share/toposcope/models/cup.yaml share/toposcope/pipelines/default.yaml
             share/toposcope/schemas/plugin.schema.json share/toposcope/templates/shapes/template.cpp
             lib/toposcope/plugins/shapes/circle.so lib/toposcope/plugins/shapes/circle.plugin.json)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
# The author's pages lead nowhere that is not installed.
check(python3 ${SOURCE}/tests/docs/links.py ${prefix}/share/doc/libtoposcope-dev)
# The program works from there, with its own models, pipelines and plugins.
check(${program} sample cup --faces 4000 -o ${folder}/cup.ply)
check(${program} run ${folder}/cup.ply --model cup --json)
expect_text("\"status\":\"labelled\"")
