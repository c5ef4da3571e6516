# SPDX-License-Identifier: BSD-3-Clause
# examples/ builds against the installed SDK alone, and its own tests pass: known answers, the conformance kit, a whole run.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(REMOVE_RECURSE ${folder}/examples)
configure_and_build(${SOURCE}/examples ${folder}/examples)
check(${CMAKE_CTEST_COMMAND} --test-dir ${folder}/examples --output-on-failure)
expect_text("100% tests passed, 0 tests failed out of 5")
