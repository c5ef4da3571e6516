// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "base/run_context.h"
#include "interruption.h"
#include "io/mesh_io.h"
#include "model/model.h"
#include "options.h"
#include "pipeline/pipeline_manifest.h"
#include "pipeline/stations.h"
#include "plugin/plugin_host.h"

namespace toposcope::cli {

/// What the commands that work on meshes share: plugins, log, progress, Ctrl-C.
class Session {
 public:
  explicit Session(const CommonOptions& options);

  PluginHost& host() { return host_; }
  RunContext& context() { return *context_; }

  /// Reads and repairs; a warning where more was done than a user would expect.
  RepairedMesh read(const fs::path& mesh);

  /// One line on the terminal, replaced by the next; nothing in a pipe. Empty clears it.
  void status(const std::string& text);

 private:
  PluginHost host_;
  bool terminal_;
  std::string status_;
  std::unique_ptr<RunContext> context_;
  std::optional<Interruption> interruption_;
};

/// The file of the pipeline that a model asks for, or of the default one. \throw UsageError  with the model's place
fs::path pipeline_file(const Model& model);

/// And pipelines: that of the command line for all models, or each model's own.
class PipelineSession : public Session {
 public:
  explicit PipelineSession(const CommonOptions& options);
  /// Read once, with what the command line changes in it: models of one pipeline get the same object.
  const PipelineManifest& pipeline(const Model& model);
  /// \throw UsageError  also of a model that has no features to look for
  Stations stations(const Model& model);

 private:
  const PipelineManifest& open(const fs::path& file);

  CommonOptions options_;
  std::map<fs::path, PipelineManifest> pipelines_;  ///< by file
};

/// Name and version, for what the program writes.
std::string program_name();

/// The plugins that can be found; a warning on stderr about each that cannot be used.
PluginCatalog open_catalog(const std::vector<fs::path>& plugin_dirs, bool warn = true);

/// Runs `body` for each mesh: one that fails is reported on stderr and the others are still done; of several, the end
/// says which were not.
/// \return the exit code: that of the first failure, 0 if there was none
/// \throw Error  interrupted
int for_each_mesh(const std::vector<fs::path>& meshes, Session& session,
                  const std::function<void(const fs::path&)>& body);

/// "2 of 5 meshes were not done: a.ply, b.ply"; a dozen names at most.
std::string not_done(std::size_t all, const std::string& what, const std::vector<std::string>& names);

}  // namespace toposcope::cli
