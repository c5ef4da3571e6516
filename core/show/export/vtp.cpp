// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <limits>

#include "export/export.h"
#include "scene/buffer.h"

namespace toposcope {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says that it is little-endian");

/// Numbers in base64 behind their count of bytes.
template <class Value>
std::string array(const std::string& attributes, const std::vector<Value>& values) {
  const std::uint64_t size = values.size() * sizeof(Value);
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
  return "<DataArray " + attributes + " format=\"binary\">" + to_base64(bytes) + "</DataArray>\n";
}

/// Cells of one kind: their corners, and where each ends.
struct Cells {
  std::vector<std::int64_t> corners, ends;
  std::vector<std::int32_t> labels, faces;
  std::vector<std::uint8_t> shapes;  ///< 1: of a fitted shape, 0: of the mesh

  void add(std::span<const Index> vertices, std::int64_t first, std::size_t label, std::int32_t face) {
    for (const Index v : vertices) corners.push_back(first + v);
    ends.push_back(static_cast<std::int64_t>(corners.size()));
    labels.push_back(static_cast<std::int32_t>(label));
    faces.push_back(face);
    shapes.push_back(face < 0);
  }
  std::string xml(const char* name) const {
    return "<" + std::string(name) + ">\n" + array("type=\"Int64\" Name=\"connectivity\"", corners) +
           array("type=\"Int64\" Name=\"offsets\"", ends) + "</" + name + ">\n";
  }
};

template <class Value>
std::vector<Value> joined(const std::vector<Value>& first, const std::vector<Value>& second) {
  std::vector<Value> all = first;
  all.insert(all.end(), second.begin(), second.end());
  return all;
}

class Geometry {
 public:
  void mesh(const LabelledMesh& labelled) {
    const MeshView& view = labelled.mesh.view();
    const std::int64_t first = add({view.positions.begin(), view.positions.end()});
    for (Index t = 0; t < view.face_count(); ++t)
      polys.add(view.triangles[t], first, labelled.labels[t],
                static_cast<std::int32_t>(labelled.mesh.face_origin()[t]));
  }

  void shape(const Drawing& drawing, std::size_t label) {
    for (const std::vector<Vec3>& line : drawing.lines) {
      const std::int64_t first = add(line);
      std::vector<Index> along(line.size());
      for (Index i = 0; i < along.size(); ++i) along[i] = i;
      lines.add(along, first, label, -1);
    }
    for (const Patch& patch : drawing.patches) {
      const std::int64_t first = add(patch.positions);
      for (const Triangle& t : patch.triangles) polys.add(t, first, label, -1);
    }
  }

  std::vector<double> points;
  Cells lines, polys;

 private:
  std::int64_t add(const std::vector<Vec3>& positions) {
    const auto first = static_cast<std::int64_t>(points.size() / 3);
    for (const Vec3& p : positions) points.insert(points.end(), p.begin(), p.end());
    return first;
  }
};

/// Strings are a field array of bytes, each ended by 0.
std::string field_data(const LabelledMesh& labelled) {
  std::vector<char> names;
  std::vector<double> probabilities;
  const auto add = [&](const std::string& name, double probability) {
    names.insert(names.end(), name.begin(), name.end());
    names.push_back('\0');
    probabilities.push_back(probability);
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  add("unlabelled", none);
  for (const StoredFeature& feature : labelled.result.features)
    add(feature.name, feature.present ? feature.probability : none);
  const std::string count = "NumberOfTuples=\"" + std::to_string(probabilities.size()) + "\"";
  std::string strings = array("type=\"String\" Name=\"features\" " + count, names);
  strings.replace(1, 9, "Array");
  strings.replace(strings.rfind("</DataArray>"), 12, "</Array>");
  return "<FieldData>\n" + strings + array("type=\"Float64\" Name=\"probability\" " + count, probabilities) +
         "</FieldData>\n";
}

}  // namespace

std::string to_vtp(const LabelledMesh& labelled) {
  Geometry geometry;
  geometry.mesh(labelled);
  for (const FoundFeature& found : labelled.found) geometry.shape(found.drawing, labelled.number_of(found.feature) + 1);
  const Cells &lines = geometry.lines, &polys = geometry.polys;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n";
  text += field_data(labelled);
  text += "<Piece NumberOfPoints=\"" + std::to_string(geometry.points.size() / 3) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(lines.ends.size()) +
          "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(polys.ends.size()) + "\">\n";
  text += "<Points>\n" + array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", geometry.points) +
          "</Points>\n";
  // Cells are counted lines first.
  text += "<CellData Scalars=\"label\">\n" +
          array("type=\"Int32\" Name=\"label\"", joined(lines.labels, polys.labels)) +
          array("type=\"UInt8\" Name=\"shape\"", joined(lines.shapes, polys.shapes)) +
          array("type=\"Int32\" Name=\"face\"", joined(lines.faces, polys.faces)) + "</CellData>\n";
  text += lines.xml("Lines") + polys.xml("Polys") + "</Piece>\n</PolyData>\n</VTKFile>\n";
  return text;
}

}  // namespace toposcope
