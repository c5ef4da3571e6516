// SPDX-License-Identifier: BSD-3-Clause
#include "io/gltf_buffers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "io/gltf_compression.h"
#include "io/gltf_uri.h"

namespace toposcope {
namespace {

enum : std::size_t { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

std::size_t size_of(std::size_t type) {
  return type == int8 || type == uint8 ? 1 : type == int16 || type == uint16 ? 2 : 4;
}

/// \param owner  has a componentType
std::size_t type_of(const GltfValue& owner) {
  const GltfValue type = owner["componentType"];
  constexpr std::size_t known[] = {int8, uint8, int16, uint16, uint32, float32};
  if (std::ranges::count(known, type.whole()) == 0)
    type.fail("is " + std::to_string(type.whole()) + ", but must be 5120 to 5123, 5125 or 5126");
  return type.whole();
}

template <class T>
T load(const char* bytes) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

template <class T>
void decode(const char* data, std::size_t count, std::size_t stride, std::size_t components, bool normalized,
            double* out) {
  const double scale = normalized ? 1 / static_cast<double>(std::numeric_limits<T>::max()) : 1;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < components; ++c) {
      const auto value = static_cast<double>(load<T>(data + i * stride + c * sizeof(T)));
      *out++ = normalized ? std::max(value * scale, -1.0) : value;
    }
}

void decode(std::size_t type, const char* data, std::size_t count, std::size_t stride, std::size_t components,
            bool normalized, double* out) {
  switch (type) {
    case int8:
      return decode<std::int8_t>(data, count, stride, components, normalized, out);
    case uint8:
      return decode<std::uint8_t>(data, count, stride, components, normalized, out);
    case int16:
      return decode<std::int16_t>(data, count, stride, components, normalized, out);
    case uint16:
      return decode<std::uint16_t>(data, count, stride, components, normalized, out);
    case uint32:
      return decode<std::uint32_t>(data, count, stride, components, normalized, out);
    default:
      return decode<float>(data, count, stride, components, false, out);
  }
}

}  // namespace

GltfBuffers::GltfBuffers(const FileText& file, const GltfDocument& document)
    : file_(file), root_(file.name, document.json, ""), binary_(document.binary), bytes_held_(file.bytes.size()) {}

std::string_view GltfBuffers::buffer(std::size_t index) {
  const auto [entry, is_new] = buffers_.try_emplace(index);
  if (!is_new) return entry->second;
  const GltfValue buffer = root_["buffers"][index];
  const std::size_t length = buffer["byteLength"].whole();
  std::string_view bytes;
  if (buffer.has("uri")) {
    const std::string uri = buffer["uri"].text();
    if (uri.starts_with("data:")) {
      bytes = decoded_[index] = decode_data_uri(buffer["uri"], uri);
    } else {
      const std::filesystem::path path =
          path_of_uri(buffer["uri"], uri, std::filesystem::path(file_.name).parent_path());
      const auto [external, is_new_file] = files_.try_emplace(path);
      if (is_new_file) {
        external->second = read_file_bytes(path);
        bytes_held_ += external->second.size;
      }
      bytes = external->second.view();
    }
  } else if (index == 0 && binary_) {
    bytes = *binary_;
  } else {
    buffer.fail("has neither a uri nor the binary chunk of a GLB; the file is cut short or not valid glTF");
  }
  if (length > bytes.size())
    buffer.fail("announces " + std::to_string(length) + " bytes but holds " + std::to_string(bytes.size()) +
                "; it is cut short");
  return entry->second = bytes.substr(0, length);
}

std::string_view GltfBuffers::range(const GltfValue& owner) {
  const std::string_view bytes = buffer(owner["buffer"].whole());
  const std::size_t begin = owner.whole("byteOffset", 0), length = owner["byteLength"].whole();
  if (begin > bytes.size() || length > bytes.size() - begin)
    owner.fail("covers bytes " + std::to_string(begin) + " to " + std::to_string(begin + length) + " of a buffer of " +
               std::to_string(bytes.size()));
  return bytes.substr(begin, length);
}

std::string_view GltfBuffers::view_bytes(std::size_t index) {
  const GltfValue view = root_["bufferViews"][index];
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (!view.has("extensions") || !view["extensions"].has(name)) continue;
    const auto [entry, is_new] = decompressed_.try_emplace(index);
    if (is_new) {
      const GltfValue extension = view["extensions"][name];
      entry->second = decode_meshopt(extension, range(extension));
      hold(entry->second.size());
    }
    return entry->second;
  }
  return range(view);
}

GltfBuffers::Elements GltfBuffers::elements(const GltfValue& owner, std::size_t type, std::size_t count,
                                            std::size_t components) {
  const std::size_t index = owner["bufferView"].whole();
  const GltfValue view = root_["bufferViews"][index];
  const std::string_view bytes = view_bytes(index);
  const std::size_t length = bytes.size();
  const std::size_t size = components * size_of(type);
  const std::size_t stride = view.whole("byteStride", size), offset = owner.whole("byteOffset", 0);
  constexpr std::size_t largest_stride = 252;
  if (stride < size || stride > largest_stride)
    view.fail("has a byteStride of " + std::to_string(stride) + ", which must be from " + std::to_string(size) +
              " (an element) to 252");
  if (offset > length || (count > 0 && (size > length - offset || (count - 1) > (length - offset - size) / stride)))
    owner.fail("has " + std::to_string(count) + " elements, more than its buffer view of " + std::to_string(length) +
               " bytes holds; it is damaged or cut short");
  return {bytes.data() + offset, count, stride, type};
}

std::vector<double> GltfBuffers::numbers(std::size_t index, std::size_t components) {
  const GltfValue accessor = root_["accessors"][index];
  const std::size_t count = accessor["count"].whole();
  const char* shape = components == 1 ? "SCALAR" : "VEC3";
  if (accessor["type"].text() != shape) accessor.fail("must have the type " + std::string(shape));
  const std::size_t type = type_of(accessor);
  std::vector<double> result;
  if (accessor.has("bufferView")) {
    const Elements from = elements(accessor, type, count, components);
    result.resize(count * components);
    decode(type, from.data, count, from.stride, components, accessor.flag("normalized"), result.data());
  } else if (accessor.has("sparse")) {  // zero, but for the sparse ones
    if (count > bytes_held_)
      accessor.fail("has " + std::to_string(count) + " elements, more than the file could hold; it is damaged");
    result.resize(count * components);
  } else {
    accessor.fail("has no data (no bufferView)");
  }
  if (accessor.has("sparse")) fill_in(accessor["sparse"], type, components, result);
  return result;
}

void GltfBuffers::fill_in(const GltfValue& sparse, std::size_t type, std::size_t components,
                          std::vector<double>& numbers) {
  const std::size_t count = sparse["count"].whole();
  const GltfValue places = sparse["indices"];
  const Elements at = elements(places, type_of(places), count, 1);
  const Elements from = elements(sparse["values"], type, count, components);
  const std::size_t elements_count = numbers.size() / components;
  std::vector<double> index(count);
  decode(at.type, at.data, count, at.stride, 1, false, index.data());
  for (std::size_t i = 0; i < count; ++i) {
    if (!(index[i] >= 0) || index[i] >= static_cast<double>(elements_count))
      places.fail("name an element that the accessor does not have; the file is damaged");
    decode(type, from.data + i * from.stride, 1, from.stride, components, false,
           numbers.data() + static_cast<std::size_t>(index[i]) * components);
  }
}

}  // namespace toposcope
