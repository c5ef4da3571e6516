// SPDX-License-Identifier: BSD-3-Clause
#include <meshoptimizer.h>

#include "io/gltf_compression.h"

namespace toposcope {
namespace {

/// No codec of the extension makes so many bytes of one.
constexpr std::size_t most_of_a_byte = 64;
constexpr std::size_t always_granted = std::size_t{1} << 12;

int decode(const std::string& mode, std::string& bytes, std::size_t count, std::size_t stride,
           std::string_view compressed) {
  const auto* from = reinterpret_cast<const unsigned char*>(compressed.data());
  if (mode == "ATTRIBUTES") return meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, compressed.size());
  if (mode == "TRIANGLES") return meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, compressed.size());
  return meshopt_decodeIndexSequence(bytes.data(), count, stride, from, compressed.size());
}

/// Attributes may be stored in another form yet.
void undo_filter(const GltfValue& extension, std::string& bytes, std::size_t count, std::size_t stride) {
  if (!extension.has("filter")) return;
  const GltfValue filter = extension["filter"];
  const std::string name = filter.text();
  if (name == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  else if (name == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  else if (name == "EXPONENTIAL" && stride % 4 == 0)
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  else if (name != "NONE")
    filter.fail("is " + toposcope::quoted(name) + " with a byteStride of " + std::to_string(stride) +
                ", which is none of NONE, OCTAHEDRAL (4 or 8), QUATERNION (8) and EXPONENTIAL (a multiple of 4)");
}

}  // namespace

std::string decode_meshopt(const GltfValue& extension, std::string_view compressed) {
  const std::size_t count = extension["count"].whole(), stride = extension["byteStride"].whole();
  const std::string mode = extension["mode"].text();
  const bool attributes = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
  if (!attributes && !triangles && mode != "INDICES")
    extension["mode"].fail("is " + toposcope::quoted(mode) + ", which is none of ATTRIBUTES, TRIANGLES and INDICES");
  if (attributes ? stride == 0 || stride % 4 != 0 || stride > 256 : stride != 2 && stride != 4)
    extension["byteStride"].fail("is " + std::to_string(stride) + ", but must be " +
                                 (attributes ? "a multiple of 4 up to 256" : "2 or 4"));
  if (triangles && count % 3 != 0) extension["count"].fail("is " + std::to_string(count) + ", no whole triangles");
  if (count > (always_granted + most_of_a_byte * compressed.size()) / stride)
    extension["count"].fail("is " + std::to_string(count) + ", more than " + std::to_string(compressed.size()) +
                            " compressed bytes can hold; the file is damaged");
  std::string bytes(count * stride, '\0');
  if (count > 0 && decode(mode, bytes, count, stride, compressed) != 0)
    extension.fail(
        "holds bytes that cannot be decompressed; they are damaged, or of a newer version of meshopt: export "
        "the mesh without compression");
  if (attributes) undo_filter(extension, bytes, count, stride);
  return bytes;
}

}  // namespace toposcope
