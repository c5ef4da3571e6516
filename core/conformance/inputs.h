// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Meshes and points for the conformance kit: about 2 units across and centred on the origin, without symmetries.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "toposcope/system/random.h"
#include "trial.h"

namespace toposcope {

/// Seeded numbers, the same on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : stream_(seed * SplitMix64::step) {}
  std::uint64_t next() { return stream_(); }
  double uniform(double low = 0, double high = 1);
  double normal();
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

 private:
  SplitMix64 stream_;
};

Eigen::Matrix3d random_rotation(std::uint64_t seed);

struct NamedSoup {
  std::string name;
  TriangleSoup soup;
};

/// A torus whose tube varies, closed; about 2 * around * along faces.
TriangleSoup uneven_torus(int around, int along);
/// A wavy sheet with a border.
TriangleSoup wavy_sheet(int nx, int ny);
/// A block of unequal sides with blunt edges of n x n quads a side: flat parts and creases.
TriangleSoup block(int n);

/// One triangle, needles, folds, faces without area, loose vertices, separate pieces: all that Mesh accepts.
std::vector<NamedSoup> degenerate_soups();

TriangleSoup moved(const TriangleSoup& soup, const Motion& motion);

}  // namespace toposcope
