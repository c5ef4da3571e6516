// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>

#include "base/errors.h"
#include "base/run_context.h"
#include "commands.h"
#include "picture/stages.h"
#include "stored_results.h"

namespace toposcope::cli {
namespace {

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

/// What of a scene there is to show of the stages asked for.
std::vector<Wanted> pictures(const Scene& scene, const std::vector<std::string>& stages) {
  std::vector<Wanted> wanted;
  const auto add = [&](Stage stage) {
    if (stage == Stage::marks && scene.marks.empty()) return;
    if (stage == Stage::worksets && scene.all_sets.empty()) return;
    if (stage != Stage::candidates) {
      wanted.push_back({stage, "", std::string(to_string(stage))});
      return;
    }
    for (const std::string& feature : scene.features)
      for (const ShownCandidate& each : scene.candidates)
        if (each.feature == feature) {
          wanted.push_back({stage, feature, "candidates-" + feature});
          break;
        }
  };
  for (const std::string& text : stages)
    if (text == "all")
      for (const Stage stage : all_stages) add(stage);
    else
      add(stage_from(text));
  return wanted;
}

}  // namespace

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
  return for_each_result(options.results, options.mesh, [&](const fs::path& folder) {
    const Scene scene = stored_scene(folder, options.mesh);
    const std::vector<Wanted> wanted = pictures(scene, options.stages);
    if (wanted.empty())
      throw UsageError(folder.string() + ": has nothing to show of this stage; " +
                       "working sets and candidates are in scene.json of toposcope run --out, marks in a truth file "
                       "beside the mesh");
    const Stand stand = options.up == "auto" ? stand_of(scene) : stand_from(options.up);
    const View view = options.view == "auto" ? best_view(scene, stand) : view_from(options.view);
    for (const Wanted& each : wanted) {
      fs::path file = options.out.empty() ? folder / (each.name + ".png") : options.out;
      if (!options.out.empty() && wanted.size() > 1)
        file.replace_filename(file.stem().string() + "-" + each.name + ".png");
      write_file(file, to_png(picture_of(scene, each.stage, each.feature, view, stand, style, context)));
      if (!options.quiet) fmt::print("{}\n", file.string());
    }
  });
}

}  // namespace toposcope::cli
