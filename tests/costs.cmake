# SPDX-License-Identifier: BSD-3-Clause
# Seconds of an idle machine that tests found in executables take; read by CTest, which starts the slowest first.
set_tests_properties(Conformance/ShippedPlugins.Pass/shapes Conformance/ShippedPlugins.Pass/relations
                     Conformance/ShippedPlugins.Pass/filters PROPERTIES COST 35)
set_tests_properties(Conformance/ShippedPlugins.Pass/labelers PROPERTIES COST 20)
set_tests_properties(Conformance/ShippedPlugins.Pass/worksets Conformance.LeaksAreFoundUnderValgrind
                     Normalise.SmallAndHostileMeshes PROPERTIES COST 6)
