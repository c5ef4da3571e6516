// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace toposcope::cli {

namespace fs = std::filesystem;

/// What every command that works on meshes takes.
struct CommonOptions {
  std::vector<fs::path> plugin_dirs;
  std::string pipeline = "default";
  std::string labeler;
  std::vector<std::string> overrides;  ///< station.option=value
  unsigned threads = 0;
  std::uint64_t seed = 1;
  bool quiet = false, verbose = false, json = false;
};

struct RunOptions : CommonOptions {
  std::vector<fs::path> meshes;
  std::string model;
  fs::path out;
  fs::path save_problem;  ///< empty: not written
  bool report = true;
  fs::path lock, locked;  ///< write a lock file; refuse a run that differs from one
};

struct ReportOptions {
  std::vector<fs::path> results;
  fs::path mesh;  ///< empty: where the result says
  bool quiet = false;
};

struct ClassifyOptions : CommonOptions {
  std::vector<fs::path> meshes;
  std::string models;
};

struct CompareOptions : CommonOptions {
  std::vector<fs::path> meshes;
  std::string model;
  std::string labelers = "all";
  double time_limit_s = 10;
  fs::path out;  ///< empty: nothing is written
  bool csv = false, markdown = false;
};

struct EvaluateOptions : CommonOptions {
  std::vector<fs::path> datasets;
  std::string model;  ///< empty: the data set's
  fs::path out, baseline;
  bool reports = false;  ///< one for each mesh
  bool csv = false, markdown = false;
};

struct LabelOptions : CommonOptions {
  fs::path problem;
  fs::path save;  ///< empty: not written
  std::size_t k_best = 1;
  double within = std::numeric_limits<double>::infinity();
  double time_limit_s = 60;
  bool marginals = false;
};

struct PrepareOptions : CommonOptions {
  std::vector<fs::path> meshes;
  fs::path out;
  std::optional<std::uint32_t> faces, decimate;
  std::optional<double> edge;  ///< in the mesh's own unit
  std::string smooth;          ///< passes; empty: not asked for
};

struct ModelOptions {
  std::vector<fs::path> plugin_dirs;
  std::string model;
  std::string format = "text";  ///< show: text or dot
};

struct PluginsOptions {
  std::vector<fs::path> plugin_dirs;
  std::string kind, id;
  std::vector<fs::path> paths;
  bool json = false;
  fs::path page;          ///< describe: the documentation page whose tables to renew
  bool valgrind = false;  ///< check: for errors of memory too
  fs::path child;         ///< check: the library to examine in this process; for the program itself
  bool brief = false;
};

struct SampleOptions : CommonOptions {
  std::string kind;
  std::uint32_t faces = 20000;
  double noise = 0;
  std::map<std::string, std::string> parameters;
  fs::path out;
  bool list = false;
  bool scan = false;
  std::uint32_t viewpoints = 60, seen_from = 0;
  double scan_noise = 0.0005;
  int smoothing = 3;
  std::string preset;
  bool random = false;
};

struct ExportOptions {
  std::vector<fs::path> results;
  fs::path mesh;  ///< empty: where the result says
  std::vector<std::string> formats = {"gltf", "vtp", "slicer"};
  bool quiet = false;
};

struct RenderOptions {
  std::vector<fs::path> results;
  fs::path mesh, out;  ///< empty: where the result says; beside the result
  std::vector<std::string> stages = {"found"};
  std::string size = "1200x900", view = "auto", up = "auto", background = "white";
  unsigned threads = 0;
  bool quiet = false;
};

/// Each returns the exit code; errors leave as exceptions (base/errors.h).
int run(const RunOptions& options);
int label(const LabelOptions& options);
int compare(const CompareOptions& options);
int evaluate(const EvaluateOptions& options);
int classify(const ClassifyOptions& options);
int prepare(const PrepareOptions& options);
int model_check(const ModelOptions& options);
int model_show(const ModelOptions& options);
int plugins_list(const PluginsOptions& options);
int plugins_describe(const PluginsOptions& options);
int plugins_new(const PluginsOptions& options);
int plugins_check(const PluginsOptions& options);
int report(const ReportOptions& options);
int export_results(const ExportOptions& options);
int render(const RenderOptions& options);
int sample(const SampleOptions& options);

}  // namespace toposcope::cli
