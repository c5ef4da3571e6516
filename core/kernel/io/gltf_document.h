// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "io/readers.h"

namespace toposcope {

/// A value in the JSON of a glTF that knows its own name, such as accessors[3].count, and what it must be.
class GltfValue {
 public:
  using Json = nlohmann::json;
  /// The file's name and the JSON must outlive the value.
  GltfValue(const std::string& file, const Json& json, std::string name)
      : file_(&file), json_(&json), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  /// False also where this is no object.
  bool has(const std::string& key) const { return json_->is_object() && json_->contains(key); }
  /// \throw MeshError  absent
  GltfValue operator[](const std::string& key) const;
  /// \throw MeshError  not an array, or no such element
  GltfValue operator[](std::size_t index) const;
  /// The number of elements. \throw MeshError  not an array
  std::size_t size() const;
  /// A whole number from 0. \throw MeshError
  std::size_t whole() const;
  std::size_t whole(const std::string& key, std::size_t otherwise) const;
  /// \throw MeshError
  double number() const;
  std::string text() const;
  bool flag(const std::string& key) const;

  /// "file: name: message"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const std::string* file_;
  const Json* json_;
  std::string name_;
};

/// The two parts of a glTF file.
struct GltfDocument {
  nlohmann::json json;
  std::optional<std::string_view> binary;  ///< the second chunk of a GLB
};

/// Takes a GLB apart and parses the JSON, whose nesting is bounded.
/// \throw MeshError  not glTF 2, cut short, damaged JSON
GltfDocument read_gltf_document(const FileText& file);

}  // namespace toposcope
