// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/own_axes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "model/networks.h"

namespace toposcope {
namespace {

constexpr double least_left = 0.02;  ///< of a displacement, beside the axes before it: below, nothing is known

class AxisFinder {
 public:
  AxisFinder(const Model& model, std::span<const FittedShape* const> found, const Place& middle)
      : model_(model), found_(found), middle_(middle), places_(places()) {}

  OwnAxes find() {
    OwnAxes axes;
    for (const bool named : {true, false})
      for (const auto& [direction, axis] : {std::pair<const char*, std::optional<OwnAxis>*>{"right", &axes.right},
                                            {"front", &axes.front},
                                            {"up", &axes.up}})
        if (!*axis && (!named || named_axis(direction))) *axis = axis_along(direction, named);
    return axes;
  }

 private:
  /// A direction known up to its sense, and by how much it may be tilted.
  struct Line {
    Vec3 direction = Vec3::Zero();
    double tilt_sd = 0;  ///< rad
  };

  struct Displacement {
    Vec3 way = Vec3::Zero();
    double variance = 0;  ///< in each direction, but for that of the middle
    int middles = 0;      ///< how often the middle stands in it, with its sign
  };

  /// Per object of the abstract part: of one that holds features, from those found, if any; else in the middle, of no
  /// deviation of its own.
  std::vector<std::optional<Place>> places() {
    const AbstractModel& abstract = model_.abstract;
    std::vector<std::vector<Index>> below(abstract.objects.size());
    for (const std::vector<Link>* network : {&abstract.topology, &abstract.parts})
      for (const Link& link : *network) below[link.from].push_back(link.to);
    std::vector<std::vector<Index>> realised_by(abstract.objects.size());
    for (Index f = 0; f < found_.size(); ++f)
      for (Index object = 0; object < abstract.objects.size(); ++object)
        if (abstract.objects[object].name == model_.features[f].realises) realised_by[object].push_back(f);
    std::vector<std::optional<Place>> places(abstract.objects.size());
    holds_any_.assign(places.size(), false);
    for (Index object = 0; object < places.size(); ++object) {
      std::vector<Index> held = {object};
      for (std::size_t i = 0; i < held.size(); ++i)
        for (const Index next : below[held[i]])
          if (std::find(held.begin(), held.end(), next) == held.end()) held.push_back(next);
      Place sum;
      double count = 0, variance = 0;
      for (const Index each : held)
        for (const Index f : realised_by[each]) {
          holds_any_[object] = true;
          if (!found_[f]) continue;
          sum.point += found_[f]->centroid;
          variance += found_[f]->centroid_sd * found_[f]->centroid_sd;
          ++count;
        }
      if (count > 0) places[object] = Place{sum.point / count, std::sqrt(variance) / count};
      if (!holds_any_[object]) places[object] = Place{middle_.point, 0};
    }
    return places;
  }

  /// What the associations of a direction say, each turned so that it points that way.
  std::vector<Displacement> displacements(std::string_view direction) const {
    std::vector<Displacement> all;
    for (const Link& link : model_.abstract.associations) {
      const bool back = link.kind == inverse_of(direction);
      if (!back && link.kind != direction) continue;
      const std::optional<Place>&from = places_[link.from], &to = places_[link.to];
      if (!from || !to || (!holds_any_[link.from] && !holds_any_[link.to])) continue;
      const int middles = (holds_any_[link.from] ? 0 : 1) - (holds_any_[link.to] ? 0 : 1);
      all.push_back({back ? Vec3(to->point - from->point) : Vec3(from->point - to->point),
                     from->sd * from->sd + to->sd * to->sd, back ? -middles : middles});
    }
    return all;
  }

  const AxisFeatures* named_axis(std::string_view direction) const {
    for (const AxisFeatures& axis : model_.axes)
      if (axis.direction == direction) return &axis;
    return nullptr;
  }

  /// The mean of the found features' normals or axes.
  std::optional<Line> line_of(const AxisFeatures& axis) const {
    Vec3 sum = Vec3::Zero();
    double variance = 0, count = 0;
    for (const Index f : axis.features) {
      if (!found_[f] || found_[f]->orientation == Orientation::none) continue;
      const Vec3& direction = found_[f]->direction;
      sum += direction.dot(sum) < 0 ? Vec3(-direction) : direction;
      variance += found_[f]->direction_sd * found_[f]->direction_sd;
      ++count;
    }
    if (!(sum.norm() > least_left)) return std::nullopt;
    return Line{sum, std::sqrt(variance) / count};
  }

  std::optional<OwnAxis> axis_along(const char* direction, bool named) {
    const std::vector<Displacement> all = displacements(direction);
    Vec3 sum = Vec3::Zero();
    for (const Displacement& each : all) sum += each.way;
    std::optional<Line> line;
    if (named)
      line = line_of(*named_axis(direction));
    else  // within 45 degrees of it: a uniform distribution's deviation
      line = Line{sum, pi / 4 / std::sqrt(3.0)};
    if (all.empty() || !line) return std::nullopt;
    const double whole = line->direction.norm();
    for (const Line& other : settled_) line->direction -= other.direction.dot(line->direction) * other.direction;
    if (!(line->direction.norm() > least_left * whole)) return std::nullopt;
    line->direction.normalize();
    const double height = sum.dot(line->direction);
    double variance = 0, middles = 0;
    for (const Displacement& each : all) {
      variance += each.variance;
      middles += each.middles;
    }
    variance += middles * middles * middle_.sd * middle_.sd;  // the same one in each
    // What lies across a tilted axis counts for height. Towards another axis it is tilted as that one is.
    Vec3 across = sum - height * line->direction;
    for (const Line& other : settled_) {
      const double along = other.direction.dot(across);
      variance += along * along * other.tilt_sd * other.tilt_sd;
      across -= along * other.direction;
    }
    variance += across.squaredNorm() * line->tilt_sd * line->tilt_sd;
    settled_.push_back(*line);
    const double certainty = variance > 0 ? std::erf(std::abs(height) / std::sqrt(2 * variance)) : 1;
    return OwnAxis{height < 0 ? Vec3(-line->direction) : line->direction, height == 0 ? 0 : certainty};
  }

  const Model& model_;
  std::span<const FittedShape* const> found_;
  Place middle_;
  std::vector<bool> holds_any_;  ///< per object: features, found or not
  std::vector<std::optional<Place>> places_;
  std::vector<Line> settled_;
};

}  // namespace

Place middle_of(const MeshView& mesh) {
  Vec3 sum = Vec3::Zero();
  double whole = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    const double area = (q - p).cross(r - p).norm();
    sum += area / 3 * (p + q + r);
    whole += area;
  }
  // Somewhere within the middle half of the shortest side: a uniform distribution's deviation.
  return {whole > 0 ? Vec3(sum / whole) : mesh.box.center, mesh.box.c() / (4 * std::sqrt(3.0))};
}

OwnAxes own_axes(const Model& model, std::span<const FittedShape* const> found, const Place& middle) {
  return AxisFinder(model, found, middle).find();
}

std::optional<double> right_handed(const OwnAxes& axes) {
  if (!axes.up || !axes.front || !axes.right) return std::nullopt;
  const double turned = axes.right->direction.cross(axes.front->direction).dot(axes.up->direction);
  const double certainty = axes.up->certainty * axes.front->certainty * axes.right->certainty;
  return (1 + (turned < 0 ? -certainty : certainty)) / 2;
}

}  // namespace toposcope
