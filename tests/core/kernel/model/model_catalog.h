// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/kernel/plugin/plugin_folder.h"
#include "plugin/catalog.h"

namespace toposcope::test {

/// Plugins that exist as manifests alone, with the names that the shipped models use: the tests of models need no
/// compiled plugin.
class ModelCatalog {
 public:
  ModelCatalog() {
    add(PluginKind::worksets, "curvature", 0, 0, {}, {{"convex", 0, "m"}, {"concave", 0, "m"}, {"planar", 0, "m"}});
    add(PluginKind::shapes, "circle", 1, 1, {}, {{"radius", 1, "m"}});
    add(PluginKind::shapes, "plane", 1, 1, {}, {{"extent", 1, "m"}, {"area", 2, "m"}});
    add(PluginKind::shapes, "line-group", 1, 0,
        {{"segments", OptionType::integer, "", "1", "1", "16", "m"},
         {"closed", OptionType::boolean, "", "false", "", "", "m"}},
        {{"length_#", 1, "m"}, {"length", 1, "m"}});
    for (const char* id : {"parallel", "perpendicular", "reflective-symmetry", "concentric"})
      add(PluginKind::relations, id, 2, 2, {}, {});
    add(PluginKind::relations, "centroid-distance", 2, 2,
        {{"min", OptionType::real, "length", "0", "0", "", "m"},
         {"max", OptionType::real, "length", "", "0", "", "greatest distance"}},
        {});
    add(PluginKind::relations, "angle", 2, 3,
        {{"angle", OptionType::real, "deg", "90", "0", "180", "m"},
         {"signed", OptionType::boolean, "", "false", "", "", "m"}},
        {});
  }
  PluginCatalog read() const { return PluginCatalog({{folder_.path, true}}); }

  void add(PluginKind kind, const std::string& id, std::uint32_t min_arity, std::uint32_t max_arity,
           std::vector<OptionRow> arguments, std::vector<ProvidedRow> provides) const {
    PluginManifest manifest;
    manifest.kind = kind;
    manifest.id = id;
    manifest.version = "1.0.0";
    manifest.summary = "a plugin for tests";
    manifest.fingerprint = abi_fingerprint;
    manifest.abi_major = abi_major;
    manifest.abi_minor = abi_minor;
    manifest.min_arity = min_arity;
    manifest.max_arity = max_arity;
    if (kind == PluginKind::relations) manifest.unit = "deg";
    if (kind == PluginKind::shapes) manifest.dimension = id == "plane" ? 2 : 1;
    manifest.arguments = std::move(arguments);
    manifest.provides = std::move(provides);
    folder_.write(id + ".plugin.json", manifest_to_json(manifest));
    folder_.write(id + library_suffix(), "");
  }

 private:
  PluginFolderFixture folder_;
};

}  // namespace toposcope::test
