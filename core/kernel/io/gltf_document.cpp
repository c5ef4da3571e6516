// SPDX-License-Identifier: BSD-3-Clause
#include "io/gltf_document.h"

#include <algorithm>
#include <cmath>

namespace toposcope {
namespace {

using Json = nlohmann::json;

/// Offsets and counts beyond this (a quarter of a petabyte) are nonsense, and below it no product of two overflows.
constexpr std::uint64_t largest_whole = std::uint64_t{1} << 48;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

bool nests_deeper_than(std::ptrdiff_t deepest, std::string_view json) {
  std::ptrdiff_t depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') in_text = !in_text;
    if (in_text) {
      i += c == '\\';
    } else if (c == '[' || c == '{') {
      if (++depth > deepest) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

/// \param begin  of the JSON within the file
Json parse(const FileText& file, std::string_view text, std::size_t begin) {
  constexpr int deepest = 64;  // glTF itself needs about eight, what programs add a few more
  if (nests_deeper_than(deepest, text))
    fail_at(file.name, {}, "the JSON is nested more than " + std::to_string(deepest) + " deep; it is damaged");
  try {
    Json json = Json::parse(text);
    if (!json.is_object()) fail_at(file.name, {}, "the JSON is not an object; is this a glTF file?");
    return json;
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    if (begin > 0) fail_at(file.name, {begin + at, MeshFilePlace::Unit::byte}, "the JSON is damaged or cut short here");
    const auto line = static_cast<std::size_t>(std::ranges::count(text.substr(0, at), '\n')) + 1;
    fail_at(file.name, {line, MeshFilePlace::Unit::line}, "the JSON is damaged or cut short here");
  } catch (const Json::exception&) {
    fail_at(file.name, {}, "the JSON holds a number beyond the range of numbers; it is damaged");
  }
}

std::string_view chunk(const FileText& file, std::size_t at, std::string_view type) {
  const std::size_t length = word_at(file.bytes, at);
  if (file.bytes.substr(at + 4, 4) != type)
    fail_at(file.name, {at, MeshFilePlace::Unit::byte},
            "expected a chunk of the type " + quoted(type) + " but found " + quoted(file.bytes.substr(at + 4, 4)));
  if (length > file.bytes.size() - at - 8)
    fail_at(file.name, {at, MeshFilePlace::Unit::byte},
            "a chunk of " + std::to_string(length) + " bytes, but " + std::to_string(file.bytes.size() - at - 8) +
                " follow; the file is cut short");
  return file.bytes.substr(at + 8, length);
}

/// Spaces pad the JSON; some programs take zeros.
std::string_view without_padding(std::string_view json) {
  const std::size_t last = json.find_last_not_of('\0');
  return json.substr(0, last == json.npos ? 0 : last + 1);
}

/// Chunks are multiples of four bytes. Of programs that do not keep to it, some write the next chunk right behind, some
/// where it should be.
std::size_t after_chunk(const FileText& file, std::size_t end) {
  const bool right_behind = file.bytes.substr(std::min(end + 4, file.bytes.size()), 4) == std::string_view("BIN\0", 4);
  return right_behind ? end : (end + 3) / 4 * 4;
}

}  // namespace

GltfValue GltfValue::operator[](const std::string& key) const {
  if (!has(key)) fail("has no '" + key + "'; the file is not valid glTF");
  return {*file_, (*json_)[key], name_.empty() ? key : name_ + "." + key};
}

GltfValue GltfValue::operator[](std::size_t index) const {
  if (index >= size())
    fail("has " + std::to_string(size()) + " entries, but entry " + std::to_string(index) + " (from 0) is referred to");
  return {*file_, (*json_)[index], name_ + "[" + std::to_string(index) + "]"};
}

std::size_t GltfValue::size() const {
  if (!json_->is_array()) fail("must be an array");
  return json_->size();
}

std::size_t GltfValue::whole() const {
  // Some programs write 3.0 for 3.
  const double value = json_->is_number() ? json_->get<double>() : -1;
  if (!(value >= 0 && value < static_cast<double>(largest_whole)) || value != std::floor(value))
    fail("must be a whole number from 0");
  return static_cast<std::size_t>(value);
}

std::size_t GltfValue::whole(const std::string& key, std::size_t otherwise) const {
  return has(key) ? (*this)[key].whole() : otherwise;
}

double GltfValue::number() const {
  if (!json_->is_number()) fail("must be a number");
  return json_->get<double>();
}

std::string GltfValue::text() const {
  if (!json_->is_string()) fail("must be a text");
  return json_->get<std::string>();
}

bool GltfValue::flag(const std::string& key) const {
  return has(key) && (*json_)[key].is_boolean() && (*json_)[key].get<bool>();
}

void GltfValue::fail(const std::string& message) const {
  fail_at(*file_, {}, (name_.empty() ? "the glTF " : name_ + " ") + message);
}

GltfDocument read_gltf_document(const FileText& file) {
  constexpr std::size_t header = 12, chunk_header = 8;
  GltfDocument document;
  if (!file.bytes.starts_with("glTF")) {
    document.json = parse(file, file.bytes, 0);
  } else {
    if (file.bytes.size() < header + chunk_header) fail_at(file.name, {}, "the file ends within its header");
    if (const auto version = word_at(file.bytes, 4); version != 2)
      fail_at(file.name, {4, MeshFilePlace::Unit::byte},
              "glTF of version " + std::to_string(version) + " cannot be read; export version 2");
    const std::string_view text = chunk(file, header, "JSON");
    document.json = parse(file, without_padding(text), header + chunk_header);
    const std::size_t next = after_chunk(file, header + chunk_header + text.size());
    if (next + chunk_header <= file.bytes.size()) document.binary = chunk(file, next, {"BIN\0", 4});
  }
  const GltfValue root(file.name, document.json, "");
  if (const std::string version = root["asset"]["version"].text(); !version.starts_with("2."))
    root["asset"].fail("says version " + toposcope::quoted(version) + ", which cannot be read; export version 2.0");
  return document;
}

}  // namespace toposcope
