// SPDX-License-Identifier: BSD-3-Clause
#include "scene/local_frame.h"

#include <cmath>

namespace toposcope {
namespace {

/// Coordinates so many times as large as the box leave a millionth of it to single precision.
constexpr double farthest = 16;
constexpr double smallest = 1e-15, largest = 1e15;  // boxes whose squares single precision still holds

template <class Move>
void move_points(std::vector<Vec3>& points, const Move& move) {
  for (Vec3& p : points) p = move(p);
}

template <class Move>
void move_drawing(Drawing& drawing, const Move& move) {
  for (std::vector<Vec3>& line : drawing.lines) move_points(line, move);
  for (Patch& patch : drawing.patches) move_points(patch.positions, move);
  move_points(drawing.points, move);
}

template <class Move>
void move_scene(Scene& scene, const Move& move) {
  move_points(scene.input.positions, move);
  if (scene.normalised) move_points(scene.normalised->positions, move);
  for (ShownCandidate& each : scene.candidates) move_drawing(each.drawing, move);
  for (FoundFeature& each : scene.found) move_drawing(each.drawing, move);
  for (auto& [feature, points] : scene.marks) move_points(points, move);
}

}  // namespace

LocalFrame local_frame(std::span<const Vec3> points) {
  LocalFrame frame;
  if (points.empty()) return frame;
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double diagonal = (high - low).stableNorm();
  if (low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff() > farthest * diagonal) frame.origin = low + (high - low) / 2;
  if (diagonal > 0 && (diagonal < smallest || diagonal > largest))
    frame.scale = std::exp2(std::floor(std::log2(diagonal)));
  return frame;
}

Scene in_local_frame(Scene scene, const LocalFrame& frame) {
  move_scene(scene, [&](const Vec3& p) { return frame.to_local(p); });
  return scene;
}

Scene in_world(Scene scene, const LocalFrame& frame) {
  move_scene(scene, [&](const Vec3& p) { return frame.to_world(p); });
  return scene;
}

}  // namespace toposcope
