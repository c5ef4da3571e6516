// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace toposcope {

enum class OptionType : std::uint32_t { real, integer, boolean, text };

/// One row of a plugin's option (or argument) table: declared once, and the source of checking, `--help`, the
/// manifest and the documentation page.
struct OptionSpec {
  const char* name;
  OptionType type;
  const char* unit;            ///< "", "deg", "mean-edges", "diagonals", "s", ...
  const char* default_value;   ///< as a user would write it; "" = must be given
  const char* minimum;         ///< of a number, inclusive, in `unit`; "" = unbounded
  const char* maximum;         ///< likewise
  const char* meaning;         ///< one line
  const char* choices = "";    ///< of a text: what it may be, "a|b|c"; "" = any text
  const char* not_above = "";  ///< of a number: the row of the table that it may not exceed ("max"); "" = none
};

/// A checked value: the kernel has verified type, range and choice and filled in the defaults.
struct OptionValue {
  std::string name;
  double number = 0;  ///< real, integer, boolean (0 or 1); angles stay in the unit of the table
  std::string text;
  bool operator==(const OptionValue&) const = default;
};

/// Read access to checked values. Asking for a name that the table does not declare throws std::logic_error.
class Options {
 public:
  Options() = default;
  explicit Options(std::span<const OptionValue> values) : values_(values) {}

  double real(std::string_view name) const { return find(name).number; }
  int integer(std::string_view name) const { return static_cast<int>(find(name).number); }
  bool boolean(std::string_view name) const { return find(name).number != 0; }
  const std::string& text(std::string_view name) const { return find(name).text; }

 private:
  const OptionValue& find(std::string_view name) const {
    for (const OptionValue& value : values_)
      if (value.name == name) return value;
    throw std::logic_error("option '" + std::string(name) + "' is not in the plugin's option table");
  }
  std::span<const OptionValue> values_;
};

}  // namespace toposcope
