// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "io/gltf_buffers.h"
#include "io/gltf_compression.h"
#include "io/gltf_document.h"
#include "io/readers.h"

namespace toposcope {
namespace {

using Transform = Eigen::Matrix<double, 3, 4, Eigen::DontAlign>;

enum Mode : std::size_t { points = 0, lines = 1, line_strip = 3, triangles = 4, strip = 5, fan = 6 };

template <std::size_t n>
std::array<double, n> numbers(const GltfValue& node, const std::string& key, std::array<double, n> otherwise) {
  if (!node.has(key)) return otherwise;
  const GltfValue list = node[key];
  if (list.size() != n) list.fail("must have " + std::to_string(n) + " numbers");
  for (std::size_t i = 0; i < n; ++i) otherwise[i] = list[i].number();
  return otherwise;
}

/// What a node does to its children and its mesh: a matrix, or scale, rotation and translation.
Transform transform_of(const GltfValue& node) {
  Transform result;
  if (node.has("matrix")) {
    const auto m = numbers<16>(node, "matrix", {});
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) result(row, column) = m[static_cast<std::size_t>(4 * column + row)];
    return result;
  }
  const auto t = numbers<3>(node, "translation", {}), s = numbers<3>(node, "scale", {1, 1, 1});
  const auto r = numbers<4>(node, "rotation", {0, 0, 0, 1});
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized();
  result.leftCols<3>() = rotation.toRotationMatrix() * Vec3(s[0], s[1], s[2]).asDiagonal();
  result.col(3) = Vec3(t[0], t[1], t[2]);
  return result;
}

Transform product(const Transform& outer, const Transform& inner) {
  Transform result;
  result.leftCols<3>() = outer.leftCols<3>() * inner.leftCols<3>();
  result.col(3) = outer.leftCols<3>() * inner.col(3) + outer.col(3);
  return result;
}

class SceneReader {
 public:
  SceneReader(const FileText& file, const GltfDocument& document)
      : root_(file.name, document.json, ""), buffers_(file, document), builder_(file.name) {}

  TriangleSoup read() {
    refuse_required_extensions();
    const Transform as_it_is = Transform::Identity();
    if (root_.has("scenes")) {
      visit(root_["scenes"][root_.whole("scene", 0)]);
    } else if (root_.has("meshes")) {
      for (std::size_t i = 0, count = root_["meshes"].size(); i < count; ++i) add_mesh(i, as_it_is);
    }
    if (points_and_lines_ > 0 && surfaces_ == 0)
      root_.fail("holds points or lines only (" + std::to_string(points_and_lines_) +
                 " primitives) and no triangle; mesh the points first, or export the surface");
    return builder_.finish();
  }

 private:
  void refuse_required_extensions() const {
    if (!root_.has("extensionsRequired")) return;
    const GltfValue required = root_["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
      const std::string name = required[i].text();
      constexpr std::string_view readable[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                               "KHR_meshopt_compression"};
      if (name.ends_with("_compression") && std::ranges::count(readable, name) == 0)
        required.fail("names " + toposcope::quoted(name) +
                      ", which cannot be read; export the mesh without compression");
      if (name == "EXT_mesh_gpu_instancing") refuse_instancing(required);
    }
  }

  [[noreturn]] static void refuse_instancing(const GltfValue& place) {
    place.fail("uses EXT_mesh_gpu_instancing, which cannot be read; export the mesh with its instances made real");
  }

  /// All nodes below the scene. A loop takes the place of recursion, so that no depth of nesting can exhaust the stack.
  void visit(const GltfValue& scene) {
    if (!scene.has("nodes")) return;
    std::vector<bool> seen(root_["nodes"].size());
    std::vector<std::pair<std::size_t, Transform>> open;
    const auto push = [&](const GltfValue& list, const Transform& transform) {
      for (std::size_t i = list.size(); i-- > 0;) {
        const std::size_t node = list[i].whole();
        if (node >= seen.size()) list.fail("names node " + std::to_string(node) + ", which does not exist");
        if (seen[node])
          list.fail("names node " + std::to_string(node) +
                    " a second time; a node has one parent and nodes make no ring");
        seen[node] = true;
        open.emplace_back(node, transform);
      }
    };
    push(scene["nodes"], Transform::Identity());
    while (!open.empty()) {
      const auto [index, outer] = open.back();
      open.pop_back();
      const GltfValue node = root_["nodes"][index];
      if (node.has("extensions") && node["extensions"].has("EXT_mesh_gpu_instancing")) refuse_instancing(node);
      const Transform transform = product(outer, transform_of(node));
      if (node.has("mesh")) add_mesh(node["mesh"].whole(), transform);
      if (node.has("children")) push(node["children"], transform);
    }
  }

  void add_mesh(std::size_t index, const Transform& transform) {
    const GltfValue primitives = root_["meshes"][index]["primitives"];
    std::map<std::size_t, std::size_t> first_vertex;  // by accessor: primitives may share their positions
    for (std::size_t i = 0, count = primitives.size(); i < count; ++i) {
      const GltfValue primitive = primitives[i];
      spend(1, primitive);
      const std::size_t mode = primitive.whole("mode", triangles);
      if (mode > fan) primitive.fail("has mode " + std::to_string(mode) + ", but glTF knows 0 to 6");
      ++(mode >= triangles ? surfaces_ : points_and_lines_);
      if (mode >= triangles) add_primitive(primitive, mode, transform, first_vertex);
    }
  }

  void add_primitive(const GltfValue& primitive, std::size_t mode, const Transform& transform,
                     std::map<std::size_t, std::size_t>& first_vertex) {
    const std::size_t positions = primitive["attributes"]["POSITION"].whole();
    const std::string draco = "KHR_draco_mesh_compression";
    if (primitive.has("extensions") && primitive["extensions"].has(draco) &&
        !root_["accessors"][positions].has("bufferView"))
      return add_draco(primitive, mode, primitive["extensions"][draco], transform);
    const auto [entry, is_new] = first_vertex.try_emplace(positions, builder_.position_count());
    if (is_new) add_positions(primitive, buffers_.numbers(positions, 3), transform);
    const std::size_t count = root_["accessors"][positions]["count"].whole();
    std::vector<double> listed;
    if (primitive.has("indices")) listed = buffers_.numbers(primitive["indices"].whole(), 1);
    const std::size_t corners = primitive.has("indices") ? listed.size() : count;
    add_faces(primitive, mode, transform, {entry->second, count, corners, std::move(listed)});
  }

  void add_draco(const GltfValue& primitive, std::size_t mode, const GltfValue& extension, const Transform& transform) {
    DracoPrimitive decoded = decode_draco(extension, buffers_.view_bytes(extension["bufferView"].whole()));
    buffers_.hold((decoded.positions.size() + decoded.indices.size()) * sizeof(float));
    const std::size_t first = builder_.position_count();
    add_positions(primitive, decoded.positions, transform);
    const std::size_t corners = decoded.indices.size();
    // Strips are stored as the triangles that they stand for.
    add_faces(primitive, mode == strip ? std::size_t{triangles} : mode, transform,
              {first, decoded.positions.size() / 3, corners, std::move(decoded.indices)});
  }

  /// The corners of a primitive's faces.
  struct Corners {
    std::size_t first, vertices;  ///< of its positions
    std::size_t count;
    std::vector<double> listed;  ///< empty: all vertices in turn
  };

  void add_faces(const GltfValue& primitive, std::size_t mode, const Transform& transform, const Corners& corners) {
    const auto& [first, count, all, listed] = corners;
    spend(all, primitive);
    const bool mirrored = transform.leftCols<3>().determinant() < 0;  // outside stays outside
    for (double index : listed)
      if (!(index >= 0 && index < static_cast<double>(count)) ||
          index != static_cast<double>(static_cast<std::size_t>(index)))
        primitive.fail(fmt::format("refers to vertex {} but has {}; the indices are damaged", index, count));
    const auto vertex = [&at = corners](std::size_t corner) {
      return static_cast<std::int64_t>(at.first +
                                       (at.listed.empty() ? corner : static_cast<std::size_t>(at.listed[corner])));
    };
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      std::array<std::int64_t, 3> face = {vertex(a), vertex(b), vertex(c)};
      if (mirrored) std::swap(face[1], face[2]);
      builder_.add_face(face, {});
    };
    if (mode == triangles)
      for (std::size_t i = 0; i + 2 < all; i += 3) add(i, i + 1, i + 2);
    else
      for (std::size_t i = 2; i < all; ++i) {
        if (mode == fan)
          add(0, i - 1, i);
        else
          add(i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1);
      }
  }

  void add_positions(const GltfValue& primitive, const std::vector<double>& given, const Transform& transform) {
    spend(given.size() / 3, primitive);
    for (std::size_t i = 0; i < given.size(); i += 3)
      builder_.add_position(transform.leftCols<3>() * Vec3(given[i], given[i + 1], given[i + 2]) + transform.col(3),
                            {});
  }

  /// Nodes may repeat a mesh without end. A mesh without instances needs at most one unit a byte.
  void spend(std::size_t amount, const GltfValue& primitive) {
    constexpr std::size_t always_granted = std::size_t{1} << 20;
    spent_ += amount;
    const std::size_t most = std::max(always_granted, 2 * buffers_.bytes_held());
    if (spent_ > most)
      primitive.fail("is repeated until the scene has more than " + std::to_string(most) +
                     " vertices and corners, out of proportion to the file; export fewer instances, or a PLY");
  }

  GltfValue root_;
  GltfBuffers buffers_;
  SoupBuilder builder_;
  std::size_t spent_ = 0;
  std::size_t surfaces_ = 0, points_and_lines_ = 0;  ///< primitives seen
};

}  // namespace

TriangleSoup read_gltf(const FileText& file) {
  const GltfDocument document = read_gltf_document(file);
  return SceneReader(file, document).read();
}

}  // namespace toposcope
