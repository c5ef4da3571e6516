// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "toposcope/plugin.h"
#include "trial.h"

namespace toposcope {

/// A check's finding: what is wrong, in one line.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A plugin under examination, with values for the options and arguments that it leaves to the user.
class Subject {
 public:
  Subject(const PluginManifest& of, const PluginDescriptor& descriptor) : manifest(of), descriptor_(descriptor) {}

  /// An object of the plugin, with all that must live as long.
  class Made {
   public:
    Made(const PluginDescriptor& descriptor, std::vector<OptionValue> values);
    ~Made();
    Made(const Made&) = delete;
    Made& operator=(const Made&) = delete;
    const void* object() const { return object_; }
    const std::string& refusal() const { return refusal_; }  ///< why there is no object

   private:
    const PluginDescriptor& descriptor_;
    std::vector<OptionValue> values_;
    Options options_;
    void* object_ = nullptr;
    std::string refusal_;
  };

  /// Its defaults, and `given` instead.
  std::unique_ptr<Made> make(const std::vector<GivenOption>& given = {}) const;
  /// Of the input scaled by `scale`: lengths with it.
  std::vector<OptionValue> arguments(const std::vector<GivenOption>& given = {}, double scale = 1) const;
  /// From now on these instead of the defaults.
  void settle(std::vector<GivenOption> arguments) { settled_ = std::move(arguments); }

  const PluginManifest& manifest;
  bool flawed = false;  ///< its answers are known to be flawed: no other check says so again

 private:
  const PluginDescriptor& descriptor_;
  std::vector<GivenOption> settled_;
};

/// A plugin may refuse its arguments' defaults by std::invalid_argument, because a model must say more: the first
/// argument that mends that is given.
void settle_arguments(Subject& subject, const TrialSet& trials);

// The checks. Each returns what it tried, in one line.
// \throw Failure, and whatever the plugin throws
std::string check_ordinary(const Subject& subject, const TrialSet& trials);
std::string check_contract(const Subject& subject, const TrialSet& trials);
std::string check_option_bounds(const Subject& subject, const TrialSet& trials);
std::string check_degenerate(const Subject& subject, const TrialSet& trials);
std::string check_poisoned(const Subject& subject, const TrialSet& trials);
std::string check_exceptions(const Subject& subject, const TrialSet& trials);
std::string check_cancellation(const Subject& subject, const TrialSet& trials, double patience_s);
std::string check_repeat(const Subject& subject, const TrialSet& trials);
std::string check_threads(const Subject& subject, const TrialSet& trials);
std::string check_rotation(const Subject& subject, const TrialSet& trials);
std::string check_translation(const Subject& subject, const TrialSet& trials);
std::string check_scale(const Subject& subject, const TrialSet& trials);
std::string check_order(const Subject& subject, const TrialSet& trials);

}  // namespace toposcope
