// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/option_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "base/errors.h"
#include "base/nearest_name.h"

namespace toposcope {
namespace {

/// The whole of `text` as a finite number; locales play no role.
template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<double> parse_number(OptionType type, std::string_view text) {
  if (type == OptionType::real) return parse<double>(text);
  // Options::integer hands out an int.
  const auto integer = parse<int>(text);
  return integer ? std::optional<double>(*integer) : std::nullopt;
}

std::string join(const std::vector<std::string>& words) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : ", ") + word;
  return joined;
}

const OptionRow& find_row(std::span<const OptionRow> table, std::string_view name, const std::string& owner) {
  const auto row = std::find_if(table.begin(), table.end(), [&](const OptionRow& r) { return r.name == name; });
  if (row != table.end()) return *row;
  std::vector<std::string> names;
  for (const OptionRow& r : table) names.push_back(r.name);
  throw UsageError(owner + ": has no option '" + std::string(name) + "'; " + name_remedy(name, names));
}

bool within(const OptionRow& row, double number) {
  return (row.minimum.empty() || number >= *parse_number(row.type, row.minimum)) &&
         (row.maximum.empty() || number <= *parse_number(row.type, row.maximum));
}

[[noreturn]] void refuse(const OptionRow& row, std::string_view value, const std::string& owner) {
  std::string message = owner + ": option '" + row.name + "' cannot be '" + std::string(value) + "': it must be " +
                        describe_constraint(row);
  const std::string near = nearest_name(value, option_choices(row));
  if (!near.empty()) message += "; did you mean '" + near + "'?";
  if (!row.default_value.empty()) message += " (default: " + row.default_value + ")";
  throw UsageError(message);
}

OptionValue check_value(const OptionRow& row, std::string_view value, const std::string& owner) {
  OptionValue checked{.name = row.name, .number = 0, .text = std::string(value)};
  if (row.type == OptionType::text) {
    const auto choices = option_choices(row);
    if (!choices.empty() && std::find(choices.begin(), choices.end(), value) == choices.end())
      refuse(row, value, owner);
  } else if (row.type == OptionType::boolean) {
    if (value != "true" && value != "false") refuse(row, value, owner);
    checked.number = value == "true";
  } else {
    const auto number = parse_number(row.type, value);
    if (!number || !within(row, *number)) refuse(row, value, owner);
    checked.number = *number;
  }
  return checked;
}

bool is_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

}  // namespace

std::vector<std::string> option_choices(const OptionRow& row) {
  std::vector<std::string> choices;
  if (row.choices.empty()) return choices;
  for (std::size_t first = 0; first <= row.choices.size();) {
    const std::size_t last = std::min(row.choices.find('|', first), row.choices.size());
    choices.push_back(row.choices.substr(first, last - first));
    first = last + 1;
  }
  return choices;
}

std::string describe_constraint(const OptionRow& row) {
  if (row.type == OptionType::boolean) return "true or false";
  if (row.type == OptionType::text) {
    const auto choices = option_choices(row);
    return choices.empty() ? "text" : "one of " + join(choices);
  }
  std::string text = row.type == OptionType::real ? "a number" : "a whole number";
  if (!row.minimum.empty() && !row.maximum.empty())
    text += " from " + row.minimum + " to " + row.maximum;
  else if (!row.minimum.empty())
    text += " of at least " + row.minimum;
  else if (!row.maximum.empty())
    text += " of at most " + row.maximum;
  return row.unit.empty() ? text : text + " (" + row.unit + ")";
}

OptionValue check_option(std::span<const OptionRow> table, std::string_view name, std::string_view value,
                         const std::string& owner) {
  return check_value(find_row(table, name, owner), value, owner);
}

std::vector<OptionValue> check_options(std::span<const OptionRow> table, std::span<const GivenOption> given,
                                       const std::string& owner) {
  std::vector<std::optional<OptionValue>> values(table.size());
  for (const auto& [name, value] : given) {
    const OptionRow& row = find_row(table, name, owner);
    auto& slot = values[static_cast<std::size_t>(&row - table.data())];
    if (slot) throw UsageError(owner + ": option '" + name + "' is given twice; keep one of them");
    slot = check_value(row, value, owner);
  }
  std::vector<OptionValue> checked;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const OptionRow& row = table[i];
    if (!values[i] && row.default_value.empty())
      throw UsageError(owner + ": option '" + row.name + "' is not given and has no default; give it " +
                       describe_constraint(row) + ": " + row.meaning);
    checked.push_back(values[i] ? std::move(*values[i]) : check_value(row, row.default_value, owner));
  }
  check_order(table, checked, owner);
  return checked;
}

void check_order(std::span<const OptionRow> table, std::span<const OptionValue> values, const std::string& owner) {
  const auto named = [&](const std::string& name) {
    return std::find_if(values.begin(), values.end(), [&](const OptionValue& value) { return value.name == name; });
  };
  for (const OptionRow& row : table) {
    if (row.not_above.empty()) continue;
    const auto low = named(row.name), high = named(row.not_above);
    if (low != values.end() && high != values.end() && low->number > high->number)
      throw UsageError(owner + ": " + row.name + " = " + to_string(row, *low) + " is above " + row.not_above + " = " +
                       to_string(row, *high) + "; exchange them or change one");
  }
}

void check_table(std::span<const OptionRow> table, const std::string& owner) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    const OptionRow& row = table[i];
    const std::string where = owner + ": option table row " + std::to_string(i + 1) + " ('" + row.name + "')";
    if (!is_name(row.name)) throw UsageError(where + ": a name is lower-case letters, digits and '_'");
    for (std::size_t j = 0; j < i; ++j)
      if (table[j].name == row.name)
        throw UsageError(where + ": the name stands in row " + std::to_string(j + 1) + " too");
    if (row.meaning.empty()) throw UsageError(where + ": its meaning is empty; say in one line what it does");
    const bool numeric = row.type == OptionType::real || row.type == OptionType::integer;
    if (numeric)
      for (const std::string* bound : {&row.minimum, &row.maximum})
        if (!bound->empty() && !parse_number(row.type, *bound))
          throw UsageError(where + ": bound '" + *bound + "' is not a number of the option's type");
    if (row.type == OptionType::boolean && !(row.minimum.empty() && row.maximum.empty()))
      throw UsageError(where + ": a boolean has no bounds; leave them empty");
    if (row.type == OptionType::text && !(row.minimum.empty() && row.maximum.empty()))
      throw UsageError(where + ": a text has no bounds; what it may be stands in 'choices', separated by '|'");
    if (row.type != OptionType::text && !row.choices.empty())
      throw UsageError(where + ": choices are for a text; leave them empty");
    if (numeric && !row.minimum.empty() && !row.maximum.empty() &&
        *parse_number(row.type, row.minimum) > *parse_number(row.type, row.maximum))
      throw UsageError(where + ": minimum " + row.minimum + " is above maximum " + row.maximum);
    if (!row.not_above.empty()) {
      const auto other =
          std::find_if(table.begin(), table.end(), [&](const OptionRow& each) { return each.name == row.not_above; });
      if (!numeric || other == table.end() || other == table.begin() + static_cast<std::ptrdiff_t>(i) ||
          (other->type != OptionType::real && other->type != OptionType::integer))
        throw UsageError(where + ": 'not_above' says '" + row.not_above +
                         "'; it names another number of the same table, and stands at a number");
    }
    if (!row.default_value.empty()) check_value(row, row.default_value, where);
  }
}

std::string to_string(const OptionRow& row, const OptionValue& value) {
  if (row.type == OptionType::text) return value.text;
  if (row.type == OptionType::boolean) return value.number != 0 ? "true" : "false";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value.number).ptr;
  return {buffer.data(), end};
}

}  // namespace toposcope
