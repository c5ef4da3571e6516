// SPDX-License-Identifier: BSD-3-Clause
#include "table/table_json.h"

namespace toposcope {

namespace {

using Json = nlohmann::ordered_json;

Json cell_json(const Cell& cell) {
  struct Write {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(std::uint64_t number) const { return number; }
    Json operator()(double number) const { return number; }
  };
  return std::visit(Write{}, cell.value());
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

}  // namespace

Json to_json(const Table& table) {
  Json json = {{"id", table.id}, {"title", table.title}, {"columns", Json::array()}, {"rows", Json::array()}};
  for (const Column& column : table.columns)
    json["columns"].push_back({{"name", column.name}, {"unit", text_or_null(column.unit)}, {"kind", column.kind}});
  for (const std::vector<Cell>& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) cells.push_back(cell_json(cell));
    json["rows"].push_back(std::move(cells));
  }
  for (const std::string& link : table.links) json["links"].push_back(text_or_null(link));
  return json;
}

}  // namespace toposcope
