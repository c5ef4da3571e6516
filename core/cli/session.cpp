// SPDX-License-Identifier: BSD-3-Clause
#include "session.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "base/errors.h"
#include "resources.h"
#include "result/repair_words.h"

namespace toposcope::cli {
namespace {

RunContext* interruptible = nullptr;  // the one thing a signal handler can reach

void on_interrupt(int) {
  if (interruptible) interruptible->cancel();
}

PipelineManifest open_pipeline(const CommonOptions& options, const PluginCatalog& catalog) {
  PipelineManifest pipeline = read_pipeline(find_resource("pipelines", options.pipeline), catalog);
  if (!options.labeler.empty()) set_labeler(pipeline, options.labeler, catalog);
  for (const std::string& text : options.overrides) apply_override(pipeline, text, catalog);
  return pipeline;
}

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
    for (const PluginProblem& problem : catalog.problems())
      fmt::print(stderr, "toposcope: warning: {}\n", problem.message);
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
  settings.log = [logger](LogLevel level, std::string_view message) { logger->log(level_of(level), message); };
  if (terminal_)
    settings.progress = [this](double fraction) {
      fmt::print(stderr, "\r\033[K{} {:3.0f} %", status_, 100 * fraction);
      std::fflush(stderr);
    };
  context_ = std::make_unique<RunContext>(settings);
  interruptible = context_.get();
  std::signal(SIGINT, on_interrupt);
}

Session::~Session() {
  std::signal(SIGINT, SIG_DFL);
  interruptible = nullptr;
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
  status_ = text;
  if (!terminal_) return;
  fmt::print(stderr, "\r\033[K{}", text);
  std::fflush(stderr);
}

PipelineSession::PipelineSession(const CommonOptions& options)
    : Session(options), pipeline_(open_pipeline(options, host().catalog())) {}

int for_each_mesh(const std::vector<fs::path>& meshes, Session& session,
                  const std::function<void(const fs::path&)>& body) {
  int code = 0;
  for (const fs::path& mesh : meshes) {
    session.status(mesh.string());
    try {
      body(mesh);
    } catch (const Error& error) {
      if (session.context().cancelled()) throw;
      session.status("");
      fmt::print(stderr, "toposcope: {}\n", error.what());
      if (code == 0) code = error.exit_code;
    }
    session.status("");
    if (session.context().cancelled()) throw Error("interrupted", interrupted_exit_code);
  }
  return code;
}

}  // namespace toposcope::cli
