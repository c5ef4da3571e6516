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
  const char* name;           ///< as pipelines and models write it
  OptionType type;            ///< of the value
  const char* unit;           ///< "", "deg", "mean-edges", "diagonals", "s", ...
  const char* default_value;  ///< as a user would write it; "" = must be given
  const char* minimum;        ///< of a number, inclusive, in `unit`; "" = unbounded
  const char* maximum;        ///< likewise
  const char* meaning;        ///< one line
  const char* choices = "";   ///< of a text: what it may be, "a|b|c"; "" = any text
  /// Of a number: the row of the same table that it may not exceed, as "max" for "min"; "" = none.
  const char* not_above = "";
};

/// A checked value: the kernel has verified type, range and choice and filled in the defaults.
struct OptionValue {
  std::string name;   ///< as the table has it
  double number = 0;  ///< real, integer, boolean (0 or 1); angles stay in the unit of the table
  std::string text;   ///< as it was given
  /// Equal in every member.
  bool operator==(const OptionValue&) const = default;
};

/// Read access to checked values. Asking for a name that the table does not declare throws std::logic_error.
class Options {
 public:
  Options() = default;
  /// Of values that outlive it.
  explicit Options(std::span<const OptionValue> values) : values_(values) {}

  /// In the unit of the table.
  double real(std::string_view name) const { return find(name).number; }
  /// Of an option of that type.
  int integer(std::string_view name) const { return static_cast<int>(find(name).number); }
  /// Of an option of that type.
  bool boolean(std::string_view name) const { return find(name).number != 0; }
  /// As it was given.
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
