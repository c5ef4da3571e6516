// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What pipe fittings have in common: pipes of one bore and wall that leave one place, each with a rim at its end.

#include <optional>
#include <string>
#include <vector>

#include "sample/solid.h"

namespace toposcope {

/// A pipe from the fitting's middle out to its rim.
struct Pipe {
  std::string rim;  ///< name of the feature
  Vec3 direction = Vec3::UnitX();
  double length = 0;             ///< from the middle to the rim
  std::string length_parameter;  ///< that sets the length, for messages
  double per_length = 1;         ///< that parameter's share in the length: 0.5 where it spans two pipes
};

/// One or two pipes that go over into each other without a fillet: the halves of a run, or a single branch.
struct Run {
  std::string part;
  std::vector<Pipe> pipes;
};

struct Fitting {
  std::string kind;
  double bore = 0, wall = 0;
  bool has_socket = false;
  double socket = 0, depth = 0;  ///< inner radius and depth of a socket
  double fillet = 0, edge = 0;
  std::vector<Run> runs;
  /// Radius of the arc in which the only run's two pipes, at right angles, meet; without it all pipes meet in a ball.
  std::optional<double> bend;

  double outer() const { return bore + wall; }
  double mouth() const { return has_socket ? socket : bore; }  ///< inner radius of an opening
  double hub() const { return mouth() + wall; }                ///< outer radius at an opening
  double hub_length() const { return has_socket ? depth + wall : 0; }
};

/// A kind: bore and wall, then the kind's own lengths, then sockets and roundings.
/// \param socketed  lengths of the preset with sockets
SampleKind fitting_kind(const std::string& name, const std::string& summary, const std::vector<OptionRow>& lengths,
                        const std::map<std::string, double>& socketed, const std::vector<RandomRange>& ranges);

/// A fitting without its pipes.
Fitting read_fitting(const std::string& kind, const ParameterValues& parameters);

/// \throw UsageError  parameters that contradict each other
Solid make_fitting(const Fitting& fitting);

}  // namespace toposcope
