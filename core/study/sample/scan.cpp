// SPDX-License-Identifier: BSD-3-Clause
#include "sample/scan.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "base/errors.h"
#include "mesh/repair.h"
#include "pipeline/filters.h"
#include "plugin/plugin_host.h"
#include "sample/depth_fusion.h"
#include "sample/scan_parts.h"
#include "sample/thin.h"
#include "toposcope/geometry/spread_directions.h"
#include "toposcope/system/random.h"

namespace toposcope {

namespace {

void check(const ScanSettings& settings) {
  const auto refuse = [](const std::string& what) { throw UsageError("scan: " + what); };
  if (settings.viewpoints < 4 || settings.viewpoints > 1000)
    refuse(fmt::format("viewpoints is {}: it must lie between 4 and 1000; the default is 60", settings.viewpoints));
  if (settings.seen_from > 1000)
    refuse(
        fmt::format("seen from {} viewpoints: it must be at most 1000; 4 show most of one side", settings.seen_from));
  if (!(settings.noise_rel >= 0 && settings.noise_rel <= 0.02))
    refuse(fmt::format("noise is {} box diagonals: it must lie between 0 and 0.02; the default is 0.0005",
                       settings.noise_rel));
}

struct Extent {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  double diagonal() const { return (high - low).norm(); }
  Vec3 center() const { return (low + high) / 2; }
};

Extent extent_of(const std::vector<Vec3>& positions) {
  Extent extent;
  for (const Vec3& p : positions) {
    extent.low = extent.low.cwiseMin(p);
    extent.high = extent.high.cwiseMax(p);
  }
  return extent;
}

double area_of(const TriangleSoup& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    area += (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm() / 2;
  }
  return area;
}

/// All around, or over the half sphere about `side`.
std::vector<Vec3> chosen_directions(const ScanSettings& settings, const Vec3& side) {
  if (settings.seen_from == 0) return spread_directions(settings.viewpoints);
  std::vector<Vec3> directions = spread_directions(2 * settings.seen_from);
  std::stable_sort(directions.begin(), directions.end(),
                   [&](const Vec3& a, const Vec3& b) { return a.dot(side) > b.dot(side); });
  directions.resize(settings.seen_from);
  return directions;
}

/// A uniformly distributed rotation (Shoemake 1992).
template <class Uniform>
Eigen::Matrix3d random_rotation(Uniform uniform) {
  const double u = uniform(), a = 2 * pi * uniform(), b = 2 * pi * uniform();
  const double s = std::sqrt(1 - u), t = std::sqrt(u);
  return Eigen::Quaterniond(s * std::sin(a), s * std::cos(a), t * std::sin(b), t * std::cos(b))
      .normalized()
      .toRotationMatrix();
}

/// A net of cells half as large as the thinnest part is thick keeps both its sides. For thinner parts than `finest`
/// cells bear it is laid a little outside them, as far as the gaps between parts allow. Noise does not make it coarser:
/// many views average it out.
DepthFusion fusion_for(const Sample& exact, const ScanSettings& settings, double diagonal) {
  constexpr double thinnest_allowed = 0.02;  // of the diagonal, where the sample does not tell
  const double thinnest = exact.thinnest > 0 ? exact.thinnest : thinnest_allowed * diagonal;
  const double room = std::clamp((exact.gap - thinnest) / 4, 0.0, 0.75 * thinnest);
  const double edge = std::sqrt(4 / std::sqrt(3.0) * area_of(exact.mesh) / settings.faces);
  const double spacing = std::min(0.5 * (thinnest + 2 * room), 0.6 * edge);
  return {.spacing = spacing, .level = std::max(0.0, spacing - thinnest / 2), .noise = settings.noise_rel * diagonal};
}

/// The steps from the raw surface to the mesh.
std::vector<FilterStation> filters_for(PluginHost& host, Index faces, int smoothing) {
  const auto plugin = [&](const char* id, const std::vector<GivenOption>& given) {
    return make_filter(host, id, given, "scan");
  };
  // Normalising is the slow step: it gets few faces more than are wanted, and needs no more than two rounds for that.
  return {plugin("taubin", {{"passes", std::to_string(smoothing)}}),
          {"thin", std::make_shared<Thin>(faces + faces / 40)},
          plugin("normalise", {{"faces", std::to_string(faces)}, {"rounds", "2"}})};
}

}  // namespace

Sample scan(const Sample& exact, const ScanSettings& settings, PluginHost& host, Context& context) {
  check(settings);
  const Extent extent = extent_of(exact.mesh.positions);
  const double diagonal = extent.diagonal();
  std::mt19937_64 random(settings.seed);
  const auto uniform = [&] { return uniform_closed_open(random()); };
  const Eigen::Matrix3d rotation = random_rotation(uniform);
  const Vec3 side = random_rotation(uniform).col(0);
  const Vec3 to = diagonal * (2 * Vec3(uniform(), uniform(), uniform()) - Vec3::Ones());

  // The scanner looks at the origin; the object moves to its place in the end.
  Sample posed = exact;
  if (!settings.parts) posed.part_names.clear();
  for (Vec3& p : posed.mesh.positions) p = rotation * (p - extent.center());
  double radius = 0;
  for (const Vec3& p : posed.mesh.positions) radius = std::max(radius, p.norm());
  const DepthFusion fusion = fusion_for(exact, settings, diagonal);
  const double spacing = fusion.spacing, noise = fusion.noise;
  const std::vector<DepthView> views =
      scan_depths(posed.mesh, chosen_directions(settings, side),
                  {.pixel = spacing / 2, .distance = 3 * radius, .noise = noise, .seed = settings.seed}, context);
  const Extent box = extent_of(posed.mesh.positions);
  const Vec3 margin = Vec3::Constant(4 * noise);
  TriangleSoup raw = fuse_depths(views, fusion, box.low - margin, box.high + margin, context);
  const bool partial = settings.seen_from > 0;
  if (partial) keep_measured(raw, views, spacing + 3 * noise, context);
  keep_large_components(raw, !partial);
  const std::string name = "the scan of the " + exact.truth.class_name;
  if (raw.triangles.empty()) throw MeshError(name + ": nothing was seen; more viewpoints or less noise show something");
  const double share = partial ? std::min(1.0, area_of(raw) / area_of(exact.mesh)) : 1;
  const auto faces = static_cast<Index>(std::max(4.0, std::round(share * settings.faces)));
  raw.input_faces = static_cast<Index>(raw.triangles.size());
  raw.face_origin.resize(raw.triangles.size());
  std::iota(raw.face_origin.begin(), raw.face_origin.end(), Index{0});
  if (partial) repair(raw, name);
  const Mesh surface(std::move(raw), name, &context);
  const PreparedMesh prepared = apply_filters(surface, filters_for(host, faces, settings.smoothing), context);

  Sample made =
      scanned_truth(posed, prepared.view(), {rotation, extent.center(), to}, partial ? 3 * spacing : 0, context);
  made.scan = ScanRecord{.viewpoints = partial ? settings.seen_from : settings.viewpoints,
                         .partial = partial,
                         .noise_rel = settings.noise_rel,
                         .smoothing = settings.smoothing,
                         .spacing = spacing,
                         .rotation = {rotation.row(0), rotation.row(1), rotation.row(2)},
                         .translation = to - rotation * extent.center()};
  made.seed = settings.seed;
  return made;
}

}  // namespace toposcope
