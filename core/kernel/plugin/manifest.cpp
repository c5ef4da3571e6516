// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/manifest.h"

#include <algorithm>
#include <span>

#include "base/errors.h"
#include "plugin/option_check.h"
#include "plugin/plugin_id.h"
#include "toposcope/plugin.h"
#include "toposcope/system/programs.h"

namespace toposcope {
namespace {

bool is_lower_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

/// x.y.z
bool is_version(std::string_view version) {
  int numbers = 0;
  for (std::size_t first = 0; first <= version.size(); ++numbers) {
    const std::size_t last = std::min(version.find('.', first), version.size());
    const auto part = version.substr(first, last - first);
    if (part.empty() || !std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; }))
      return false;
    first = last + 1;
  }
  return numbers == 3;
}

std::string text(const char* value, const std::string& id, const char* field) {
  if (value == nullptr) throw PluginError(id, std::string("its descriptor has a null '") + field + "'; give a text");
  return value;
}

std::vector<OptionRow> rows(const OptionSpec* table, std::size_t count, const std::string& id, const char* field) {
  if (table == nullptr && count != 0)
    throw PluginError(id,
                      std::string("its descriptor counts ") + std::to_string(count) + " " + field + " in a null table");
  std::vector<OptionRow> copied;
  for (const OptionSpec& spec : std::span(table, count)) {
    if (spec.type > OptionType::text)
      throw PluginError(id, std::string("a row of '") + field + "' has the unknown type " +
                                std::to_string(static_cast<std::uint32_t>(spec.type)));
    copied.push_back({text(spec.name, id, field), spec.type, text(spec.unit, id, field),
                      text(spec.default_value, id, field), text(spec.minimum, id, field), text(spec.maximum, id, field),
                      text(spec.meaning, id, field), text(spec.choices, id, field), text(spec.not_above, id, field)});
  }
  return copied;
}

std::vector<ProvidedRow> provided(const PluginDescriptor& descriptor, const std::string& id) {
  if (descriptor.provides == nullptr && descriptor.provided_count != 0)
    throw PluginError(id, "its descriptor counts provided names in a null table");
  std::vector<ProvidedRow> copied;
  for (const ProvidedName& name : std::span(descriptor.provides, descriptor.provided_count))
    copied.push_back({text(name.name, id, "provides"), name.dimension, text(name.meaning, id, "provides")});
  return copied;
}

std::string list(const std::vector<OptionRow>& table) {
  constexpr std::array types = {"real", "integer", "boolean", "text"};
  std::string all;
  for (const OptionRow& row : table)
    all += row.name + " (" + types[static_cast<std::size_t>(row.type)] + ", unit '" + row.unit + "', default '" +
           row.default_value + "', '" + row.minimum + "' to '" + row.maximum + "', choices '" + row.choices +
           "', not above '" + row.not_above + "', " + row.meaning + "); ";
  return all;
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> all;
  for (std::size_t first = text.find_first_not_of(' '); first != text.npos;
       first = text.find_first_not_of(' ', first)) {
    const std::size_t last = std::min(text.find(' ', first), text.size());
    all.push_back(text.substr(first, last - first));
    first = last;
  }
  return all;
}

std::string list(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : " ") + name;
  return all;
}

std::string list(const std::vector<ProvidedRow>& table) {
  std::string all;
  for (const ProvidedRow& row : table)
    all += row.name + " (dimension " + std::to_string(row.dimension) + ", " + row.meaning + "); ";
  return all;
}

}  // namespace

std::string_view to_string(PluginKind kind) {
  constexpr std::array<std::string_view, plugin_kinds.size()> names = {"worksets", "shapes", "relations", "labelers",
                                                                       "filters"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view singular(PluginKind kind) {
  constexpr std::array<std::string_view, plugin_kinds.size()> names = {"working-set classifier", "shape", "relation",
                                                                       "labeler", "filter"};
  return names[static_cast<std::size_t>(kind)];
}

std::optional<PluginKind> plugin_kind(std::string_view name) {
  for (const PluginKind kind : plugin_kinds)
    if (to_string(kind) == name) return kind;
  return std::nullopt;
}

bool is_plugin_id(std::string_view id) {
  if (id.empty() || id.front() == '-' || id.back() == '-' || id.find("--") != id.npos) return false;
  return std::all_of(id.begin(), id.end(), [](char c) { return is_lower_or_digit(c) || c == '-'; });
}

const ProvidedRow* PluginManifest::find_provided(std::string_view name) const {
  const auto matches = [name](std::string_view pattern) {
    const std::size_t mark = pattern.find('#');
    if (mark == pattern.npos) return pattern == name;
    const std::string_view head = pattern.substr(0, mark), tail = pattern.substr(mark + 1);
    if (name.size() <= head.size() + tail.size() || !name.starts_with(head) || !name.ends_with(tail)) return false;
    const std::string_view number = name.substr(head.size(), name.size() - head.size() - tail.size());
    return number.front() != '0' &&
           std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  const auto row =
      std::find_if(provides.begin(), provides.end(), [&](const ProvidedRow& r) { return matches(r.name); });
  return row == provides.end() ? nullptr : &*row;
}

PluginManifest manifest_from_descriptor(const PluginDescriptor& descriptor) {
  const std::string id = text(descriptor.id, "?", "id");
  const std::string kind = text(descriptor.kind, id, "kind");
  const auto known = plugin_kind(kind);
  if (!known)
    throw PluginError(
        id, "its descriptor has kind '" + kind + "'; the kinds are worksets, shapes, relations, labelers, filters");
  if (descriptor.create == nullptr || descriptor.destroy == nullptr)
    throw PluginError(id, "its descriptor has no create or no destroy function; make it with TOPOSCOPE_PLUGIN");
  PluginManifest manifest;
  manifest.kind = *known;
  manifest.id = id;
  manifest.version = text(descriptor.version, id, "version");
  manifest.summary = text(descriptor.summary, id, "summary");
  manifest.citation = text(descriptor.citation, id, "citation");
  manifest.unit = text(descriptor.unit, id, "unit");
  manifest.fingerprint = text(descriptor.fingerprint, id, "fingerprint");
  manifest.abi_major = descriptor.major;
  manifest.abi_minor = descriptor.minor;
  manifest.min_arity = descriptor.min_arity;
  manifest.max_arity = descriptor.max_arity;
  manifest.ordered = descriptor.ordered != 0;
  manifest.dimension = descriptor.dimension;
  manifest.options = rows(descriptor.options, descriptor.option_count, id, "options");
  manifest.arguments = rows(descriptor.arguments, descriptor.argument_count, id, "arguments");
  manifest.provides = provided(descriptor, id);
  manifest.programs = words(text(descriptor.programs, id, "programs"));
  try {
    check_manifest(manifest);
  } catch (const UsageError& error) {
    throw PluginError(id, std::string("its descriptor is wrong: ") + error.what());
  }
  return manifest;
}

void check_manifest(const PluginManifest& manifest) {
  if (!is_plugin_id(manifest.id))
    throw UsageError("id '" + manifest.id + "': an id is lower-case words joined by '-', such as line-group");
  if (!is_version(manifest.version))
    throw UsageError("version '" + manifest.version + "': a version is three numbers, such as 1.0.0");
  if (manifest.summary.empty()) throw UsageError("summary: is empty; say in one line what the plugin does");
  if (manifest.max_arity != 0 && manifest.max_arity < manifest.min_arity)
    throw UsageError("arity: maximum " + std::to_string(manifest.max_arity) + " is below minimum " +
                     std::to_string(manifest.min_arity) + "; 0 means no upper bound");
  if (manifest.kind == PluginKind::shapes && manifest.min_arity < 1)
    throw UsageError("arity: a shape needs a minimum of 1 working set or more");
  const bool has_dimension = manifest.dimension >= 0 && manifest.dimension <= 3;
  if (manifest.kind == PluginKind::shapes && !has_dimension)
    throw UsageError("dimension " + std::to_string(manifest.dimension) +
                     ": a shape says its own: 0 for a point, 1 for a line, 2 for a surface, 3 for a volume");
  if (manifest.kind != PluginKind::shapes && manifest.dimension != -1)
    throw UsageError("dimension " + std::to_string(manifest.dimension) + ": only shapes have one; leave it out");
  if (manifest.kind == PluginKind::relations && manifest.min_arity < 1)
    throw UsageError("arity: a relation needs a minimum of 1 feature or more");
  if (manifest.kind == PluginKind::relations && manifest.unit != "deg" && manifest.unit != "length")
    throw UsageError("unit '" + manifest.unit + "': the unit of a relation's residual is \"deg\" or \"length\"");
  if (manifest.kind == PluginKind::worksets && manifest.provides.empty())
    throw UsageError("provides: a working-set classifier names the types that it makes");
  for (const ProvidedRow& row : manifest.provides)
    if (row.name.empty() || std::count(row.name.begin(), row.name.end(), '#') > 1)
      throw UsageError("provides: '" + row.name + "' is not a name with at most one '#'");
  for (const std::string& program : manifest.programs)
    if (program.empty() || program.find_first_of("/ '\"") != program.npos)
      throw UsageError("programs: '" + program + "' is not the name of a program; give it without a folder");
  check_table(manifest.options, "options");
  for (const OptionRow& row : manifest.options)
    if (row.name == "plugin")
      throw UsageError("options: 'plugin' is the key under which a pipeline names the plugin; rename the option");
  check_table(manifest.arguments, "arguments");
}

std::vector<std::string> differences(const PluginManifest& manifest, const PluginManifest& library) {
  std::vector<std::string> fields;
  const auto compare = [&](const char* field, const std::string& in_manifest, const std::string& in_library) {
    if (in_manifest != in_library)
      fields.push_back(std::string(field) + ": '" + in_manifest + "' in the manifest, '" + in_library +
                       "' in the library");
  };
  const auto numbers = [](std::uint32_t first, std::uint32_t second) {
    return std::to_string(first) + "." + std::to_string(second);
  };
  compare("id", manifest.id, library.id);
  compare("kind", std::string(to_string(manifest.kind)), std::string(to_string(library.kind)));
  compare("version", manifest.version, library.version);
  compare("abi", numbers(manifest.abi_major, manifest.abi_minor), numbers(library.abi_major, library.abi_minor));
  compare("fingerprint", manifest.fingerprint, library.fingerprint);
  compare("summary", manifest.summary, library.summary);
  compare("citation", manifest.citation, library.citation);
  compare("unit", manifest.unit, library.unit);
  compare("minimum arity", std::to_string(manifest.min_arity), std::to_string(library.min_arity));
  compare("maximum arity", std::to_string(manifest.max_arity), std::to_string(library.max_arity));
  compare("ordered", std::to_string(manifest.ordered), std::to_string(library.ordered));
  compare("dimension", std::to_string(manifest.dimension), std::to_string(library.dimension));
  compare("options", list(manifest.options), list(library.options));
  compare("arguments", list(manifest.arguments), list(library.arguments));
  compare("provides", list(manifest.provides), list(library.provides));
  compare("programs", list(manifest.programs), list(library.programs));
  return fields;
}

std::string missing_programs(const PluginManifest& manifest) {
  std::vector<std::string> missing;
  for (const std::string& program : manifest.programs)
    if (!find_program(program)) missing.push_back(program);
  if (missing.empty()) return "";
  std::string names;
  for (const std::string& program : missing) names += (names.empty() ? "'" : ", '") + program + "'";
  return std::string("needs the program") + (missing.size() > 1 ? "s " : " ") + names + " (apt-get install " +
         list(missing) + ")";
}

}  // namespace toposcope
