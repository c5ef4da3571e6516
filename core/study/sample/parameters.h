// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The parameters of a kind of object: rows of its table, values that are checked against it.

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "sample/sample.h"

namespace toposcope {

/// Values of all parameters of a kind, in the order of its table.
using ParameterValues = std::vector<std::pair<std::string, double>>;

/// Fills in the defaults and checks names and ranges. \throw UsageError
ParameterValues check_parameters(const SampleKind& kind, const std::map<std::string, double>& given);
/// Parameters that do not go together.
struct ParameterError : UsageError {
  ParameterError(const std::string& kind, const std::string& of, const std::string& what)
      : UsageError(kind + ": " + what), parameter(of), constraint(what) {}
  std::string parameter;   ///< whose constraint fails: it need not be the one that was given
  std::string constraint;  ///< the message without the kind
};
/// \throw ParameterError  "kind: <parameter> is <value>: <constraint>; <remedy>" unless `holds`
void require(bool holds, const std::string& kind, const std::string& parameter, double value,
             const std::string& constraint, const std::string& remedy);

/// A row for a parameter that is a length, greater than `minimum` unless that is empty.
OptionRow length_parameter(const char* name, const char* default_value, const char* minimum, const char* meaning);
/// A row for a parameter that is an angle, in degrees.
OptionRow angle_parameter(const char* name, const char* default_value, const char* meaning);
/// A row for a part that may be left out: 0 or 1.
OptionRow switch_parameter(const char* name, const char* default_value, const char* meaning);
/// A parameter's text as the number that stands for it: 0 or 1, the place of a choice from 0, or itself.
double parameter_number(const OptionRow& row, const std::string& text);
double parameter(const ParameterValues& values, std::string_view name);

}  // namespace toposcope
