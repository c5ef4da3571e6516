// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sample/sample.h"

namespace toposcope {

class PluginHost;

/// What a scanner and the dissertation's chain (2.4) make of an object.
struct ScanSettings {
  Index faces = 20000;    ///< of the mesh
  Index viewpoints = 60;  ///< spread evenly around the object
  Index seen_from = 0;  ///< above 0: so many viewpoints instead, spread over the half sphere about a random direction,
                        ///< and the mesh stays open
  double noise_rel = 0.0005;  ///< standard deviation of the noise along the ray, in diagonals of the object's box
  int smoothing = 3;          ///< passes of Taubin's filter
  std::uint64_t seed = 1;     ///< of pose, noise and choice of viewpoints
  bool parts = true;          ///< whether the truth tells the part of every face
};

/// An object as make_sample makes it, but with the mesh that a scan wants: its vertices lie on the exact surface, as do
/// its edges' middles within 0.0004 diagonals. Not always a manifold. \throw UsageError  as make_sample does
Sample make_scan_target(const SampleRequest& request, Context& context);

/// Turns the object at random, moves it by up to its diagonal along each axis, looks at it from viewpoints at three
/// times its radius, fuses the depths on a grid, extracts the surface, and applies the filters `taubin` and
/// `normalise`, with a quick thinning between them.
/// The grid's spacing is 0.6 edges of the wanted mesh, or less where the thinnest part demands it.
///
/// Truth: features move with the object (parameters whose length is a multiple of three are points, or directions when
/// they are called normal, axis or direction); `points` stay exact; `vertices` are the nearest; a face's part is that
/// of the nearest exact face. When seen from some viewpoints only, points more than three grid spacings from what is
/// left are dropped, and of a feature of which less than `least_share` is left all.
///
/// \param host  has the two filters
/// \throw UsageError  settings out of range; MeshError  nothing was seen; PluginError  a filter is missing
Sample scan(const Sample& exact, const ScanSettings& settings, PluginHost& host, Context& context);

inline constexpr double least_share = 0.25;

}  // namespace toposcope
