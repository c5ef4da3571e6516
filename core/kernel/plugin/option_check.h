// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plugin/manifest.h"
#include "toposcope/options.h"

namespace toposcope {

using GivenOption = std::pair<std::string, std::string>;  ///< name and value as the user wrote them

/// One option against its table: type, range, choice.
/// \param owner  for messages: "shape 'circle'", "cup.yaml:4:7: shape 'circle'"
/// \throw UsageError  names owner, option, value, constraint and remedy; the nearest name for an unknown one
OptionValue check_option(std::span<const OptionRow> table, std::string_view name, std::string_view value,
                         const std::string& owner);

/// All options of one plugin: one value per row of the table, in its order, defaults filled in.
/// \throw UsageError  as above; an option given twice; one without default not given; one above what it may not exceed
std::vector<OptionValue> check_options(std::span<const OptionRow> table, std::span<const GivenOption> given,
                                       const std::string& owner);

/// Refuses a value that exceeds the one that its row names in `not_above`.
/// \throw UsageError  names both, and the remedy
void check_order(std::span<const OptionRow> table, std::span<const OptionValue> values, const std::string& owner);

/// Is the table itself sound? Names, bounds in order, defaults within them.
/// \throw UsageError
void check_table(std::span<const OptionRow> table, const std::string& owner);

/// The constraint in words: "a number from 0 to 90 deg", "one of powell, robust".
std::string describe_constraint(const OptionRow& row);

/// The choices of a text option; empty where any text will do.
std::vector<std::string> option_choices(const OptionRow& row);

/// The value as a user would write it, the shortest that reads back the same.
std::string to_string(const OptionRow& row, const OptionValue& value);

}  // namespace toposcope
