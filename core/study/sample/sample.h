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
#include "truth/truth.h"

namespace toposcope {

/// Where `--random` draws a parameter from, evenly. A switch is on with probability `high`.
struct RandomRange {
  std::string name;
  double low = 0, high = 1;
  std::string of = {};  ///< the range is in parts of this parameter, drawn before; empty: in the parameter's own unit
  double step = 0;      ///< of whole numbers and choices
};

struct SamplePreset {
  std::string name;
  std::string summary;
  std::map<std::string, double> parameters;  ///< those that differ from the defaults
};

/// A kind of parametric object and its parameters. All lengths are in one unit of the user's choice.
struct SampleKind {
  std::string name;
  std::string summary;
  std::vector<OptionRow> parameters;  ///< default, range, unit, meaning
  std::vector<SamplePreset> presets = {};
  std::vector<RandomRange> ranges = {};  ///< in the order of drawing; all parameters occur
};
std::vector<SampleKind> sample_kinds();

/// The number that stands for a parameter's text: 0 or 1 of a switch, the place of a choice from 0, or the number.
/// \throw UsageError  unknown parameter, or a text that it does not take
double sample_parameter(const SampleKind& kind, const std::string& name, const std::string& text);

/// What `--random` draws for a parameter: "60 to 140", "0.25 to 0.5 wall", "true in 40 of 100".
std::string describe_range(const SampleKind& kind, const std::string& parameter);

struct SampleRequest {
  std::string kind = {};
  std::map<std::string, double> parameters = {};  ///< those that differ from the kind's defaults
  Index faces = 20000;                            ///< of the mesh; met within 3 %, but of a tessellated kind
  double noise_rel = 0;     ///< standard deviation of the noise along the vertex normals, in box diagonals
  std::uint64_t seed = 1;   ///< of the noise and of random parameters
  std::string preset = {};  ///< name of a preset to start from instead of the defaults
  bool random = false;      ///< draw the parameters that are not given
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

/// A made mesh, how it was made, and its truth.
struct Sample {
  std::vector<std::pair<std::string, double>> parameters;  ///< all, in the order of the kind's table
  double noise_rel = 0;
  std::uint64_t seed = 1;
  TriangleSoup mesh;
  Truth truth;  ///< its class is the kind
  std::vector<std::string> part_names;
  std::vector<std::uint8_t> face_part;  ///< for each triangle an index into part_names
  double thinnest = 0, gap = 0;         ///< least thickness of material, least gap between parts; 0: not known
  bool tessellated =
      false;  ///< as a program for CAD exports it: the kind, and not the request, sets the number of faces
  std::optional<ScanRecord> scan;
};

/// Makes a closed, oriented, manifold mesh of the object and its truth; an unwelded one has corners of its own for each
/// face.
/// \throw UsageError  unknown kind, preset or parameter, a value out of range, parameters that contradict each other,
/// fewer faces than the object needs
Sample make_sample(const SampleRequest& request, Context& context);

/// The truth as JSON (schemas/truth.schema.json).
/// \param mesh_file  name of the mesh's file, for the member `mesh`
std::string truth_json(const Sample& sample, const std::string& mesh_file = "");

}  // namespace toposcope
