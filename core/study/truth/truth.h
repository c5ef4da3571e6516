// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// Points marked on one part of a feature: a ring around an end of a handle.
struct TruthGroup {
  std::string name;
  std::vector<Vec3> points;
  Vec3 centroid = Vec3::Zero();
};

/// Where two circles bound what counts as one feature: the ring of a pipe's opening.
struct TruthBand {
  Vec3 center, normal;
  double inner = 0, outer = 0;  ///< radii
};

struct TruthFeature {
  std::string name;
  std::vector<Vec3> points;  ///< marked on the feature, dissertation 5.3.2
  std::vector<TruthGroup> groups;
  std::optional<TruthBand> band;
  /// False: the mesh does not have the feature, and to label it is wrong.
  bool exists() const { return !points.empty() || !groups.empty(); }
};

/// What is known of one mesh (schemas/truth.schema.json): marked by hand or made with the mesh.
struct Truth {
  std::string class_name;
  std::vector<TruthFeature> features;
  std::optional<double> mean_edge, diagonal;  ///< that distances are judged by; without them those of the mesh
  std::string
      document;  ///< the file as JSON without its parts, which may be as long as the mesh; empty: not from a file
  const TruthFeature* find(std::string_view name) const;
};

/// \throw UsageError  names the file and the member
Truth read_truth(const std::filesystem::path& path);

/// `<stem>.truth.json` beside the mesh; empty where there is none.
std::filesystem::path truth_beside(const std::filesystem::path& mesh);

}  // namespace toposcope
