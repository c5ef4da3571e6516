// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "sample/solid.h"

namespace toposcope {

/// Random parameters of a kind from its ranges, drawn again until they do not contradict each other and the object is
/// one that the kind's class describes. `given` are kept; the same seed gives the same parameters.
/// \param draws  if not null, how many it took
/// \throw UsageError  none of 1000 draws will do, which only `given` can cause; says what the last one lacks
std::map<std::string, double> draw_parameters(const SampleKind& kind, const std::map<std::string, double>& given,
                                              std::uint64_t seed, int* draws = nullptr);

/// The parameters of a named preset with those given on top. \throw UsageError  no such preset
std::map<std::string, double> preset_parameters(const SampleKind& kind, const std::string& preset,
                                                const std::map<std::string, double>& given);

}  // namespace toposcope
