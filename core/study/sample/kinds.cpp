// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <stdexcept>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "sample/draw.h"
#include "sample/solid.h"

namespace toposcope {

namespace {

struct Maker {
  SampleKind (*kind)();
  Solid (*make)(const ParameterValues&);
};
constexpr Maker makers[] = {{cup_kind, make_cup},           {tee_kind, make_tee},     {wye_kind, make_wye},
                            {cross_kind, make_cross},       {elbow_kind, make_elbow}, {tricorner_kind, make_tricorner},
                            {airplane_kind, make_airplane}, {plate_kind, make_plate}, {flange_kind, make_flange}};

const SampleKind& find_kind(const std::vector<SampleKind>& kinds, const std::string& name) {
  std::vector<std::string> names;
  for (const SampleKind& kind : kinds) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw UsageError(fmt::format("sample kind '{}' is not known: {}", name, name_remedy(name, names)));
}

void check_request(const SampleRequest& request) {
  if (request.faces < 500 || request.faces > 2000000)
    throw UsageError(fmt::format("{}: faces is {}: it must lie between 500 and 2000000; the default is 20000",
                                 request.kind, request.faces));
  if (!(request.noise_rel >= 0 && request.noise_rel <= 0.1))
    throw UsageError(fmt::format("{}: noise is {} box diagonals: it must lie between 0 and 0.1, such as 0.001",
                                 request.kind, request.noise_rel));
  if (request.random && !request.preset.empty())
    throw UsageError(fmt::format("{}: preset '{}' and random parameters exclude each other: leave one out",
                                 request.kind, request.preset));
}

/// Whether parameters make a solid; it may yet be too fine to be meshed.
bool can_be_made(const SampleRequest& request) {
  try {
    make_solid(request.kind, requested_parameters(request));
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

}  // namespace

std::vector<SampleKind> sample_kinds() {
  std::vector<SampleKind> kinds;
  for (const Maker& maker : makers) kinds.push_back(maker.kind());
  return kinds;
}

Solid make_solid(const std::string& kind, const ParameterValues& parameters) {
  try {
    for (const Maker& maker : makers)
      if (maker.kind().name == kind) return maker.make(parameters);
  } catch (const std::domain_error& error) {
    throw ParameterError(kind, "", std::string(error.what()) + "; give lengths that leave room for each other");
  }
  throw std::logic_error("sample kind '" + kind + "' is listed but cannot be made");
}

UsageError blaming_what_was_given(const SampleRequest& request, const ParameterError& error) {
  if (request.parameters.empty() || request.parameters.contains(error.parameter)) return error;
  const bool has_solid = can_be_made(request);
  std::string all, alone;
  for (const auto& [name, value] : request.parameters) {
    const std::string words = fmt::format("{} = {}", name, value);
    all += (all.empty() ? "" : ", ") + words;
    SampleRequest without = request;
    without.parameters.erase(name);
    if (alone.empty() && !has_solid && can_be_made(without)) alone = words;
  }
  return UsageError(fmt::format("{}: with {}: {}", request.kind, alone.empty() ? all : alone, error.constraint));
}

ParameterValues requested_parameters(const SampleRequest& request) {
  const SampleKind kind = find_kind(sample_kinds(), request.kind);
  check_request(request);
  std::map<std::string, double> given = request.parameters;
  if (!request.preset.empty()) given = preset_parameters(kind, request.preset, given);
  if (request.random) given = draw_parameters(kind, given, request.seed);
  return check_parameters(kind, given);
}

}  // namespace toposcope
