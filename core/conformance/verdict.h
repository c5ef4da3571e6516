// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace toposcope {

enum class Outcome { passed, failed, skipped };

/// What one check of the conformance kit found.
struct CheckVerdict {
  std::string check;  ///< its name: "manifest", "rotation", ...
  Outcome outcome = Outcome::passed;
  std::string detail;  ///< one line: what was tried, or what is wrong and where
};

/// Takes verdicts as they are reached. Somebody else may have to say where a plugin crashed, so each check is
/// announced.
class VerdictSink {
 public:
  virtual ~VerdictSink() = default;
  virtual void begin(const std::string& check) = 0;
  /// Within a check, the input that the plugin is about to get; from any thread.
  virtual void on(const std::string& input) = 0;
  virtual void end(const CheckVerdict& verdict) = 0;
};

}  // namespace toposcope
