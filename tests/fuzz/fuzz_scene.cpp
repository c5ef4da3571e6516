// SPDX-License-Identifier: BSD-3-Clause
// A scene is read, written again, and drawn at every stage, small.
#include "base/run_context.h"
#include "fuzz_document.h"
#include "picture/stages.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  return fuzz::read_document(data, size, [](const std::string& text) {
    static RunContext context({.threads = 1});
    const Scene scene = read_scene(text, "scene.json");
    to_json(scene, "fuzz");
    const PictureStyle style{.width = 24, .height = 18, .samples = 1, .directions = 2, .light_pixels = 16};
    const Stand stand = stand_of(scene);
    const View view = best_view(scene, stand);
    for (const Stage stage : all_stages)
      picture_of(scene, stage, scene.features.empty() ? "" : scene.features[0], view, stand, style, context);
  });
}
