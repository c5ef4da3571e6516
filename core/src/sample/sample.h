// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "plugin/manifest.h"
#include "toposcope/context.h"

namespace toposcope {

/// A kind of parametric object and its parameters. All lengths are in one unit of the user's choice.
struct SampleKind {
  std::string name;
  std::string summary;
  std::vector<OptionRow> parameters;  ///< default, range, unit, meaning
};
std::vector<SampleKind> sample_kinds();

struct SampleRequest {
  std::string kind = {};
  std::map<std::string, double> parameters = {};  ///< those that differ from the kind's defaults
  Index faces = 20000;                            ///< of the mesh; met within 3 %
  double noise_rel = 0;    ///< standard deviation of the noise along the vertex normals, in box diagonals
  std::uint64_t seed = 1;  ///< of the noise
};

/// A feature of the object with its exact shape.
struct SampleFeature {
  std::string name;
  std::string shape;  ///< circle, plane, line-group
  /// As in result.json: a number (`closed`: 0 or 1), a point or direction (3 values), several points (multiples of 3).
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
  std::vector<Vec3> points;     ///< on the exact surface, before noise; empty where the object lacks the feature
  std::vector<Index> vertices;  ///< for each point the mesh vertex nearest to it; no vertex twice
  std::vector<std::pair<std::string, std::vector<Index>>> groups;  ///< named sets of indices into `points`
};

/// How an object was scanned (scan.h).
struct ScanRecord {
  Index viewpoints = 0;
  bool partial = false;  ///< what they did not see is missing
  double noise_rel = 0;  ///< standard deviation along the ray, in diagonals of the object's box
  int smoothing = 0;     ///< passes of Taubin's filter
  double spacing = 0;    ///< of the grid
  std::array<Vec3, 3> rotation = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  ///< rows: scan = rotation * object
  Vec3 translation = Vec3::Zero();                                               ///< + translation
};

struct Sample {
  std::string kind;
  std::vector<std::pair<std::string, double>> parameters;  ///< all, in the order of the kind's table
  double noise_rel = 0;
  std::uint64_t seed = 1;
  TriangleSoup mesh;
  std::vector<SampleFeature> features;
  std::vector<std::string> part_names;
  std::vector<std::uint8_t> face_part;  ///< for each triangle an index into part_names
  double thinnest = 0;                  ///< least thickness of material or gap; 0: not known
  std::optional<ScanRecord> scan;
};

/// Makes a closed, oriented, manifold mesh of the object and its truth.
/// \throw UsageError  unknown kind or parameter, value out of range, parameters that contradict each other, a face
///        count too low for the object
Sample make_sample(const SampleRequest& request, Context& context);

/// The truth as JSON (schemas/truth.schema.json).
/// \param mesh_file  name of the mesh's file, for the member `mesh`
std::string truth_json(const Sample& sample, const std::string& mesh_file = "");

}  // namespace toposcope
