// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "io/file_bytes.h"
#include "io/gltf_document.h"

namespace toposcope {

/// The numbers of a glTF: buffers are fetched when they are first needed, and every range is checked before it is read.
class GltfBuffers {
 public:
  /// Both must outlive the buffers.
  GltfBuffers(const FileText& file, const GltfDocument& document);

  /// The bytes that the file and all its buffers have so far.
  std::size_t bytes_held() const { return bytes_held_; }

  /// All numbers of an accessor, `components` to an element; normalised integers as fractions, sparse ones filled in.
  /// \throw MeshError  damaged, out of range, not of this shape
  std::vector<double> numbers(std::size_t accessor, std::size_t components);

  /// The bytes of a buffer view, decompressed where it is compressed. \throw MeshError  damaged, out of range
  std::string_view view_bytes(std::size_t view);
  /// What was decompressed elsewhere counts among the bytes held.
  void hold(std::size_t bytes) { bytes_held_ += bytes; }

 private:
  struct Elements {
    const char* data;
    std::size_t count, stride, type;  ///< the type as glTF numbers it
  };

  std::string_view buffer(std::size_t index);
  /// The bytes that `owner` names by buffer, byteOffset and byteLength.
  std::string_view range(const GltfValue& owner);
  std::string_view from_uri(const GltfValue& buffer, const std::string& uri);
  /// `count` elements of a buffer view. \param owner  has bufferView and byteOffset
  Elements elements(const GltfValue& owner, std::size_t type, std::size_t count, std::size_t components);
  void fill_in(const GltfValue& sparse, std::size_t type, std::size_t components, std::vector<double>& numbers);

  const FileText& file_;
  GltfValue root_;
  std::optional<std::string_view> binary_;
  std::size_t bytes_held_;
  std::map<std::size_t, std::string_view> buffers_;
  std::map<std::filesystem::path, FileBytes> files_;
  std::map<std::size_t, std::string> decoded_;       ///< buffers
  std::map<std::size_t, std::string> decompressed_;  ///< buffer views
};

}  // namespace toposcope
