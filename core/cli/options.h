// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace toposcope::cli {

namespace fs = std::filesystem;

/// What commands that work on meshes take; each adds the options that it has.
struct CommonOptions {
  std::vector<fs::path> plugin_dirs;
  std::string pipeline;  ///< empty: the model's own, or the default
  std::string labeler;
  std::vector<std::string> overrides;  ///< station.option=value
  unsigned threads = 0;
  std::uint64_t seed = 1;
  bool quiet = false, verbose = false, json = false;
};

/// What commands that work on results of `run --out` take.
struct ResultOptions {
  std::vector<fs::path> results;
  fs::path mesh;  ///< empty: where the result says
  bool quiet = false;
};

/// A whole number in decimal digits: CLI11 would read "010" as eight.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// A finite number of at least 0.
CLI::Validator number_from_zero();

void add_plugin_dirs(CLI::App& command, std::vector<fs::path>& dirs);
void add_threads(CLI::App& command, unsigned& threads);
void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& of = "everything random");
void add_quiet(CLI::App& command, bool& quiet);
/// --pipeline
void add_pipeline(CLI::App& command, CommonOptions& options);
/// --plugin-dir, --set, --threads, -q, -v
void add_session(CLI::App& command, CommonOptions& options);
/// --pipeline, --labeler, --seed, and those of add_session
void add_common(CLI::App& command, CommonOptions& options);
/// The meshes to work on, in the command line's order.
CLI::Option* add_meshes(CLI::App& command, std::vector<fs::path>& meshes, const std::string& note = "");
CLI::Option* add_model(CLI::App& command, std::string& model, const std::string& note = "");
/// The results, --mesh, -q
void add_results(CLI::App& command, ResultOptions& options);
/// --json, --csv and --markdown, of which one can be given
void add_table_formats(CLI::App& command, bool& json, bool& csv, bool& markdown, const std::string& row_of);

}  // namespace toposcope::cli
