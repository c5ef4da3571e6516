// SPDX-License-Identifier: BSD-3-Clause
#include "model/yaml_schema.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <utility>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "base/nearest_name.h"
#include "model/yaml_json.h"

namespace toposcope {
namespace {

using nlohmann::json;

bool starts_with(const std::string& text, std::string_view start) {
  return text.compare(0, start.size(), start) == 0;
}

/// The last text in single quotes: valijson ends with the name of the property, "... constraints: 'title'."
std::string last_quoted(const std::string& text) {
  const std::size_t last = text.rfind('\'');
  const std::size_t first = last == 0 || last == text.npos ? text.npos : text.rfind('\'', last - 1);
  return first == text.npos ? text : text.substr(first + 1, last - first - 1);
}

/// valijson's context is "<root>", then "[key]" or "[index]" each.
JsonPath path_of(const std::vector<std::string>& context) {
  JsonPath path;
  for (std::size_t i = 1; i < context.size(); ++i) path.push_back(context[i].substr(1, context[i].size() - 2));
  return path;
}

const json& resolve(const json& schema, const json& part) {
  const auto reference = part.find("$ref");
  return reference == part.end() ? part : schema.at(json::json_pointer(reference->get<std::string>().substr(1)));
}

/// The part of the schema that speaks of the value at `path`.
const json& schema_at(const json& schema, const JsonPath& path) {
  static const json nothing = json::object();
  const json* part = &schema;
  for (const std::string& step : path) {
    const json* next = nullptr;
    if (const auto properties = part->find("properties"); properties != part->end() && properties->contains(step))
      next = &properties->at(step);
    else if (const auto others = part->find("additionalProperties"); others != part->end() && others->is_object())
      next = &*others;
    else if (const auto items = part->find("items"); items != part->end())
      next = items->is_array() ? &items->at(std::stoul(step)) : &*items;
    if (!next) return nothing;
    part = &resolve(schema, *next);
  }
  return *part;
}

const json* value_at(const json& root, const JsonPath& path) {
  const json* value = &root;
  for (const std::string& step : path) {
    if (value->is_array()) {
      value = &value->at(std::stoul(step));
    } else {
      const auto member = value->find(step);
      if (member == value->end()) return nullptr;
      value = &*member;
    }
  }
  return value;
}

std::string name_of(const JsonPath& path) {
  std::string name;
  for (const std::string& step : path) name += (name.empty() ? "" : ".") + step;
  return name.empty() ? "the document" : "'" + name + "'";
}

std::string shown(const json& value) {
  if (value.is_null()) return "empty";
  if (value.is_object()) return "a mapping";
  if (value.is_array()) return value.empty() ? "an empty list" : "a list";
  return value.is_string() ? "'" + value.get<std::string>() + "'" : value.dump();
}

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  if (object.is_object())
    for (const auto& entry : object.items()) keys.push_back(entry.key());
  return keys;
}

std::vector<std::string> words_of(const json& list) {
  std::vector<std::string> words;
  for (const json& word : list) words.push_back(word.get<std::string>());
  return words;
}

/// An object or a list that fails because something within it does, which has been reported itself.
bool only_passes_on(const std::string& description) {
  return starts_with(description, "Failed to validate");
}

/// valijson says which rule broke and where; the words are ours: they name the value and ask for what the schema
/// describes.
void report(const valijson::ValidationResults::Error& error, const json& schema, const LocatedJson& document,
            ErrorList& errors) {
  const JsonPath path = path_of(error.context);
  const json& part = schema_at(schema, path);
  const json* value = value_at(document.value, path);
  const auto place = document.values.find(path);
  const SourceLocation where = place == document.values.end() ? document.values.at({}) : place->second;
  const std::string description = part.value("description", "");
  const std::string remedy = description.empty() ? "" : "; needed: " + description;
  const std::string is = name_of(path) + " is " + (value ? shown(*value) : "absent");

  if (starts_with(error.description, "Object contains a property")) {
    const std::string key = last_quoted(error.description);
    JsonPath key_path = path;
    key_path.push_back(key);
    const auto key_place = document.keys.find(key_path);
    errors.add(key_place == document.keys.end() ? where : key_place->second,
               "unknown key '" + key + "' in " + name_of(path) + "; " +
                   name_remedy(key, keys_of(part.value("properties", json::object()))));
  } else if (starts_with(error.description, "Missing required property")) {
    const std::string key = last_quoted(error.description);
    JsonPath key_path = path;
    key_path.push_back(key);
    errors.add(where, name_of(path) + " lacks '" + key +
                          "'; add it: " + schema_at(schema, key_path).value("description", "a value"));
  } else if (part.contains("enum") && value && value->is_string()) {
    errors.add(where, is + "; " + name_remedy(value->get<std::string>(), words_of(part["enum"])));
  } else if (part.contains("minItems") && value && value->is_array()) {
    errors.add(where, name_of(path) + " has " + std::to_string(value->size()) + " entries" + remedy);
  } else {
    errors.add(where, is + remedy);
  }
}

/// The alternative that an entry means, by its keys: what is wrong is then told of that one.
const json& meant(const json& schema, const json& alternatives, const json& entry) {
  const auto known = [&](const json& alternative) {
    const json& keys = resolve(schema, alternative).value("properties", json::object());
    return std::ranges::count_if(keys_of(entry), [&](const std::string& key) { return keys.contains(key); });
  };
  return *std::ranges::max_element(alternatives, {}, known);
}

/// Of a list whose entries are one of several: each entry gets the schema that it means.
json with_meant_entries(json schema, const json& document) {
  if (!document.is_object()) return schema;
  for (const auto& [name, part] : schema["properties"].items()) {
    const json* list = value_at(document, {name});
    if (!list || !list->is_array() || !part.contains("items") || !part["items"].contains("anyOf")) continue;
    json entries = json::array();
    for (const json& entry : *list) entries.push_back(meant(schema, part["items"]["anyOf"], entry));
    if (!entries.empty()) part["items"] = std::move(entries);
  }
  return schema;
}

/// The names that a schema's `propertyNames` refuses: valijson passes over them.
void check_key_names(const json& schema, const JsonPath& path, const LocatedJson& document, ErrorList& errors) {
  const json& part = schema_at(schema, path);
  const json* object = value_at(document.value, path);
  if (!part.contains("propertyNames") || !object || !object->is_object()) return;
  const json& rule = resolve(schema, part["propertyNames"]);
  const std::regex pattern(rule.at("pattern").get<std::string>(), std::regex::ECMAScript);
  for (const auto& entry : object->items()) {
    if (std::regex_search(entry.key(), pattern)) continue;
    JsonPath key = path;
    key.push_back(entry.key());
    errors.add(document.keys.at(key), "'" + entry.key() + "' is not " + rule.value("description", "a name"));
  }
}

/// Writes out merge keys (https://yaml.org/type/merge.html): `<<: *other` gives a mapping the keys of another one that
/// it has not itself.
class Merger {
 public:
  explicit Merger(const std::string& file) : file_(file) {}

  void expand(YAML::Node node, std::size_t depth = 0) {
    if (++visited_ > most_nodes || depth > most_depth) return;  // aliases without end are refused when they are read
    if (node.IsSequence())
      for (std::size_t i = 0; i < node.size(); ++i) expand(node[i], depth + 1);
    if (!node.IsMap()) return;
    for (const auto& entry : node) expand(entry.second, depth + 1);
    const YAML::Node merged = node[merge_key];
    if (!merged) return;
    std::vector<YAML::Node> others;
    if (merged.IsSequence())
      for (std::size_t i = 0; i < merged.size(); ++i) others.push_back(merged[i]);
    else
      others.push_back(merged);
    node.remove(merge_key);
    for (const YAML::Node& other : others) {
      if (!other.IsMap())
        throw UsageError(location_of(other, file_).str() +
                         ": '<<' takes a mapping or a list of mappings, as in '<<: *rim'; mark one with '&rim'");
      for (const auto& entry : other)
        if (entry.first.IsScalar() && !std::as_const(node)[entry.first.Scalar()]) node[entry.first] = entry.second;
    }
  }

 private:
  static constexpr const char* merge_key = "<<";
  static constexpr std::size_t most_nodes = 100000, most_depth = 32;
  const std::string& file_;
  std::size_t visited_ = 0;
};

/// Sees documents go by.
struct Unmoved final : YAML::EventHandler {
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

/// How many documents a text holds, counted to two: of a comma where a document begins yaml-cpp makes documents without
/// end, and LoadAll fills the memory with them.
int documents_of(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Unmoved handler;
  int count = 0;
  while (count < 2 && parser.HandleNextDocument(handler)) ++count;
  return count;
}

}  // namespace

SourceLocation location_of(const YAML::Node& node, const std::string& file) {
  const YAML::Mark mark = node.Mark();
  const bool quoted = node.IsScalar() && node.Tag() == "!";
  return {file, mark.line + 1, mark.column + 1 + (quoted ? 1 : 0)};
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) {
  try {
    const int documents = documents_of(text);
    if (documents != 1)
      throw UsageError(file + ":1:1: the file holds " +
                       (documents == 0 ? "no YAML document" : "several YAML documents") + "; write exactly one");
    const YAML::Node root = YAML::Load(text);
    Merger(file).expand(root);
    return root;
  } catch (const YAML::Exception& error) {
    throw UsageError(SourceLocation{file, error.mark.line + 1, error.mark.column + 1}.str() +
                     ": not YAML: " + error.msg + "; check indentation, brackets and quotes");
  }
}

void check_schema(const YAML::Node& root, std::string_view schema, const std::string& file, ErrorList& errors) {
  const LocatedJson document = yaml_to_json(root, file, errors);
  if (!errors.empty()) return;

  const json schema_json = with_meant_entries(json::parse(schema), document.value);
  valijson::Schema rules;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), rules);
  valijson::ValidationResults results;
  valijson::Validator(valijson::Validator::kStrongTypes)
      .validate(rules, valijson::adapters::NlohmannJsonAdapter(document.value), &results);
  for (const auto& error : results)
    if (!only_passes_on(error.description)) report(error, schema_json, document, errors);
  for (const auto& [path, where] : document.values) check_key_names(schema_json, path, document, errors);
}

}  // namespace toposcope
