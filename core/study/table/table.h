// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace toposcope {

/// Nothing, a text, a whole number or a real one. What is no finite number is nothing.
class Cell {
 public:
  Cell() = default;
  Cell(std::string text) : value_(std::move(text)) {}
  Cell(std::string_view text) : value_(std::string(text)) {}
  Cell(const char* text) : value_(std::string(text)) {}
  Cell(std::unsigned_integral auto number) : value_(std::uint64_t{number}) {}
  Cell(double number);
  template <class T>
  Cell(const std::optional<T>& value) {
    if (value) *this = Cell(*value);
  }

  using Value = std::variant<std::monostate, std::string, std::uint64_t, double>;
  const Value& value() const { return value_; }

 private:
  Value value_;
};

/// `part` of `all`; nothing of nothing.
Cell share(std::size_t part, std::size_t all);

struct Column {
  Column(std::string column_name) : name(std::move(column_name)) {}
  Column(const char* column_name) : name(column_name) {}
  /// \param column_kind  see `kind` \param number_format  see `format`
  Column(std::string column_name, std::string column_kind, std::string column_unit = "",
         std::string number_format = "{}")
      : name(std::move(column_name)),
        kind(std::move(column_kind)),
        unit(std::move(column_unit)),
        format(std::move(number_format)) {}

  std::string name;
  std::string kind = "text";  ///< text, number, verdict, percent (a part of 1) or ms
  std::string unit;           ///< empty: none
  std::string format = "{}";  ///< of real numbers, as fmt has it
  std::size_t width = 0;      ///< least, characters, in text
};

/// Rows under a header, for people or for machines. A row has a cell for each column.
struct Table {
  std::string title = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<Cell>> rows = {};
  std::string note = {};
  std::string id = {};                  ///< in JSON
  std::vector<std::string> links = {};  ///< in JSON: where each row leads, empty: nowhere; none, or one for each row
};

/// In columns as wide as their cells; those of numbers end at the right. Nothing is "-".
std::string to_text(const Table& table);
std::string to_markdown(const Table& table);
/// Header and rows, as RFC 4180 has them but for the ends of lines; without title and note. Nothing is empty.
std::string to_csv(const Table& table);

/// One below the other, an empty line before each.
std::string to_text(const std::vector<Table>& tables);
std::string to_markdown(const std::vector<Table>& tables);

// ---- a table that grows while it is looked at ----

/// The header of a Markdown table with the line below it.
std::string markdown_header(const std::vector<Column>& columns);
std::string markdown_row(const std::vector<Column>& columns, const std::vector<Cell>& row);

}  // namespace toposcope
