// SPDX-License-Identifier: BSD-3-Clause
#include "table/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/csv.h"

namespace toposcope {

namespace {

std::string shown(const Column& column, const Cell& cell, const char* nothing) {
  struct Show {
    const Column& column;
    const char* nothing;
    std::string operator()(std::monostate) const { return nothing; }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(std::uint64_t number) const { return std::to_string(number); }
    std::string operator()(double number) const { return fmt::format(fmt::runtime(column.format), number); }
  };
  return std::visit(Show{column, nothing}, cell.value());
}

std::vector<std::string> shown(const std::vector<Column>& columns, const std::vector<Cell>& row, const char* nothing) {
  std::vector<std::string> cells;
  for (std::size_t c = 0; c < columns.size(); ++c) cells.push_back(shown(columns[c], row.at(c), nothing));
  return cells;
}

std::vector<std::string> names(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  return names;
}

/// Characters of UTF-8.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string markdown_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    std::string escaped;
    for (const char c : cell) escaped += c == '|' ? "\\|" : std::string(1, c);
    line += " " + escaped + " |";
  }
  return line + "\n";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (&cell == cells.data() ? "" : ",") + csv_field(cell);
  return line + "\n";
}

}  // namespace

Cell::Cell(double number) {
  if (std::isfinite(number)) value_ = number;
}

Cell share(std::size_t part, std::size_t all) {
  return all == 0 ? Cell() : Cell(static_cast<double>(part) / static_cast<double>(all));
}

std::string to_text(const Table& table) {
  std::vector<std::vector<std::string>> lines = {names(table.columns)};
  for (const auto& row : table.rows) lines.push_back(shown(table.columns, row, "-"));
  std::string text = table.title + "\n";
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    widths.push_back(table.columns[c].width);
    for (const auto& line : lines) widths[c] = std::max(widths[c], characters(line[c]));
  }
  for (const auto& line : lines) {
    std::string out;
    for (std::size_t c = 0; c < line.size(); ++c) {
      const std::string space(widths[c] - characters(line[c]), ' ');
      const bool right = table.columns[c].kind != "text";
      out += "  " + (right ? space + line[c] : line[c] + space);
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    text += out + "\n";
  }
  return table.note.empty() ? text : text + "  " + table.note + "\n";
}

std::string markdown_header(const std::vector<Column>& columns) {
  std::string text = markdown_line(names(columns)) + "|";
  for (std::size_t c = 0; c < columns.size(); ++c) text += "---|";
  return text + "\n";
}

std::string markdown_row(const std::vector<Column>& columns, const std::vector<Cell>& row) {
  return markdown_line(shown(columns, row, "-"));
}

std::string to_markdown(const Table& table) {
  std::string text = table.title.empty() ? "" : "**" + table.title + "**\n\n";
  text += markdown_header(table.columns);
  for (const auto& row : table.rows) text += markdown_row(table.columns, row);
  return table.note.empty() ? text : text + "\n" + table.note + "\n";
}

std::string to_csv(const Table& table) {
  std::string text = csv_line(names(table.columns));
  for (const auto& row : table.rows) text += csv_line(shown(table.columns, row, ""));
  return text;
}

std::string to_text(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) text += "\n" + to_text(table);
  return text;
}

std::string to_markdown(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) text += "\n" + to_markdown(table);
  return text;
}

}  // namespace toposcope
