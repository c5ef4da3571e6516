// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// The marks on one part of a feature: a ring around an end of a handle.
struct TruthGroup {
  std::string name;
  std::vector<Index> members;    ///< into the feature's points
  Vec3 centroid = Vec3::Zero();  ///< of the whole exact ring where it is known, whatever marks of it are kept
};

/// Where two circles bound what counts as one feature: the ring of a pipe's opening.
struct TruthBand {
  Vec3 center, normal;
  double inner = 0, outer = 0;  ///< radii, the mesh's unit
};

struct TruthFeature {
  std::string name;
  std::string shape;  ///< circle, plane, line-group; empty: not known
  /// As in result.json: a number (`closed`: 0 or 1), a point or direction (3 values), several points (multiples of 3).
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
  std::vector<Vec3> points;        ///< marked on the feature (dissertation 5.3.2), or on its exact surface before noise
  std::vector<Index> vertices;     ///< for each point the mesh vertex nearest to it; empty: not known
  std::vector<TruthGroup> groups;  ///< none, or each point is of one of them
  /// False: the mesh does not have the feature, and to label it is wrong.
  bool exists() const { return !points.empty(); }
  /// Of the parameters `center`, `normal` and `band`; none without.
  std::optional<TruthBand> band() const;
};

/// What is known of one mesh (schemas/truth.schema.json): marked by hand or made with the mesh.
struct Truth {
  std::string class_name;
  std::vector<TruthFeature> features;
  std::optional<double> mean_edge, diagonal;  ///< that distances are judged by; without them those of the mesh
  /// The file as JSON without its parts, which may be as long as the mesh; empty: not from a file.
  std::string document;
  const TruthFeature* find(std::string_view name) const;
};

/// \throw UsageError  names the file and the member
Truth read_truth(const std::filesystem::path& path);

/// `<stem>.truth.json` beside the mesh; empty where there is none.
std::filesystem::path truth_beside(const std::filesystem::path& mesh);

}  // namespace toposcope
