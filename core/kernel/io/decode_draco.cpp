// SPDX-License-Identifier: BSD-3-Clause
#include "io/gltf_compression.h"

#if defined(TOPOSCOPE_DRACO)
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <algorithm>
#include <limits>
#include <optional>
#endif

namespace toposcope {

#if defined(TOPOSCOPE_DRACO)
namespace {

/// The best that is known of a grid is some hundredths of a bit a face.
constexpr std::size_t most_faces_of_a_byte = 1024;

/// What the bytes say that they hold, without decoding them: the decoder makes room for so many before it looks.
/// \return the greater of the numbers of faces and vertices; nothing where the beginning is no Draco mesh
std::optional<std::size_t> announced(std::string_view compressed) {
  draco::DecoderBuffer buffer;
  buffer.Init(compressed.data(), compressed.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return std::nullopt;
  if (header.encoder_type != draco::TRIANGULAR_MESH || header.version_major != 2) return std::nullopt;
  buffer.set_bitstream_version(
      static_cast<std::uint16_t>(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor)));
  if ((header.flags & METADATA_FLAG_MASK) != 0) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) return std::nullopt;
  }
  std::uint32_t first = 0, second = 0, unused = 0;
  std::uint8_t traversal = 0;
  const bool edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
  if (edgebreaker && !buffer.Decode(&traversal)) return std::nullopt;
  if (edgebreaker && header.version_minor < 2 && !draco::DecodeVarint(&unused, &buffer)) return std::nullopt;
  if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) return std::nullopt;
  return std::max(first, second);
}

const draco::PointAttribute& positions_of(const GltfValue& extension, const draco::Mesh& mesh) {
  const GltfValue id = extension["attributes"]["POSITION"];
  const auto most = static_cast<std::size_t>(std::numeric_limits<std::uint32_t>::max());
  const draco::PointAttribute* attribute =
      id.whole() > most ? nullptr : mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id.whole()));
  if (!attribute || attribute->num_components() != 3)
    id.fail("is " + std::to_string(id.whole()) + ", which is no attribute of three numbers in the compressed bytes");
  return *attribute;
}

}  // namespace

DracoPrimitive decode_draco(const GltfValue& extension, std::string_view compressed) {
  const std::string remedy = "; the file is damaged: export the mesh again, or without compression";
  const std::optional<std::size_t> count = announced(compressed);
  if (!count) extension.fail("holds no mesh of Draco 2" + remedy);
  if (*count > most_faces_of_a_byte * compressed.size())
    extension.fail("announces " + std::to_string(*count) + " faces or vertices in " +
                   std::to_string(compressed.size()) + " bytes" + remedy);
  draco::DecoderBuffer buffer;
  buffer.Init(compressed.data(), compressed.size());
  draco::Decoder decoder;
  const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) extension.fail("cannot be decompressed (" + decoded.status().error_msg_string() + ")" + remedy);
  const draco::Mesh& mesh = *decoded.value();
  const draco::PointAttribute& positions = positions_of(extension, mesh);
  DracoPrimitive primitive;
  primitive.positions.resize(3 * std::size_t{mesh.num_points()});
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p)
    if (!positions.ConvertValue<double, 3>(positions.mapped_index(p), &primitive.positions[3 * std::size_t{p.value()}]))
      extension.fail("holds positions that are no numbers" + remedy);
  primitive.indices.reserve(3 * std::size_t{mesh.num_faces()});
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh.face(f)) primitive.indices.push_back(corner.value());
  return primitive;
}

#else

DracoPrimitive decode_draco(const GltfValue& extension, std::string_view) {
  extension.fail(
      "is compressed with Draco, and this program was built without it; export the mesh without "
      "compression, or build Toposcope where libdraco-dev is installed");
}

#endif

}  // namespace toposcope
