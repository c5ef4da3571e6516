// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace toposcope {
namespace {

constexpr std::array<std::pair<std::string_view, PlyScalar>, 16> scalar_names = {{
    {"char", PlyScalar::int8},
    {"int8", PlyScalar::int8},
    {"uchar", PlyScalar::uint8},
    {"uint8", PlyScalar::uint8},
    {"short", PlyScalar::int16},
    {"int16", PlyScalar::int16},
    {"ushort", PlyScalar::uint16},
    {"uint16", PlyScalar::uint16},
    {"int", PlyScalar::int32},
    {"int32", PlyScalar::int32},
    {"uint", PlyScalar::uint32},
    {"uint32", PlyScalar::uint32},
    {"float", PlyScalar::float32},
    {"float32", PlyScalar::float32},
    {"double", PlyScalar::float64},
    {"float64", PlyScalar::float64},
}};

/// Lines of the header. The first one tells whether they end with a lone CR: with binary data behind them, a guess
/// would be fatal. LF and CR LF may be mixed.
class HeaderLines {
 public:
  explicit HeaderLines(const FileText& file) : file_(file) {
    const std::size_t end = file.bytes.find_first_of("\r\n");
    if (end != file.bytes.npos && file.bytes[end] == '\r' && file.bytes.substr(end, 2) != "\r\n") ending_ = '\r';
  }

  /// The words of the next line.
  const std::vector<std::string_view>& next() {
    ++line_;
    std::size_t end = file_.bytes.find(ending_, at_);
    if (end == file_.bytes.npos) {
      if (!file_.bytes.substr(at_).starts_with("end_header"))
        fail("the header has no end_header; the file is cut short");
      end = file_.bytes.size();
    }
    std::string_view rest = file_.bytes.substr(at_, end - at_);
    at_ = std::min(end + 1, file_.bytes.size());
    words_.clear();
    while (true) {
      const std::size_t begin = rest.find_first_not_of(" \t\r");
      if (begin == rest.npos) return words_;
      const std::size_t stop = std::min(rest.find_first_of(" \t\r", begin), rest.size());
      words_.push_back(rest.substr(begin, stop - begin));
      rest.remove_prefix(stop);
    }
  }

  std::size_t line() const { return line_; }
  std::size_t bytes() const { return at_; }
  [[noreturn]] void fail(const std::string& message) const {
    fail_at(file_.name, {line_, MeshFilePlace::Unit::line}, message);
  }

 private:
  const FileText& file_;
  char ending_ = '\n';
  std::vector<std::string_view> words_;
  std::size_t at_ = 0, line_ = 0;
};

PlyScalar scalar(const HeaderLines& lines, std::string_view name) {
  for (const auto& [known, type] : scalar_names)
    if (known == name) return type;
  lines.fail("unknown property type " + quoted(name) + "; PLY knows char to uint32, float and double");
}

PlyFormat format(const HeaderLines& lines, std::string_view name) {
  if (name == "ascii") return PlyFormat::ascii;
  if (name == "binary_little_endian") return PlyFormat::binary_little;
  if (name == "binary_big_endian") return PlyFormat::binary_big;
  lines.fail("unknown format " + quoted(name) + "; expected ascii, binary_little_endian or binary_big_endian");
}

PlyElement element(const HeaderLines& lines, const std::vector<std::string_view>& words) {
  if (words.size() != 3) lines.fail("expected 'element NAME COUNT'");
  PlyElement result;
  result.name = words[1];
  result.line = lines.line();
  const char* end = words[2].data() + words[2].size();
  const auto [rest, error] = std::from_chars(words[2].data(), end, result.count);
  if (error != std::errc() || rest != end) lines.fail("expected a count but found " + quoted(words[2]));
  return result;
}

PlyProperty property(const HeaderLines& lines, const std::vector<std::string_view>& words, const PlyElement& owner) {
  PlyProperty result;
  result.is_list = words.size() == 5 && words[1] == "list";
  if (!result.is_list && words.size() != 3)
    lines.fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
  result.name = words.back();
  result.type = scalar(lines, words[result.is_list ? 3 : 1]);
  if (result.is_list) result.count_type = scalar(lines, words[2]);
  if (owner.name == "vertex" && !result.is_list && result.name.size() == 1 && result.name >= "x" && result.name <= "z")
    result.axis = result.name[0] - 'x';
  result.is_corners = (owner.name == "face" || owner.name == "tristrips") && result.is_list &&
                      (result.name == "vertex_indices" || result.name == "vertex_index");
  return result;
}

void check(const FileText& file, const PlyHeader& header) {
  const auto fail = [&](const PlyElement& e, const std::string& message) {
    fail_at(file.name, {e.line, MeshFilePlace::Unit::line}, message);
  };
  for (const PlyElement& e : header.elements) {
    const auto same = [&](const PlyElement& other) { return other.name == e.name; };
    if (std::count_if(header.elements.begin(), header.elements.end(), same) > 1)
      fail(e, "element " + toposcope::quoted(e.name) + " is declared more than once");
    const auto& p = e.properties;
    for (int axis = 0; axis < 3; ++axis)
      if (e.name == "vertex" &&
          std::count_if(p.begin(), p.end(), [&](const PlyProperty& q) { return q.axis == axis; }) != 1)
        fail(e, std::string("element 'vertex' must have one property '") + "xyz"[axis] + "'");
    if ((e.name == "face" || e.name == "tristrips") && e.count > 0 &&
        std::count_if(p.begin(), p.end(), [](const PlyProperty& q) { return q.is_corners; }) != 1)
      fail(e, "element " + toposcope::quoted(e.name) + " must have one list 'vertex_indices' (or 'vertex_index')");
  }
}

}  // namespace

std::size_t ply_scalar_size(PlyScalar type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(const FileText& file) {
  PlyHeader header;
  HeaderLines lines(file);
  if (const auto& words = lines.next(); words.size() != 1 || words[0] != "ply")
    lines.fail("expected 'ply'; is this a PLY file?");
  bool has_format = false;
  while (true) {
    const auto& words = lines.next();
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format" && words.size() >= 2) {
      header.format = format(lines, words[1]);
      has_format = true;
    } else if (words[0] == "element") {
      header.elements.push_back(element(lines, words));
    } else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(property(lines, words, header.elements.back()));
    } else {
      lines.fail("unexpected " + quoted(words[0]) + " in the header; expected format, element, property or end_header");
    }
  }
  if (!has_format) lines.fail("the header names no format; add a line such as 'format ascii 1.0'");
  header.size = lines.bytes();
  header.lines = lines.line();
  check(file, header);
  return header;
}

}  // namespace toposcope
