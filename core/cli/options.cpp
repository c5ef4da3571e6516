// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace toposcope::cli {

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const auto check = [=](std::string& text) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec != std::errc() || read.ptr != end || value < least || value > most)
      return fmt::format("'{}' cannot be used; expected a whole number from {} to {}", text, least, most);
    text = std::to_string(value);
    return std::string();
  };
  return CLI::Validator(check, "", "");
}

CLI::Validator number_from_zero() {
  const auto check = [](const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    const bool good = read.ec == std::errc() && read.ptr == end && value >= 0 && std::isfinite(value);
    return good ? std::string() : fmt::format("'{}' cannot be used; expected a number of at least 0", text);
  };
  return CLI::Validator(check, "", "");
}

void add_plugin_dirs(CLI::App& command, std::vector<fs::path>& dirs) {
  command.add_option("--plugin-dir", dirs, "further folders with plugins")->type_name("DIR")->allow_extra_args(false);
}

void add_threads(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "threads; 0: one per processor")
      ->check(whole_number(0, 1024))
      ->capture_default_str();
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& of) {
  command.add_option("--seed", seed, "seed of " + of)
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
}

void add_quiet(CLI::App& command, bool& quiet) {
  command.add_flag("-q,--quiet", quiet, "errors only");
}

void add_pipeline(CLI::App& command, CommonOptions& options) {
  command.add_option("--pipeline", options.pipeline,
                     "name or file of the pipeline instead of the model's, or 'default'");
}

void add_session(CLI::App& command, CommonOptions& options) {
  add_plugin_dirs(command, options.plugin_dirs);
  command.add_option("--set", options.overrides, "override one value: station.option=value")
      ->type_name("S.O=V")
      ->allow_extra_args(false);
  add_threads(command, options.threads);
  add_quiet(command, options.quiet);
  command.add_flag("-v,--verbose", options.verbose, "say more");
}

void add_common(CLI::App& command, CommonOptions& options) {
  add_pipeline(command, options);
  command.add_option("--labeler", options.labeler, "labeler to use instead of the pipeline's")->type_name("ID");
  add_seed(command, options.seed);
  add_session(command, options);
}

CLI::Option* add_meshes(CLI::App& command, std::vector<fs::path>& meshes, const std::string& note) {
  return command.add_option("mesh", meshes, "PLY, OBJ, STL, OFF or glTF files" + note)->type_name("MESH...");
}

CLI::Option* add_model(CLI::App& command, std::string& model, const std::string& note) {
  return command.add_option("--model", model, "name or file of the model" + note);
}

void add_results(CLI::App& command, ResultOptions& options) {
  command.add_option("result", options.results, "folders that toposcope run --out wrote, or their result.json")
      ->required()
      ->type_name("RESULT...");
  command.add_option("--mesh", options.mesh, "the mesh of one result, if it is not where it was")->type_name("MESH");
  add_quiet(command, options.quiet);
}

void add_table_formats(CLI::App& command, bool& json, bool& csv, bool& markdown, const std::string& row_of) {
  CLI::Option* as_json = command.add_flag("--json", json, "print JSON");
  CLI::Option* as_csv = command.add_flag("--csv", csv, "print a row per " + row_of)->excludes(as_json);
  command.add_flag("--markdown", markdown, "print the tables for a document")->excludes(as_json)->excludes(as_csv);
}

}  // namespace toposcope::cli
