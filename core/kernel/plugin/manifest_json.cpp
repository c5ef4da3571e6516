// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/errors.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "plugin/library.h"
#include "plugin/manifest.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view schema_id = "toposcope.plugin/1";
constexpr std::array<std::string_view, 4> type_names = {"real", "integer", "boolean", "text"};

Json to_json(const std::vector<OptionRow>& table) {
  Json rows = Json::array();
  for (const OptionRow& row : table) {
    Json entry = {{"name", row.name},
                  {"type", type_names[static_cast<std::size_t>(row.type)]},
                  {"unit", row.unit},
                  {"default", row.default_value}};
    if (row.type == OptionType::text) {
      entry["choices"] = row.choices;
    } else {
      entry["minimum"] = row.minimum;
      entry["maximum"] = row.maximum;
      if (!row.not_above.empty()) entry["not_above"] = row.not_above;
    }
    entry["meaning"] = row.meaning;
    rows.push_back(std::move(entry));
  }
  return rows;
}

/// Reads the fields of one JSON object; every message starts with the field's path.
class Fields {
 public:
  Fields(const Json& object, std::string path) : object_(object), path_(std::move(path)) {
    if (!object.is_object()) throw UsageError((path_.empty() ? "document" : path_) + ": must be an object");
  }

  bool has(const char* name) const { return object_.contains(name); }
  const Json& field(const char* name) const {
    const auto found = object_.find(name);
    if (found == object_.end()) throw UsageError(at(name) + ": is missing");
    return *found;
  }
  std::string text(const char* name) const {
    const Json& value = field(name);
    if (!value.is_string()) throw UsageError(at(name) + ": must be a string, is " + value.dump());
    return value.get<std::string>();
  }
  template <class Number>
  Number integer(const char* name) const {
    const Json& value = field(name);
    // Compared as 64-bit numbers: a conversion would wrap silently.
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<Number>::max())
                          : value.is_number_integer() &&
                                value.get<std::int64_t>() >= std::int64_t{std::numeric_limits<Number>::min()};
    if (!fits) throw UsageError(at(name) + ": must be a whole number in range, is " + value.dump());
    return value.get<Number>();
  }
  Fields object(const char* name) const { return {field(name), at(name)}; }
  std::vector<Fields> array(const char* name) const {
    const Json& value = field(name);
    if (!value.is_array()) throw UsageError(at(name) + ": must be an array");
    std::vector<Fields> entries;
    for (std::size_t i = 0; i < value.size(); ++i)
      entries.emplace_back(value[i], at(name) + "[" + std::to_string(i) + "]");
    return entries;
  }
  std::vector<std::string> texts(const char* name) const {
    const Json& value = field(name);
    if (!value.is_array() ||
        std::any_of(value.begin(), value.end(), [](const Json& each) { return !each.is_string(); }))
      throw UsageError(at(name) + ": must be an array of strings");
    return value.get<std::vector<std::string>>();
  }
  void allow_only(std::initializer_list<std::string_view> names) const {
    for (const auto& entry : object_.items())
      if (std::find(names.begin(), names.end(), entry.key()) == names.end())
        throw UsageError(at(entry.key()) + ": is not a field of a plugin manifest");
  }
  std::string at(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }

 private:
  const Json& object_;
  std::string path_;
};

OptionRow option_row(const Fields& fields) {
  fields.allow_only({"name", "type", "unit", "default", "minimum", "maximum", "not_above", "choices", "meaning"});
  OptionRow row;
  row.name = fields.text("name");
  const std::string type = fields.text("type");
  const auto known = std::find(type_names.begin(), type_names.end(), type);
  if (known == type_names.end())
    throw UsageError(fields.at("type") + ": '" + type + "' is none of real, integer, boolean, text");
  row.type = static_cast<OptionType>(known - type_names.begin());
  row.unit = fields.text("unit");
  row.default_value = fields.text("default");
  if (row.type == OptionType::text) {
    row.choices = fields.text("choices");
  } else {
    row.minimum = fields.text("minimum");
    row.maximum = fields.text("maximum");
    if (fields.has("not_above")) row.not_above = fields.text("not_above");
  }
  row.meaning = fields.text("meaning");
  return row;
}

std::vector<OptionRow> option_rows(const std::vector<Fields>& entries) {
  std::vector<OptionRow> rows;
  for (const Fields& entry : entries) rows.push_back(option_row(entry));
  return rows;
}

/// Of another ABI the other fields are others, and what is wrong with them is no matter.
void refuse_other_abi(const Fields& root) {
  const auto major = root.object("abi").integer<std::uint32_t>("major");
  const auto minor = root.object("abi").integer<std::uint32_t>("minor");
  if (major != abi_major)
    throw UsageError(fmt::format("it was built for plugin ABI {}.{}, this program has ABI {}.{}", major, minor,
                                 abi_major, abi_minor));
}

PluginManifest parse(const Json& json) {
  const Fields root(json, "");
  refuse_other_abi(root);
  root.allow_only({"schema", "id", "kind", "version", "abi", "fingerprint", "summary", "citation", "unit", "arity",
                   "dimension", "options", "arguments", "provides", "programs"});
  if (root.text("schema") != schema_id)
    throw UsageError("schema: must be '" + std::string(schema_id) + "', is '" + root.text("schema") + "'");
  PluginManifest manifest;
  manifest.id = root.text("id");
  const auto kind = plugin_kind(root.text("kind"));
  if (!kind)
    throw UsageError("kind: '" + root.text("kind") + "' is none of worksets, shapes, relations, labelers, filters");
  manifest.kind = *kind;
  manifest.version = root.text("version");
  manifest.abi_major = root.object("abi").integer<std::uint32_t>("major");
  manifest.abi_minor = root.object("abi").integer<std::uint32_t>("minor");
  manifest.fingerprint = root.text("fingerprint");
  manifest.summary = root.text("summary");
  manifest.citation = root.text("citation");
  manifest.unit = root.text("unit");
  manifest.min_arity = root.object("arity").integer<std::uint32_t>("minimum");
  manifest.max_arity = root.object("arity").integer<std::uint32_t>("maximum");
  manifest.ordered = root.object("arity").integer<std::uint32_t>("ordered") != 0;
  manifest.dimension = root.integer<int>("dimension");
  manifest.options = option_rows(root.array("options"));
  manifest.arguments = option_rows(root.array("arguments"));
  for (const Fields& entry : root.array("provides"))
    manifest.provides.push_back({entry.text("name"), entry.integer<int>("dimension"), entry.text("meaning")});
  manifest.programs = root.texts("programs");
  return manifest;
}

Json manifest_document(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, "plugin manifest");
  try {
    return parse_json<Json>(text, file.string());
  } catch (const UsageError& error) {
    throw UsageError(std::string(error.what()) + "; build the plugin again");
  }
}

}  // namespace

std::string manifest_to_json(const PluginManifest& manifest) {
  Json provides = Json::array();
  for (const ProvidedRow& row : manifest.provides)
    provides.push_back({{"name", row.name}, {"dimension", row.dimension}, {"meaning", row.meaning}});
  const Json json = {
      {"schema", schema_id},
      {"id", manifest.id},
      {"kind", to_string(manifest.kind)},
      {"version", manifest.version},
      {"abi", {{"major", manifest.abi_major}, {"minor", manifest.abi_minor}}},
      {"fingerprint", manifest.fingerprint},
      {"summary", manifest.summary},
      {"citation", manifest.citation},
      {"unit", manifest.unit},
      {"arity",
       {{"minimum", manifest.min_arity}, {"maximum", manifest.max_arity}, {"ordered", manifest.ordered ? 1 : 0}}},
      {"dimension", manifest.dimension},
      {"options", to_json(manifest.options)},
      {"arguments", to_json(manifest.arguments)},
      {"provides", provides},
      {"programs", manifest.programs}};
  return json.dump(2) + "\n";
}

PluginManifest read_manifest(const std::filesystem::path& file) {
  const Json json = manifest_document(file);
  try {
    PluginManifest manifest = parse(json);
    check_manifest(manifest);
    if (file.filename() != manifest.id + std::string(manifest_suffix))
      throw UsageError("id: '" + manifest.id + "' does not agree with the file's name; a manifest is named <id>" +
                       std::string(manifest_suffix));
    manifest.file = file;
    manifest.library = file.parent_path() / (manifest.id + library_suffix());
    return manifest;
  } catch (const UsageError& error) {
    throw UsageError(file.string() + ": " + error.what() + "; build the plugin again");
  }
}

}  // namespace toposcope
