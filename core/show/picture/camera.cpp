// SPDX-License-Identifier: BSD-3-Clause
#include "picture/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <map>

#include "base/errors.h"

namespace toposcope {
namespace {

constexpr double field_of_view_deg = 22;  // of the picture's height: little perspective, enough to tell near from far
constexpr double margin = 0.06;           // of width and height, on each side

bool number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

View view_from(const std::string& text) {
  static const std::map<std::string, View> named = {{"iso", {}},         {"front", {0, 0}},  {"back", {180, 0}},
                                                    {"left", {-90, 0}},  {"right", {90, 0}}, {"top", {0, 90}},
                                                    {"bottom", {0, -90}}};
  if (const auto found = named.find(text); found != named.end()) return found->second;
  View view;
  const std::size_t comma = text.find(',');
  if (comma == text.npos || !number(std::string_view(text).substr(0, comma), view.azimuth_deg) ||
      !number(std::string_view(text).substr(comma + 1), view.elevation_deg) || std::abs(view.elevation_deg) > 90)
    throw UsageError(
        "--view " + text +
        ": expected auto, iso, front, back, left, right, top, bottom, or azimuth,elevation in degrees, as in "
        "-55,24");
  return view;
}

Camera camera_for(const View& view, const Stand& stand, std::span<const Vec3> points, int width, int height) {
  const double azimuth = view.azimuth_deg * pi / 180, elevation = view.elevation_deg * pi / 180;
  const Vec3 up = stand.up, away = -stand.front, right = away.cross(up);
  const Vec3 level = std::sin(azimuth) * right - std::cos(azimuth) * away;  // towards the viewer, on the horizon
  Camera camera;
  camera.axes.row(0) = std::cos(azimuth) * right + std::sin(azimuth) * away;
  camera.axes.row(1) = std::cos(elevation) * up - std::sin(elevation) * level;
  camera.axes.row(2) = std::cos(elevation) * level + std::sin(elevation) * up;
  camera.focal = height / 2.0 / std::tan(field_of_view_deg / 2 * pi / 180);
  camera.center_x = width / 2.0;
  camera.center_y = height / 2.0;

  // |a - eye.a| <= k (eye.c - c) for every point (a, c) and both directions of the picture: four lines that bound the
  // eye. The nearest place that meets all, and halves what is left.
  Vec3 most = Vec3::Constant(-1e300), least = most;  // of a + k c and of -a + k c
  const double k[] = {width / 2.0 * (1 - 2 * margin) / camera.focal, height / 2.0 * (1 - 2 * margin) / camera.focal};
  for (const Vec3& p : points) {
    const Vec3 q = camera.axes * p;
    for (Eigen::Index i = 0; i < 2; ++i) {
      most[i] = std::max(most[i], q[i] + k[i] * q.z());
      least[i] = std::max(least[i], -q[i] + k[i] * q.z());
    }
  }
  const Vec3 eye((most[0] - least[0]) / 2, (most[1] - least[1]) / 2,
                 std::max((most[0] + least[0]) / (2 * k[0]), (most[1] + least[1]) / (2 * k[1])));
  camera.eye = camera.axes.transpose() * eye;
  return camera;
}

}  // namespace toposcope
