// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/buffer.h"

namespace toposcope {

/// A table of the index, filled row by row.
class JsonTable {
 public:
  JsonTable(const std::string& id, const std::string& title)
      : json_{{"id", id}, {"title", title}, {"columns", SceneJson::array()}, {"rows", SceneJson::array()}} {}

  /// \param kind  text, number, verdict, percent (a part of 1) or ms
  JsonTable& column(const std::string& name, const char* kind, const char* unit = nullptr) {
    json_["columns"].push_back({{"name", name}, {"unit", unit ? SceneJson(unit) : SceneJson(nullptr)}, {"kind", kind}});
    return *this;
  }
  void row(SceneJson cells) { json_["rows"].push_back(std::move(cells)); }
  /// Where the last row leads. Given for every row or for none.
  void link(const std::string& target) {
    json_["links"].push_back(target.empty() ? SceneJson(nullptr) : SceneJson(target));
  }
  SceneJson take() { return std::move(json_); }

 private:
  SceneJson json_;
};

/// What is no finite number is null.
inline SceneJson finite(double value) {
  return std::isfinite(value) ? SceneJson(value) : SceneJson(nullptr);
}

inline SceneJson part(std::size_t of, std::size_t all) {
  return all == 0 ? SceneJson(nullptr) : SceneJson(static_cast<double>(of) / static_cast<double>(all));
}

inline SceneJson data_uri(const std::string& png) {
  return png.empty() ? SceneJson(nullptr) : SceneJson("data:image/png;base64," + to_base64(png));
}

inline SceneJson text_or_null(const std::string& text) {
  return text.empty() ? SceneJson(nullptr) : SceneJson(text);
}

}  // namespace toposcope
