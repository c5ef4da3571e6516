// SPDX-License-Identifier: BSD-3-Clause
#include "sample/draw.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "toposcope/system/random.h"

namespace toposcope {

namespace {

constexpr int most_draws = 1000;
constexpr int draws_per_decision = 25;

class Draw {
 public:
  /// Neighbouring seeds must give unrelated objects, unrelated to the noise of the same seed too.
  explicit Draw(std::uint64_t seed) : engine_(splitmix64(seed)) {}

  double operator()(const RandomRange& range, OptionType type, double unit) {
    const double share = uniform_closed_open(engine_());
    if (type == OptionType::boolean) return share < range.high ? 1 : 0;
    if (range.step > 0) {
      const double steps = std::floor((range.high - range.low) / range.step + 1.5);
      return range.low + range.step * std::min(std::floor(share * steps), steps - 1);
    }
    return unit * (range.low + share * (range.high - range.low));
  }

 private:
  std::mt19937_64 engine_;
};

OptionType type_of(const SampleKind& kind, const std::string& name) {
  for (const OptionRow& row : kind.parameters)
    if (row.name == name) return row.type;
  throw std::logic_error("range of an unknown parameter '" + name + "'");
}

}  // namespace

std::string describe_range(const SampleKind& kind, const std::string& parameter) {
  for (const RandomRange& range : kind.ranges) {
    if (range.name != parameter) continue;
    const OptionType type = type_of(kind, parameter);
    if (type == OptionType::boolean) return fmt::format("true in {:.0f} of 100", 100 * range.high);
    if (type == OptionType::text) return "any";
    if (range.step > 1) return fmt::format("{} to {} by {}", range.low, range.high, range.step);
    return fmt::format("{} to {}{}{}", range.low, range.high, range.of.empty() ? "" : " ", range.of);
  }
  return "the default";
}

std::map<std::string, double> draw_parameters(const SampleKind& kind, const std::map<std::string, double>& given,
                                              std::uint64_t seed, int* draws) {
  check_parameters(kind, given);
  Draw draw(seed);
  std::string refusal;
  std::map<std::string, double> decided;
  for (int attempt = 1; attempt <= most_draws; ++attempt) {
    // Switches and choices stay for a while: else those that ask for more room, such as sockets, would grow rare.
    if (attempt % draws_per_decision == 1) {
      decided = given;
      for (const RandomRange& range : kind.ranges)
        if (const OptionType type = type_of(kind, range.name); type != OptionType::real)
          decided.emplace(range.name, draw(range, type, 1));  // those given stay
    }
    std::map<std::string, double> values = decided;
    for (const RandomRange& range : kind.ranges) {
      const OptionType type = type_of(kind, range.name);
      const double unit = range.of.empty() ? 1 : values.at(range.of);
      if (type == OptionType::real) values.emplace(range.name, draw(range, type, unit));
    }
    if (draws) *draws = attempt;
    try {
      if (make_solid(kind.name, check_parameters(kind, values)).typical) return values;
      refusal = "the object is not what its class describes";
    } catch (const UsageError& error) {
      refusal = error.what();
    }
  }
  throw UsageError(
      fmt::format("{}: none of {} random draws goes with the parameters given; the last one: {}; give fewer "
                  "parameters or others",
                  kind.name, most_draws, refusal));
}

std::map<std::string, double> preset_parameters(const SampleKind& kind, const std::string& preset,
                                                const std::map<std::string, double>& given) {
  std::vector<std::string> names;
  for (const SamplePreset& candidate : kind.presets) {
    if (candidate.name == preset) {
      std::map<std::string, double> values = given;
      values.insert(candidate.parameters.begin(), candidate.parameters.end());
      return values;
    }
    names.push_back(candidate.name);
  }
  throw UsageError(fmt::format("{}: preset '{}' is not known: {}", kind.name, preset, name_remedy(preset, names)));
}

}  // namespace toposcope
