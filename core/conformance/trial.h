// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plugin/option_check.h"
#include "toposcope/context.h"
#include "toposcope/types.h"

namespace toposcope {

/// x becomes rotation * (scale * x) + shift; what has an order is shuffled where `shuffle` is not 0.
struct Motion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1;
  Vec3 shift = Vec3::Zero();
  std::uint64_t shuffle = 0;
  Vec3 operator()(const Vec3& x) const { return rotation * (scale * x) + shift; }
};

/// What a plugin answered to a trial.
struct Answer {
  std::string bytes;                  ///< all of it that must be the same on every run, bit by bit
  std::string flaw;                   ///< what of it breaks the contract of its kind; empty: nothing
  std::shared_ptr<const void> value;  ///< for Trial::change
};

/// One input that a plugin of a kind can be run on. Immutable; may be run from several threads at once.
class Trial {
 public:
  explicit Trial(std::string called) : name(std::move(called)) {}
  virtual ~Trial() = default;
  /// \param object     the plugin's: a pointer to the kind's base class
  /// \param arguments  what a model would give; shapes and relations
  /// \throw whatever the plugin throws
  virtual Answer run(const void* object, const Options& arguments, Context& context) const = 0;
  /// The same input moved.
  virtual std::unique_ptr<Trial> moved(const Motion& motion) const = 0;
  /// What is different in two answers, the second to the moved input, beyond rounding and the plugin's own uncertainty;
  /// empty: nothing.
  virtual std::string change(const Answer& before, const Answer& after, const Motion& motion) const = 0;

  std::string name;  ///< in a sentence: "a torus"
};

using Trials = std::vector<std::unique_ptr<const Trial>>;

/// All inputs for plugins of one kind. None is symmetric or has ties that rounding would break.
struct TrialSet {
  Trials ordinary;
  Trials degenerate;          ///< empty, tiny, flat, without extent; all within what the kernel guarantees
  Trials poisoned;            ///< hold NaN, which the kernel never hands out
  Trials large;               ///< long work: to be cancelled
  bool nan_may_pass = false;  ///< NaN may come of NaN: the kernel refuses it
  bool pose = true;           ///< the kind promises that rotation, translation and scale do not matter
};

TrialSet trials_for(const PluginManifest& plugin);

// One for each kind.
TrialSet workset_trials(const PluginManifest& plugin);
TrialSet shape_trials(const PluginManifest& plugin);
TrialSet relation_trials(const PluginManifest& plugin);
TrialSet labeler_trials(const PluginManifest& plugin);
TrialSet filter_trials(const PluginManifest& plugin);

/// Appends the bytes of a number, list or text.
template <class T>
void append_bytes(std::string& bytes, const T& value) {
  if constexpr (requires { value.size(); }) {
    append_bytes(bytes, value.size());
    for (const auto& each : value) append_bytes(bytes, each);
  } else {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
}

}  // namespace toposcope
