// SPDX-License-Identifier: BSD-3-Clause
#include "model/yaml_json.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "model/yaml_schema.h"

namespace toposcope {
namespace {

template <class Number>
bool read_whole(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end;
}

nlohmann::json scalar_to_json(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted
  if (text.empty() || text == "~" || text == "null") return nullptr;
  if (text == "true") return true;
  if (text == "false") return false;
  std::int64_t whole = 0;
  if (read_whole(text, whole)) return whole;
  double real = 0;
  const bool is_word = text.find_first_of("0123456789") == std::string::npos;  // from_chars reads inf and nan
  if (!is_word && read_whole(text, real) && std::isfinite(real)) return real;
  return text;
}

class Converter {
 public:
  Converter(const std::string& file, ErrorList& errors, LocatedJson& result)
      : file_(file), errors_(errors), result_(result) {}

  nlohmann::json convert(const YAML::Node& node) {
    result_.values[path_] = location_of(node, file_);
    // Aliases may nest for ever or multiply without bound.
    if (blown_up_) return nullptr;
    if (++nodes_ > max_nodes || path_.size() > max_depth) {
      blown_up_ = true;
      errors_.add(location_of(node, file_), "the document has more than " + std::to_string(max_nodes) +
                                                " values or nests deeper than " + std::to_string(max_depth) +
                                                " levels; write out its aliases");
      return nullptr;
    }
    if (node.IsMap()) return convert_map(node);
    if (node.IsSequence()) return convert_sequence(node);
    if (!node.IsScalar()) return nullptr;
    if (node.Scalar().size() > max_length) {
      errors_.add(location_of(node, file_), "a value of " + std::to_string(node.Scalar().size()) +
                                                " characters; at most " + std::to_string(max_length) +
                                                " make sense here");
      return nullptr;
    }
    return scalar_to_json(node);
  }

 private:
  static constexpr std::size_t max_length = 2000;  // the schema's patterns are matched by recursion
  static constexpr std::size_t max_nodes = 100000;
  static constexpr std::size_t max_depth = 32;

  nlohmann::json convert_map(const YAML::Node& node) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) {
        errors_.add(location_of(entry.first, file_), "a key must be a single word; write 'key: value'");
        continue;
      }
      const std::string& key = entry.first.Scalar();
      if (key.size() > max_length) {
        errors_.add(location_of(entry.first, file_),
                    "a key of " + std::to_string(key.size()) + " characters; shorten it");
        continue;
      }
      const SourceLocation where = location_of(entry.first, file_);
      path_.push_back(key);
      if (const auto [first, is_new] = result_.keys.emplace(path_, where); !is_new) {
        errors_.add(where, "'" + key + "' is given twice, first on line " + std::to_string(first->second.line) +
                               "; rename or remove one");
      } else {
        object[key] = convert(entry.second);
        if (entry.second.IsNull()) result_.values[path_] = where;  // an absent value has no place of its own
      }
      path_.pop_back();
    }
    return object;
  }

  nlohmann::json convert_sequence(const YAML::Node& node) {
    nlohmann::json array = nlohmann::json::array();
    for (std::size_t i = 0; i < node.size(); ++i) {
      path_.push_back(std::to_string(i));
      array.push_back(convert(node[i]));
      path_.pop_back();
    }
    return array;
  }

  const std::string& file_;
  ErrorList& errors_;
  LocatedJson& result_;
  JsonPath path_;
  std::size_t nodes_ = 0;
  bool blown_up_ = false;
};

}  // namespace

LocatedJson yaml_to_json(const YAML::Node& root, const std::string& file, ErrorList& errors) {
  LocatedJson result;
  result.value = Converter(file, errors, result).convert(root);
  return result;
}

}  // namespace toposcope
