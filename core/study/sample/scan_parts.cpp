// SPDX-License-Identifier: BSD-3-Clause
#include "sample/scan_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

#include "sample/depth_fusion.h"
#include "sample/scan.h"
#include "sample/solid.h"
#include "toposcope/geometry/closest_face.h"

namespace toposcope {

namespace {

void drop_unused_vertices(TriangleSoup& mesh) {
  std::vector<Index> number(mesh.positions.size(), no_index);
  std::vector<Vec3> positions;
  for (Triangle& t : mesh.triangles)
    for (Index& v : t) {
      if (number[v] == no_index) {
        number[v] = static_cast<Index>(positions.size());
        positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
  mesh.positions = std::move(positions);
}

/// For each vertex the least vertex that faces join it to.
std::vector<Index> component_of(const TriangleSoup& mesh) {
  std::vector<Index> root(mesh.positions.size());
  std::iota(root.begin(), root.end(), Index{0});
  const auto find = [&](Index v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles)
    for (const Index other : {t[1], t[2]}) {
      const Index a = find(t[0]), b = find(other);
      root[std::max(a, b)] = std::min(a, b);
    }
  for (Index v = 0; v < root.size(); ++v) root[v] = find(v);
  return root;
}

bool is_direction(const std::string& name) {
  return name == "normal" || name == "axis" || name == "direction";
}

void move_feature(TruthFeature& feature, const Pose& pose) {
  const auto place = [&](const Vec3& p) { return Vec3(pose.rotation * (p - pose.center) + pose.translation); };
  for (Vec3& p : feature.points) p = place(p);
  for (TruthGroup& group : feature.groups) group.centroid = place(group.centroid);
  for (auto& [name, values] : feature.parameters) {
    if (values.empty() || values.size() % 3 != 0) continue;
    for (std::size_t i = 0; i < values.size(); i += 3) {
      const Vec3 value(values[i], values[i + 1], values[i + 2]);
      const Vec3 moved = is_direction(name) ? Vec3(pose.rotation * value) : place(value);
      for (std::size_t k = 0; k < 3; ++k) values[i + k] = moved[static_cast<Eigen::Index>(k)];
    }
  }
}

/// Drops the points that are not near what is left of the surface; all of them when too few are left.
void keep_near(TruthFeature& feature, const ClosestFace& surface, double reach) {
  std::vector<Vec3> points;
  std::vector<Index> number(feature.points.size(), no_index);
  for (std::size_t i = 0; i < number.size(); ++i)
    if (surface(feature.points[i]).squared_distance <= reach * reach) {
      number[i] = static_cast<Index>(points.size());
      points.push_back(feature.points[i]);
    }
  if (static_cast<double>(points.size()) < least_share * static_cast<double>(number.size())) {
    points.clear();
    feature.groups.clear();
  }
  feature.points = std::move(points);
  for (TruthGroup& group : feature.groups) {
    std::erase_if(group.members, [&](Index i) { return number[i] == no_index; });
    for (Index& i : group.members) i = number[i];
  }
  std::erase_if(feature.groups, [](const TruthGroup& group) { return group.members.empty(); });
}

}  // namespace

void keep_measured(TriangleSoup& mesh, std::span<const DepthView> views, double tolerance, Context& context) {
  const std::vector<char> measured = measured_near(views, mesh.positions, tolerance, context);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(), [&](Index v) { return measured[v] == 0; });
  });
  drop_unused_vertices(mesh);
}

void keep_large_components(TriangleSoup& mesh, bool closed) {
  const std::vector<Index> component = component_of(mesh);
  std::vector<std::size_t> faces(mesh.positions.size(), 0);
  std::vector<double> volume(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    ++faces[component[t[0]]];
    volume[component[t[0]]] += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
  }
  const std::size_t largest = faces.empty() ? 0 : *std::max_element(faces.begin(), faces.end());
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Index c = component[t[0]];
    return 20 * faces[c] < largest || (closed && volume[c] <= 0);
  });
  drop_unused_vertices(mesh);
}

Sample scanned_truth(const Sample& posed, const MeshView& mesh, const Pose& pose, double reach, Context& context) {
  Sample made;
  made.parameters = posed.parameters;
  made.thinnest = posed.thinnest;
  made.gap = posed.gap;
  made.part_names = posed.part_names;
  made.mesh.positions.assign(mesh.positions.begin(), mesh.positions.end());
  made.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  made.mesh.input_faces = mesh.face_count();
  made.mesh.face_origin.resize(mesh.face_count());
  std::iota(made.mesh.face_origin.begin(), made.mesh.face_origin.end(), Index{0});

  made.face_part.assign(mesh.face_count(), 0);
  if (posed.part_names.size() > 1) {
    const ClosestFace exact(posed.mesh.positions, posed.mesh.triangles);
    context.parallel_for(mesh.face_count(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t f = first; f < last; ++f) {
        const Triangle& t = mesh.triangles[f];
        const Vec3 center = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
        made.face_part[f] = posed.face_part[exact(center).face];
      }
    });
  }
  for (Vec3& p : made.mesh.positions) p += pose.translation;

  made.truth = posed.truth;
  for (TruthFeature& feature : made.truth.features) move_feature(feature, pose);
  if (reach > 0) {
    const ClosestFace surface(made.mesh.positions, made.mesh.triangles);
    for (TruthFeature& feature : made.truth.features) keep_near(feature, surface, reach);
  }
  for (TruthFeature& feature : made.truth.features) {
    feature.vertices.clear();
    mark_vertices(feature, made.mesh.positions);
  }
  return made;
}

}  // namespace toposcope
