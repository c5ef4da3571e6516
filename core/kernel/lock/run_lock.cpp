// SPDX-License-Identifier: BSD-3-Clause
#include "lock/run_lock.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/json_text.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "io/extension.h"
#include "io/gltf_uri.h"
#include "pipeline/resolution.h"
#include "pipeline/stations.h"
#include "plugin/option_check.h"
#include "probability/probability_options.h"
#include "toposcope/system/programs.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

LockedPlugin locked_plugin(const PluginManifest& manifest, const std::vector<OptionValue>& values) {
  const PluginUse use = use_of(manifest, values);
  LockedPlugin plugin{use.kind, use.id, use.version, locked_file(manifest.library), {}, {}};
  for (const auto& [name, value] : use.options) plugin.options[name] = value;
  // One that is missing is said when the plugin is made.
  for (const std::string& program : manifest.programs)
    if (const auto file = find_program(program)) plugin.programs.push_back(locked_file(*file));
  return plugin;
}

/// The plugins that make_stations would load, in its order.
std::vector<LockedPlugin> locked_plugins(const PipelineManifest& pipeline, const Model& model,
                                         const PluginCatalog& catalog) {
  std::vector<LockedPlugin> plugins;
  const auto add = [&](PluginKind kind, const std::string& id, const std::vector<OptionValue>& values) {
    plugins.push_back(locked_plugin(catalog.require(kind, id), values));
  };
  const auto add_once = [&](PluginKind kind, const std::string& id) {
    if (std::none_of(plugins.begin(), plugins.end(), [&](const LockedPlugin& plugin) { return plugin.id == id; }))
      add(kind, id, plugin_options(pipeline, catalog, kind, id));
  };
  for (const StationPlugin& filter : pipeline.filters) add(PluginKind::filters, filter.plugin, filter.options);
  for (const StationPlugin& classifier : pipeline.worksets)
    add(PluginKind::worksets, classifier.plugin, classifier.options);
  for (const ModelFeature& feature : model.features) {
    add_once(PluginKind::shapes, feature.shape.plugin);
    for (const ShapeSpec& other : feature.other_shapes) add_once(PluginKind::shapes, other.plugin);
  }
  for (const Relationship& relationship : model.relationships) add_once(PluginKind::relations, relationship.plugin);
  add(PluginKind::labelers, pipeline.labeler.plugin, pipeline.labeler.options);
  if (pipeline.marginals) add(PluginKind::labelers, pipeline.marginals->plugin, pipeline.marginals->options);
  return plugins;
}

LockedMesh locked_mesh(const fs::path& path) {
  try {
    LockedMesh mesh{locked_file(path), {}};
    if (lower_extension(path) != ".gltf") return mesh;
    const auto json = parse_json<nlohmann::json>(read_text_file(path, "mesh"), path.string());
    const std::string name = path.string();
    if (json.is_object() && json.contains("buffers"))
      for (const auto& buffer : json["buffers"])
        if (buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string())
          if (const std::string uri = buffer["uri"]; !uri.starts_with("data:"))
            mesh.parts.push_back(
                locked_file(path_of_uri(GltfValue(name, buffer["uri"], "uri"), uri, path.parent_path())));
    return mesh;
  } catch (const UsageError& error) {
    throw MeshError(error.what());
  }
}

/// What differs, with the exit code of its kind.
class Differences {
 public:
  void add(int code, const std::string& what) {
    if (code_ == 0) code_ = code;
    text_ += "\n  " + what;
  }
  void compare(int code, const std::string& what, const std::string& locked, const std::string& now) {
    if (locked != now) add(code, what + ": '" + locked + "' in the lock, '" + now + "' now");
  }
  void compare(int code, const std::string& what, const LockedFile& locked, const LockedFile& now) {
    if (locked.sha256 != now.sha256)
      add(code, what + " '" + now.path + "' is another: sha256 " + locked.sha256.substr(0, 12) + "... in the lock, " +
                    now.sha256.substr(0, 12) + "... now");
  }
  void compare(int code, const std::string& what, const std::map<std::string, std::string>& locked,
               const std::map<std::string, std::string>& now) {
    for (const auto& [name, value] : locked) {
      const auto found = now.find(name);
      compare(code, what + " option '" + name + "'", value, found == now.end() ? "(not there)" : found->second);
    }
    for (const auto& [name, value] : now)
      if (!locked.contains(name)) compare(code, what + " option '" + name + "'", "(not there)", value);
  }
  void compare(int code, const std::string& what, const std::vector<LockedFile>& locked,
               const std::vector<LockedFile>& now) {
    if (locked.size() != now.size())
      add(code, what + "s: " + std::to_string(locked.size()) + " in the lock, " + std::to_string(now.size()) + " now");
    else
      for (std::size_t i = 0; i < now.size(); ++i) compare(code, what, locked[i], now[i]);
  }
  int code() const { return code_; }
  const std::string& text() const { return text_; }

 private:
  int code_ = 0;
  std::string text_;
};

std::string ids(const std::vector<LockedPlugin>& plugins) {
  std::string all;
  for (const LockedPlugin& plugin : plugins) all += (all.empty() ? "" : ", ") + plugin.id;
  return all;
}

std::map<std::string, std::string> texts_of(std::span<const OptionRow> table, const std::vector<OptionValue>& values) {
  std::map<std::string, std::string> texts;
  for (const OptionValue& value : values)
    for (const OptionRow& row : table)
      if (row.name == value.name) texts[row.name] = to_string(row, value);
  return texts;
}

}  // namespace

LockedFile locked_file(const fs::path& path) {
  return {path.string(), sha256_of(path)};
}

RunLock lock_run(const LockedProgram& program, std::uint64_t seed, const PipelineManifest& pipeline, const Model& model,
                 const std::vector<fs::path>& meshes, const PluginCatalog& catalog) {
  RunLock lock;
  lock.program = program;
  lock.seed = seed;
  lock.pipeline = pipeline.name;
  lock.resolution = texts_of(resolution_option_table(), pipeline.resolution);
  lock.probability = texts_of(probability_option_table(), pipeline.probability);
  lock.model = locked_file(model.file);
  lock.plugins = locked_plugins(pipeline, model, catalog);
  for (const fs::path& mesh : meshes) lock.meshes.push_back(locked_mesh(mesh));
  return lock;
}

void require_same(const RunLock& locked, const RunLock& now, const fs::path& lock_file) {
  Differences differences;
  differences.compare(2, "program version", locked.program.version, now.program.version);
  differences.compare(2, "program", locked.program.file, now.program.file);
  differences.compare(2, "seed", std::to_string(locked.seed), std::to_string(now.seed));
  differences.compare(2, "pipeline", locked.pipeline, now.pipeline);
  differences.compare(2, "resolution", locked.resolution, now.resolution);
  differences.compare(2, "probability", locked.probability, now.probability);
  differences.compare(2, "model", locked.model, now.model);
  if (ids(locked.plugins) != ids(now.plugins)) {
    differences.compare(4, "plugins", ids(locked.plugins), ids(now.plugins));
  } else {
    for (std::size_t i = 0; i < now.plugins.size(); ++i) {
      const LockedPlugin &was = locked.plugins[i], &is = now.plugins[i];
      const std::string name = "plugin '" + is.id + "':";
      differences.compare(4, name + " version", was.version, is.version);
      differences.compare(4, name + " library", was.library, is.library);
      differences.compare(2, name, was.options, is.options);
      differences.compare(4, name + " program", was.programs, is.programs);
    }
  }
  if (locked.meshes.size() != now.meshes.size())
    differences.add(2, "meshes: " + std::to_string(locked.meshes.size()) + " in the lock, " +
                           std::to_string(now.meshes.size()) + " given");
  else
    for (std::size_t i = 0; i < now.meshes.size(); ++i) {
      differences.compare(3, "mesh", locked.meshes[i].file, now.meshes[i].file);
      differences.compare(3, "part of mesh", locked.meshes[i].parts, now.meshes[i].parts);
    }
  if (differences.code() != 0)
    throw Error(lock_file.string() + ": this is not the locked run:" + differences.text() +
                    "\nNothing was run. Restore what differs, or write a new lock with --lock",
                differences.code());
}

}  // namespace toposcope
