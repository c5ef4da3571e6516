// SPDX-License-Identifier: BSD-3-Clause
// Fewer faces by collapsing half-edges, those first that change the shape least in the quadric error metric.

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>  // QuadricT.hh does not stand alone
#include <algorithm>
#include <string>
#include <vector>

#include "toposcope/geometry/closest_face.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using Halfedges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Point = Halfedges::Point;
using Quadric = OpenMesh::Geometry::QuadricT<double>;

/// OpenMesh's ModQuadric knows no boundary and accepts folds; this one holds the boundary by planes that stand on it,
/// as Garland and Heckbert do, and refuses to turn a face over.
template <class MeshT>
class QuadricModule : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(QuadricModule, MeshT, Quadric);

  explicit QuadricModule(MeshT& mesh) : Base(mesh, false) {}

  void initialize() override {
    const Halfedges& mesh = Base::mesh();
    quadrics_.assign(mesh.n_vertices(), Quadric(0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
    for (const auto h : mesh.halfedges()) {
      if (mesh.is_boundary(h)) continue;
      const Point &a = mesh.point(mesh.from_vertex_handle(h)), &b = mesh.point(mesh.to_vertex_handle(h));
      const Point& c = mesh.point(mesh.opposite_vh(h));
      const Point normal = (b - a) % (c - a);
      // Each face gives its plane, weighted by its area, to the corner that this half-edge leaves.
      add_plane(mesh.from_vertex_handle(h), normal, a, normal.norm() / 2);
      if (!mesh.is_boundary(mesh.opposite_halfedge_handle(h))) continue;
      for (const auto v : {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)})
        add_plane(v, (b - a) % normal, a, (b - a).sqrnorm());
    }
  }

  float collapse_priority(const typename Base::CollapseInfo& collapse) override {
    const Halfedges& mesh = Base::mesh();
    for (auto it = mesh.cvoh_iter(collapse.v0); it.is_valid(); ++it) {
      if (mesh.is_boundary(*it)) continue;
      const auto v = mesh.to_vertex_handle(*it), w = mesh.opposite_vh(*it);
      if (v == collapse.v1 || w == collapse.v1) continue;
      const Point &p = mesh.point(v), &q = mesh.point(w);
      const Point before = (p - collapse.p0) % (q - collapse.p0), after = (p - collapse.p1) % (q - collapse.p1);
      const double longest = std::max({(p - q).sqrnorm(), (p - collapse.p1).sqrnorm(), (q - collapse.p1).sqrnorm()});
      if (after.norm() < flattest * longest) return Base::ILLEGAL_COLLAPSE;
      if (before.norm() >= flattest * longest && (before | after) < least_turn_cosine * before.norm() * after.norm())
        return Base::ILLEGAL_COLLAPSE;
    }
    Quadric both = quadrics_[index(collapse.v0)];
    both += quadrics_[index(collapse.v1)];
    return static_cast<float>(std::max(0.0, both(collapse.p1)));
  }

  void postprocess_collapse(const typename Base::CollapseInfo& collapse) override {
    quadrics_[index(collapse.v1)] += quadrics_[index(collapse.v0)];
  }

 private:
  static constexpr double flattest = 1e-6;          // twice the area over the longest side squared
  static constexpr double least_turn_cosine = 0.3;  // 72 degrees

  static std::size_t index(Halfedges::VertexHandle v) { return static_cast<std::size_t>(v.idx()); }

  void add_plane(Halfedges::VertexHandle v, const Point& normal, const Point& through, double weight) {
    const double length = normal.norm();
    if (!(length > 0)) return;
    Quadric plane(normal / length, through);
    plane *= weight;
    quadrics_[index(v)] += plane;
  }

  std::vector<Quadric> quadrics_;
};

Halfedges to_halfedges(const MeshView& mesh, double scale) {
  Halfedges result;
  result.reserve(mesh.positions.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  // About the centre and in units of the box: priorities are single numbers of ordinary size.
  for (const Vec3& p : mesh.positions) {
    const Vec3 q = (p - mesh.box.center) / scale;
    result.add_vertex(Point(q.x(), q.y(), q.z()));
  }
  for (const Triangle& t : mesh.triangles)
    result.add_face(Halfedges::VertexHandle(static_cast<int>(t[0])), Halfedges::VertexHandle(static_cast<int>(t[1])),
                    Halfedges::VertexHandle(static_cast<int>(t[2])));
  return result;
}

class Cancelling final : public OpenMesh::Decimater::Observer {
 public:
  explicit Cancelling(const Context& context) : Observer(1024), context_(context) {}
  void notify(std::size_t) override {}
  bool abort() const override { return context_.cancelled(); }

 private:
  const Context& context_;
};

class Decimate final : public MeshFilter {
 public:
  explicit Decimate(const Options& options) : faces_(static_cast<std::size_t>(options.integer("faces"))) {}

  void apply(const MeshView& mesh, Context& context, MeshSink& sink) const override {
    if (faces_ >= mesh.triangles.size()) return;
    opposite_half_edges(mesh);  // refuses what OpenMesh cannot hold
    Halfedges halfedges = to_halfedges(mesh, mesh.box.diagonal());
    OpenMesh::Decimater::DecimaterT<Halfedges> decimater(halfedges);
    QuadricModule<Halfedges>::Handle module;
    decimater.add(module);
    decimater.initialize();
    Cancelling cancelling(context);
    decimater.set_observer(&cancelling);
    decimater.decimate_to_faces(0, faces_);

    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Index> kept;  // per new vertex, that of the input
    std::vector<Index> number(halfedges.n_vertices(), no_index);
    for (const auto f : halfedges.faces()) {
      Triangle triangle;
      std::size_t corner = 0;
      for (const auto v : halfedges.fv_range(f)) {
        const auto old = static_cast<std::size_t>(v.idx());
        if (number[old] == no_index) {
          number[old] = static_cast<Index>(positions.size());
          positions.push_back(mesh.positions[old]);
          kept.push_back(static_cast<Index>(old));
        }
        triangle[corner++] = number[old];
      }
      triangles.push_back(triangle);
    }
    if (triangles.size() > faces_ + 1)
      context.log(LogLevel::warning, "decimate: stopped at " + std::to_string(triangles.size()) + " faces, not " +
                                         std::to_string(faces_) +
                                         "; any further collapse would change the topology or turn a face over");
    sink.set(positions, triangles, nearest_faces(mesh, positions, triangles, context), kept);
  }

 private:
  std::size_t faces_;
};

constexpr OptionSpec options[] = {
    {"faces", OptionType::integer, "", "", "1", "100000000", "number of faces that is aimed at; fewer are left alone"},
};

}  // namespace

TOPOSCOPE_PLUGIN(MeshFilter, Decimate,
                 {.id = "decimate",
                  .version = "1.0.0",
                  .summary = "Fewer faces with the least quadric error",
                  .citation = "Garland and Heckbert, Surface simplification using quadric error metrics, SIGGRAPH 1997",
                  .options = options})
