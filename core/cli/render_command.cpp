// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/errors.h"
#include "base/file_name.h"
#include "base/run_context.h"
#include "commands.h"
#include "options.h"
#include "output.h"
#include "output_folder.h"
#include "picture/stages.h"
#include "stored_results.h"

namespace toposcope::cli {
namespace {

struct RenderOptions : ResultOptions {
  fs::path out;                     ///< empty: beside the result
  std::vector<std::string> stages;  ///< empty: what was found; of a mesh alone the mesh
  std::string size = "1200x900", view = "auto", up = "auto", background = "white";
  unsigned threads = 0;
};

constexpr int greatest_side = 8192;

/// "1200x900"
void set_size(const std::string& text, PictureStyle& style) {
  const char *begin = text.data(), *end = begin + text.size();
  const auto width = std::from_chars(begin, end, style.width);
  const bool more = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = more ? std::from_chars(width.ptr + 1, end, style.height) : width;
  if (!more || height.ec != std::errc() || height.ptr != end || style.width < 16 || style.height < 16 ||
      style.width > greatest_side || style.height > greatest_side)
    throw UsageError("--size " + text + ": expected WIDTHxHEIGHT in pixels, each from 16 to " +
                     std::to_string(greatest_side) + ", as in 1200x900");
}

Background background_from(const std::string& text) {
  return text == "dark" ? Background::dark : text == "transparent" ? Background::transparent : Background::white;
}

/// A picture and the end of its name.
struct Wanted {
  Stage stage;
  std::string feature, name;
};

/// What there is to show of a stage.
std::vector<Wanted> pictures(const Scene& scene, Stage stage) {
  if (stage == Stage::marks && scene.marks.empty()) return {};
  if (stage == Stage::worksets && scene.all_sets.empty()) return {};
  if (stage != Stage::candidates) return {{stage, "", std::string(to_string(stage))}};
  std::vector<Wanted> wanted;
  for (const std::string& feature : scene.features)
    if (std::any_of(scene.candidates.begin(), scene.candidates.end(),
                    [&](const ShownCandidate& each) { return each.feature == feature; }))
      wanted.push_back({stage, feature, "candidates-" + file_name(feature)});
  return wanted;
}

/// What of a scene there is to show of the stages asked for; of those asked for by name, which have nothing.
std::vector<Wanted> pictures(const Scene& scene, const std::vector<std::string>& stages, std::string& absent) {
  std::vector<Wanted> wanted;
  const auto add = [&](Stage stage) {
    const std::vector<Wanted> more = pictures(scene, stage);
    wanted.insert(wanted.end(), more.begin(), more.end());
    return !more.empty();
  };
  for (const std::string& text : stages)
    if (text == "all")
      for (const Stage stage : all_stages) add(stage);
    else if (!add(stage_from(text)))
      absent += (absent.empty() ? "" : ", ") + text;
  return wanted;
}

/// Where a picture of one result goes.
fs::path target_of(const fs::path& out, const fs::path& folder, const std::string& name, bool alone) {
  if (out.empty()) return folder / (name + ".png");
  std::error_code ignored;
  if (out.filename().empty() || fs::is_directory(out, ignored)) {
    make_folder(out, "-o");
    return out / (name + ".png");
  }
  return alone ? out : fs::path(out).replace_filename(out.stem().string() + "-" + name + ".png");
}

/// The stages asked for, or the one that one would look at.
std::vector<std::string> stages_of(const RenderOptions& options, const fs::path& given) {
  const bool alone = is_mesh_file(given);
  if (options.stages.empty()) return {alone ? "mesh" : "found"};
  for (const std::string& stage : options.stages)
    if (alone && stage != "mesh" && stage != "marks" && stage != "all")
      throw UsageError(given.string() + ": a mesh has no stage '" + stage +
                       "'; label it by toposcope run --out, or ask for mesh or marks");
  return options.stages;
}

int render(const RenderOptions& options) {
  PictureStyle style;
  set_size(options.size, style);
  style.background = background_from(options.background);
  if (options.view != "auto") view_from(options.view);
  if (options.up != "auto") stand_from(options.up);
  for (const std::string& stage : options.stages)
    if (stage != "all") stage_from(stage);
  if (!options.out.empty() && options.results.size() > 1)
    throw UsageError("-o names the pictures of one result, and " + std::to_string(options.results.size()) +
                     " are given; without it pictures go to the results' folders");
  RunContext context({.threads = options.threads});
  return for_each_result(options.results, options.mesh, [&](const fs::path& given) {
    const bool alone = is_mesh_file(given);
    const fs::path folder = alone ? given.parent_path() : result_folder(given);
    const Scene scene = alone ? mesh_scene(given) : stored_scene(folder, options.mesh);
    std::string absent;
    const std::vector<Wanted> wanted = pictures(scene, stages_of(options, given), absent);
    const Stand stand = options.up == "auto" ? stand_of(scene) : stand_from(options.up);
    const View view = options.view == "auto" ? best_view(scene, stand) : view_from(options.view);
    for (const Wanted& each : wanted) {
      const std::string name = (alone ? given.stem().string() + "-" : "") + each.name;
      const fs::path file = target_of(options.out, folder, name, wanted.size() == 1);
      write_file(file, to_png(picture_of(scene, each.stage, each.feature, view, stand, style, context)));
      if (!options.quiet) say("{}\n", file.string());
    }
    if (!absent.empty())
      throw UsageError(folder.string() + ": has nothing to show of " + absent +
                       "; working sets and candidates are in scene.json of toposcope run --out, marks in a truth file "
                       "beside the mesh");
  });
}

}  // namespace

void add_render(CLI::App& app, int& code) {
  CLI::App& command =
      *app.add_subcommand("render", "pictures of results, or of meshes alone, as PNG files, without a display");
  const auto options = std::make_shared<RenderOptions>();
  command
      .add_option("--stage", options->stages,
                  "mesh, worksets, candidates, found (when left out), marks; several by commas; all")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("-o,--out", options->out,
                  "the picture; of several pictures the beginning of their names, or a folder")
      ->type_name("FILE.png|DIR");
  command.add_option("--size", options->size, "pixels")->type_name("WxH")->capture_default_str();
  command
      .add_option("--view", options->view,
                  "auto, iso, front, back, left, right, top, bottom, or azimuth,elevation in degrees")
      ->capture_default_str();
  command.add_option("--up", options->up, "which way is up: auto (the model tells), x, y, z, -x, -y, -z")
      ->capture_default_str();
  command.add_option("--background", options->background, "white, dark or transparent")
      ->check(CLI::IsMember({"white", "dark", "transparent"}))
      ->capture_default_str();
  add_threads(command, options->threads);
  add_results(command, *options);
  command.callback([options, &code] { code = render(*options); });
}

}  // namespace toposcope::cli
