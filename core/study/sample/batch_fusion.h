// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sample/depth_fusion.h"
#include "sample/depth_lookup.h"

namespace toposcope {

struct FusionThresholds {
  float front;   ///< free space begins here; beside a node inside the net those outside are less than a cell's diagonal
                 ///< away
  float behind;  ///< a surface seen says nothing of what is deeper
  float window;  ///< measurements so far behind the foremost one count as of the same surface
  float doubt;   ///< and so deep as of another one, when other views saw through
  float carved;  ///< value of a node that was seen through and not measured
  explicit FusionThresholds(const DepthFusion& f)
      : front(static_cast<float>(1.75 * f.spacing + f.level + 3 * f.noise)),
        behind(static_cast<float>(1.7 * f.spacing)),
        window(static_cast<float>(0.25 * f.spacing + 6 * f.noise)),
        doubt(static_cast<float>(0.25 * f.spacing + 3 * f.noise)),
        carved(static_cast<float>(0.5 * f.spacing + f.level)) {}
};

/// What the views say of a batch of points that lie close together.
class BatchFusion {
 public:
  BatchFusion(const DepthFusion& fusion, std::size_t most_points)
      : t_(fusion),
        top_(most_points),
        sum_(most_points),
        total_(most_points),
        carved_(most_points),
        scratch_(static_cast<Eigen::Index>(most_points)) {}

  /// \param views           all that may have measured near the points, or seen through some of them unless `carved`
  /// \param center, radius  a ball that contains the points
  /// \param carved          some view saw through all of them, or it does not matter
  void fuse(std::span<const DepthLookup* const> views, const PointBatch& points, std::size_t count,
            const Eigen::Vector3f& center, float radius, bool carved) {
    std::fill_n(top_.begin(), count, nothing);
    std::fill_n(carved_.begin(), count, 0);
    near_.clear();
    mixed_.clear();
    for (const DepthLookup* view : views) {
      const DepthLookup::Verdict verdict = view->judge(center, radius, t_.front, t_.behind);
      carved = carved || verdict == DepthLookup::Verdict::free;
      if (verdict == DepthLookup::Verdict::mixed) mixed_.push_back(view);
      if (verdict == DepthLookup::Verdict::near) look(*view, points, count);
    }
    if (carved)
      std::fill_n(carved_.begin(), count, 1);
    else
      for (const DepthLookup* view : mixed_) look(*view, points, count);
    std::fill_n(sum_.begin(), count, 0.0F);
    std::fill_n(total_.begin(), count, 0.0F);
    for (const Measurement& m : near_) {
      const float w = m.distance >= top_[m.point] - t_.window ? m.weight : 0;
      sum_[m.point] += w * m.distance;
      total_[m.point] += w;
    }
  }

  bool measured(std::size_t i) const { return top_[i] > nothing; }
  float measurement(std::size_t i) const { return sum_[i] / total_[i]; }
  float value(std::size_t i) const {
    if (carved_[i] == 0) return measured(i) ? measurement(i) : -t_.front;
    if (!measured(i)) return t_.front;
    // Seen through, though the views near it say that it lies deeper than the noise explains: behind them.
    return top_[i] > -t_.doubt ? measurement(i) : t_.carved;
  }

 private:
  void look(const DepthLookup& view, const PointBatch& points, std::size_t count) {
    view.look(points, static_cast<Eigen::Index>(count), scratch_, [&](std::size_t i, float distance, float weight) {
      if (distance > t_.front) {
        carved_[i] = 1;
      } else if (distance >= -t_.behind && weight > 0) {
        top_[i] = std::max(top_[i], distance);
        near_.push_back({static_cast<std::uint32_t>(i), distance, weight});
      }
    });
  }

  static constexpr float nothing = -1e30F;
  struct Measurement {
    std::uint32_t point;
    float distance, weight;
  };
  FusionThresholds t_;
  std::vector<float> top_, sum_, total_;
  std::vector<char> carved_;
  std::vector<Measurement> near_;
  std::vector<const DepthLookup*> mixed_;
  DepthLookup::Scratch scratch_;
};

}  // namespace toposcope
