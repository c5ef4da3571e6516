// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/plugin_page.h"

#include <set>
#include <sstream>
#include <vector>

#include "base/errors.h"
#include "plugin/option_check.h"

namespace toposcope {
namespace {

constexpr std::string_view begin_mark = "<!-- table: ", mark_end = " -->", end_mark = "<!-- end of table -->";

/// In a cell a '|' would begin the next one.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

std::string code(const std::string& text) {
  return "`" + cell(text) + "`";
}

std::string range(const OptionRow& row) {
  if (row.type == OptionType::boolean) return "";
  if (row.type == OptionType::text) {
    std::string choices;
    for (const std::string& choice : option_choices(row)) choices += (choices.empty() ? "" : ", ") + code(choice);
    return choices;
  }
  if (!row.minimum.empty() && !row.maximum.empty()) return row.minimum + " to " + row.maximum;
  if (!row.minimum.empty()) return row.minimum + " or more";
  return row.maximum.empty() ? "" : row.maximum + " or less";
}

/// A row of cells; an empty one is one space wide.
std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& each : cells) text += each.empty() ? " |" : " " + each + " |";
  return text + "\n";
}

std::string options_table(const std::string& word, const std::vector<OptionRow>& rows) {
  constexpr const char* types[] = {"real", "integer", "boolean", "text"};
  if (rows.empty()) return "None.\n";
  std::string text = line({word, "type", "unit", "default", "range", "meaning"}) + "|---|---|---|---|---|---|\n";
  for (const OptionRow& row : rows) {
    const bool quoted = row.type == OptionType::text;
    const std::string value = row.default_value.empty() ? "must be given"
                              : quoted                  ? code(row.default_value)
                                                        : cell(row.default_value);
    text += line({code(row.name), types[static_cast<std::size_t>(row.type)], cell(row.unit), value, range(row),
                  cell(row.meaning)});
  }
  return text;
}

std::string provides_table(const PluginManifest& plugin) {
  if (plugin.kind == PluginKind::worksets) {
    std::string text = line({"type", "meaning"}) + "|---|---|\n";
    for (const ProvidedRow& row : plugin.provides) text += line({code(row.name), cell(row.meaning)});
    return text;
  }
  std::string text = line({"measure", "power of length", "meaning"}) + "|---|---|---|\n";
  for (const ProvidedRow& row : plugin.provides)
    text += line({code(row.name), std::to_string(row.dimension), cell(row.meaning)});
  return text;
}

std::string table(const std::string& name, const PluginManifest& plugin, const std::string& where) {
  if (name == "options") return options_table("option", plugin.options);
  if (name == "arguments") return options_table("argument", plugin.arguments);
  if (name == "provides") return provides_table(plugin);
  throw UsageError(where + ": there is no table '" + name + "'; a page has options, arguments and provides");
}

}  // namespace

std::string with_tables(const std::string& page, const PluginManifest& plugin) {
  std::istringstream stream(page);
  std::string result, inside;
  std::set<std::string> seen;
  int number = 0, begun = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    const std::string where = "line " + std::to_string(number);
    const bool begins = text.starts_with(begin_mark) && text.ends_with(mark_end);
    if (begins) {
      if (!inside.empty())
        throw UsageError(where + ": the table of line " + std::to_string(begun) + " has not ended; it ends with '" +
                         std::string(end_mark) + "'");
      inside = text.substr(begin_mark.size(), text.size() - begin_mark.size() - mark_end.size());
      begun = number;
      seen.insert(inside);
      result += text + "\n" + table(inside, plugin, where);
    } else if (text == end_mark) {
      if (inside.empty()) throw UsageError(where + ": no table ends here");
      inside.clear();
      result += text + "\n";
    } else if (inside.empty()) {
      result += text + "\n";
    }
  }
  if (!inside.empty())
    throw UsageError("line " + std::to_string(begun) + ": the table '" + inside + "' never ends; it ends with '" +
                     std::string(end_mark) + "'");
  for (const auto& [name, rows] : {std::pair{"options", &plugin.options}, std::pair{"arguments", &plugin.arguments}})
    if (!rows->empty() && !seen.contains(name))
      throw UsageError(std::string("the page has no place for the table of its ") + name + "; put the lines '" +
                       std::string(begin_mark) + name + std::string(mark_end) + "' and '" + std::string(end_mark) +
                       "' where it shall stand");
  return result;
}

}  // namespace toposcope
