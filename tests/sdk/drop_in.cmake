# SPDX-License-Identifier: BSD-3-Clause
# A plugin dropped into the plugin folder of the installed program changes the result, nothing is built again, and the
# report says which plugin made it. Takes the filter that the tutorial has built.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(here ${folder}/drop_in)
set(built ${folder}/tutorials/filter/my-filter/build/plugins/filters)
file(REMOVE_RECURSE ${here})
file(MAKE_DIRECTORY ${here})
check(${CMAKE_COMMAND} -E copy_directory ${prefix} ${here}/prefix)
set(program ${here}/prefix/bin/toposcope)
file(WRITE ${here}/softer.yaml "schema: toposcope.pipeline/1
name: softer
summary: the default with a filter more
filters: [{plugin: refine, max_edge: 0.03}, {plugin: my-filter, passes: 3}]
worksets: {plugin: curvature-tree}
labeler: {plugin: least-error}
marginals: {plugin: posterior}
")
set(run ${program} run ${folder}/cup.ply --model cup -q --out ${here})
refuse(2 "there is no filter 'my-filter'" ${run} --pipeline ${here}/softer.yaml)
check(${run})
file(READ ${here}/cup/result.json before)

foreach(file my-filter.so my-filter.plugin.json)
  check(${CMAKE_COMMAND} -E copy ${built}/${file} ${here}/prefix/lib/toposcope/plugins/filters/${file})
endforeach()
check(${run} --pipeline ${here}/softer.yaml)
file(READ ${here}/cup/result.json after)
foreach(result before after)
  string(JSON radius_${result} GET "${${result}}" features rim parameters radius)
  string(JSON count GET "${${result}}" plugins)
  string(FIND "${${result}}" "\"my-filter\"" named_${result})
endforeach()
if(radius_before EQUAL radius_after)
  message(FATAL_ERROR "the rim's radius is ${radius_before} with and without the filter")
endif()
if(NOT named_before EQUAL -1 OR named_after EQUAL -1)
  message(FATAL_ERROR "the report does not say which plugin made it")
endif()
# It is as good as the others: the conformance kit, and a lock file.
check(${program} plugins check ${here}/prefix/lib/toposcope/plugins/filters/my-filter.so)
