// SPDX-License-Identifier: BSD-3-Clause
#include "sample/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "plugin/option_check.h"

namespace toposcope {

namespace {

double to_number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);  // not strtod: it follows the locale
  return value;
}

}  // namespace

OptionRow length_parameter(const char* name, const char* default_value, const char* minimum, const char* meaning) {
  return {name, OptionType::real, "length", default_value, minimum, "", meaning};
}

OptionRow angle_parameter(const char* name, const char* default_value, const char* meaning) {
  return {name, OptionType::real, "degrees", default_value, "-180", "180", meaning};
}

OptionRow switch_parameter(const char* name, const char* default_value, const char* meaning) {
  return {name, OptionType::boolean, "", default_value, "", "", meaning};
}

double parameter_number(const OptionRow& row, const std::string& text) {
  if (row.type == OptionType::boolean) return text == "true" ? 1 : 0;
  const std::vector<std::string> choices = option_choices(row);
  if (choices.empty()) return to_number(text);
  return static_cast<double>(std::find(choices.begin(), choices.end(), text) - choices.begin());
}

double parameter(const ParameterValues& values, std::string_view name) {
  for (const auto& [key, value] : values)
    if (key == name) return value;
  throw std::logic_error("no parameter '" + std::string(name) + "' in the kind's table");
}

void require(bool holds, const std::string& kind, const std::string& name, double value, const std::string& constraint,
             const std::string& remedy) {
  if (!holds) throw ParameterError(kind, name, fmt::format("{} is {}: {}; {}", name, value, constraint, remedy));
}

ParameterValues check_parameters(const SampleKind& kind, const std::map<std::string, double>& given) {
  ParameterValues values;
  std::vector<std::string> names;
  for (const OptionRow& row : kind.parameters) {
    const auto it = given.find(row.name);
    const std::vector<std::string> choices = option_choices(row);
    const double value = it == given.end() ? parameter_number(row, row.default_value) : it->second;
    if (!choices.empty())
      require(value >= 0 && value < static_cast<double>(choices.size()) && value == std::floor(value), kind.name,
              row.name, value, "it must be the number of a choice, from 0", "the default is " + row.default_value);
    else if (row.type == OptionType::boolean)
      require(value == 0 || value == 1, kind.name, row.name, value, "it must be true or false",
              "the default is " + row.default_value);
    else if (row.minimum.empty())
      require(std::isfinite(value), kind.name, row.name, value, "it must be a finite number",
              "the default is " + row.default_value);
    else if (row.unit == "length")
      require(std::isfinite(value) && value > to_number(row.minimum), kind.name, row.name, value,
              "it must be a finite number greater than " + row.minimum, "the default is " + row.default_value);
    else
      require(value >= to_number(row.minimum) && value <= to_number(row.maximum), kind.name, row.name, value,
              fmt::format("it must lie between {} and {}", row.minimum, row.maximum),
              "the default is " + row.default_value);
    values.emplace_back(row.name, value);
    names.push_back(row.name);
  }
  for (const auto& [name, value] : given)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError(fmt::format("{}: parameter '{}' (given {}) is not known: {}", kind.name, name, value,
                                   name_remedy(name, names)));
  return values;
}

double sample_parameter(const SampleKind& kind, const std::string& name, const std::string& text) {
  const OptionValue value = check_option(kind.parameters, name, text, "sample '" + kind.name + "'");
  for (const OptionRow& row : kind.parameters)
    if (row.name == name && row.type == OptionType::text) return parameter_number(row, text);
  return value.number;
}

}  // namespace toposcope
