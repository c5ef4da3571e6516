// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/kernel/model/model_catalog.h"

namespace toposcope::fuzz {

/// Plugins that exist as manifests alone, with the names that shipped models and pipelines use.
inline const PluginCatalog& catalog() {
  static const PluginCatalog made = [] {
    test::ModelCatalog known;
    known.add(PluginKind::worksets, "curvature-tree", 0, 0, {}, {{"convex", 0, "m"}, {"concave", 0, "m"}});
    for (const char* id : {"cylinder", "cone"})
      known.add(PluginKind::shapes, id, 1, 1, {}, {{"radius", 1, "m"}, {"half_angle", 0, "m"}});
    for (const char* id : {"axes-meet", "axis-distance", "coplanar", "mirror-plane", "nearer", "same-size", "end"})
      known.add(PluginKind::relations, id, 2, 3,
                {{"max", OptionType::real, "length", "1", "0", "", "greatest distance"},
                 {"of", OptionType::text, "", "radius", "", "", "a measure", "radius|length"}},
                {});
    for (const char* id : {"least-error", "posterior", "backtracking"})
      known.add(PluginKind::labelers, id, 0, 0, {{"find", OptionType::text, "", "one", "", "", "m", "one|all"}}, {});
    known.add(PluginKind::filters, "refine", 0, 0, {{"max_edge", OptionType::real, "", "0.03", "0", "1", "m"}}, {});
    return known.read();
  }();
  return made;
}

}  // namespace toposcope::fuzz
