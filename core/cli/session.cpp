// SPDX-License-Identifier: BSD-3-Clause
#include "session.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <new>

#include "base/errors.h"
#include "base/printable.h"
#include "failure.h"
#include "output.h"
#include "resources.h"
#include "result/repair_words.h"

namespace toposcope::cli {
namespace {

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

}  // namespace

std::string program_name() {
  return "toposcope " TOPOSCOPE_VERSION;
}

PluginCatalog open_catalog(const std::vector<fs::path>& plugin_dirs, bool warn) {
  PluginCatalog catalog(plugin_search_path(plugin_dirs));
  if (warn)
    for (const PluginProblem& problem : catalog.problems()) complain("warning: " + problem.message);
  return catalog;
}

Session::Session(const CommonOptions& options)
    : host_(open_catalog(options.plugin_dirs, !options.quiet)),
      terminal_(isatty(STDERR_FILENO) == 1 && !options.quiet) {
  auto logger = std::make_shared<spdlog::logger>("toposcope", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("toposcope: %^%l%$: %v");
  logger->set_level(options.quiet ? spdlog::level::err : options.verbose ? spdlog::level::debug : spdlog::level::warn);

  RunSettings settings;
  settings.threads = options.threads;
  settings.seed = options.seed;
  settings.log = [logger](LogLevel level, std::string_view message) {
    logger->log(level_of(level), shortened(printable(message)));
  };
  if (terminal_)
    settings.progress = [this](double fraction) {
      std::fprintf(stderr, "\r\033[K%s %3.0f %%", status_.c_str(), 100 * fraction);
      std::fflush(stderr);
    };
  context_ = std::make_unique<RunContext>(settings);
  interruption_.emplace(*context_);
}

RepairedMesh Session::read(const fs::path& mesh) {
  RepairedMesh input = read_repaired_mesh(mesh, context_.get());
  if (input.repair.notable()) {
    status("");
    context_->log(LogLevel::warning, mesh.string() + ": repaired: " + repair_in_words(input.repair));
    status(mesh.string());
  }
  return input;
}

void Session::status(const std::string& text) {
  status_ = printable(text);
  if (!terminal_) return;
  std::fprintf(stderr, "\r\033[K%s", status_.c_str());
  std::fflush(stderr);
}

fs::path pipeline_file(const Model& model) {
  if (model.pipeline.empty()) return find_resource("pipelines", "default");
  const fs::path named(model.pipeline);
  const bool is_file = named.extension() == ".yaml" || named.extension() == ".yml";
  try {
    return find_resource("pipelines", is_file ? (fs::path(model.file).parent_path() / named).string() : model.pipeline);
  } catch (const UsageError& error) {
    throw UsageError(model.pipeline_where.str() + ": pipeline '" + model.pipeline + "': " + error.what());
  }
}

PipelineSession::PipelineSession(const CommonOptions& options) : Session(options), options_(options) {
  if (!options_.pipeline.empty()) open(find_resource("pipelines", options_.pipeline));  // before any model
}

const PipelineManifest& PipelineSession::pipeline(const Model& model) {
  return open(options_.pipeline.empty() ? pipeline_file(model) : find_resource("pipelines", options_.pipeline));
}

Stations PipelineSession::stations(const Model& model) {
  if (model.features.empty())
    throw UsageError(model.file + ": model '" + model.name +
                     "' has no features to look for on a mesh; add some under 'features', or use model ask");
  return make_stations(host(), pipeline(model), model);
}

const PipelineManifest& PipelineSession::open(const fs::path& file) {
  const auto found = pipelines_.find(file);
  if (found != pipelines_.end()) return found->second;
  const PluginCatalog& catalog = host().catalog();
  PipelineManifest pipeline = read_pipeline(file, catalog);
  if (!options_.labeler.empty()) set_labeler(pipeline, options_.labeler, catalog);
  for (const std::string& text : options_.overrides) apply_override(pipeline, text, catalog);
  return pipelines_.emplace(file, std::move(pipeline)).first->second;
}

std::string not_done(std::size_t all, const std::string& what, const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::string text =
      fmt::format("{} of {} {} {} not done: ", names.size(), all, what, names.size() == 1 ? "was" : "were");
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i ? ", " : "") + names[i];
  return text + (names.size() > most ? ", ..." : "");
}

int for_each_mesh(const std::vector<fs::path>& meshes, Session& session,
                  const std::function<void(const fs::path&)>& body) {
  int code = 0;
  std::vector<std::string> failed;
  const auto fail = [&](const fs::path& mesh, const Failure& failure) {
    session.status("");
    const bool named = failure.message.find(mesh.string()) != std::string::npos;
    complain(named ? failure.message : mesh.string() + ": " + failure.message);
    failed.push_back(mesh.string());
    if (code == 0) code = failure.exit_code;
  };
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    session.status(meshes[i].string());
    bool done = false;
    try {
      body(meshes[i]);
      done = true;
    } catch (const std::bad_alloc&) {
      fail(meshes[i],
           {meshes[i].string() + ": out of memory; give fewer faces, such as toposcope prepare --decimate makes",
            MeshError("").exit_code});
    } catch (...) {
      if (!session.context().cancelled()) fail(meshes[i], present_failure());
    }
    session.status("");
    if (!session.context().cancelled() || (done && i + 1 == meshes.size())) continue;
    for (std::size_t rest = i + (done ? 1 : 0); rest < meshes.size(); ++rest) failed.push_back(meshes[rest].string());
    throw Error("interrupted; " + not_done(meshes.size(), "meshes", failed), interrupted_exit_code);
  }
  if (!failed.empty() && meshes.size() > 1) complain(not_done(meshes.size(), "meshes", failed));
  return code;
}

}  // namespace toposcope::cli
