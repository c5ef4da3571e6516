// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/errors.h"
#include "base/run_context.h"
#include "mesh_trial.h"
#include "pipeline/filters.h"

namespace toposcope {
namespace {

struct RawMesh final : MeshSink, MeshFilter {
  void set(std::span<const Vec3> p, std::span<const Triangle> t, std::span<const Index> faces,
           std::span<const Index> vertices) override {
    given = true;
    positions.assign(p.begin(), p.end());
    triangles.assign(t.begin(), t.end());
    face_origin.assign(faces.begin(), faces.end());
    vertex_origin.assign(vertices.begin(), vertices.end());
  }
  /// Gives it to the kernel's own check.
  void apply(const MeshView&, Context&, MeshSink& sink) const override {
    if (given) sink.set(positions, triangles, face_origin, vertex_origin);
  }
  bool given = false;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<Index> face_origin, vertex_origin;
};

/// What of a mesh rotation, translation and order of the vertices leave alone.
struct Size {
  double faces = 0, area = 0, reach = 0;  ///< reach: root mean square distance of the surface from its centre
};

Size size_of(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  Size size;
  size.faces = static_cast<double>(triangles.size());
  Vec3 center = Vec3::Zero();
  const auto visit = [&](const auto& body) {
    for (const Triangle& t : triangles) {
      const Vec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
      body((b - a).cross(c - a).norm() / 2, Vec3((a + b + c) / 3));
    }
  };
  visit([&](double area, const Vec3& middle) { size.area += area, center += area * middle; });
  center /= size.area;
  double squares = 0;
  visit([&](double area, const Vec3& middle) { squares += area * (middle - center).squaredNorm(); });
  size.reach = std::sqrt(squares / size.area);
  return size;
}

class FilterTrial final : public MeshTrial {
 public:
  using MeshTrial::MeshTrial;

  Answer run(const void* object, const Options&, Context& context) const override {
    auto raw = std::make_shared<RawMesh>();
    static_cast<const MeshFilter*>(object)->apply(view(), context, *raw);
    Answer answer;
    append_bytes(answer.bytes, raw->given);
    for (const Vec3& p : raw->positions) append_bytes(answer.bytes, std::array{p.x(), p.y(), p.z()});
    append_bytes(answer.bytes, raw->triangles);
    append_bytes(answer.bytes, raw->face_origin);
    append_bytes(answer.bytes, raw->vertex_origin);
    answer.flaw = flaw(*raw);
    answer.value = std::move(raw);
    return answer;
  }

  std::unique_ptr<Trial> moved(const Motion& motion) const override {
    return std::make_unique<FilterTrial>(name, toposcope::moved(soup(), motion), Poison::none);
  }

  std::string change(const Answer& before, const Answer& after, const Motion& motion) const override {
    const Size first = measured(before, 1), second = measured(after, motion.scale);
    const auto compare = [&](const char* what, double a, double b, double tolerance) {
      if (std::abs(a - b) <= tolerance * a) return std::string();
      return fmt::format("on {}, {} is {:.6g}, and {:.6g} in the other; at most {:g} % may differ", name, what, a, b,
                         100 * tolerance);
    };
    // Ties are broken otherwise, so the mesh is another; the surface must be the same.
    std::string different = compare("the number of faces", first.faces, second.faces, 0.05);
    if (different.empty()) different = compare("the area, in the input's unit,", first.area, second.area, 0.01);
    if (different.empty()) different = compare("the reach, in the input's unit,", first.reach, second.reach, 0.01);
    return different;
  }

 private:
  std::string flaw(const RawMesh& raw) const {
    const FilterStation station{"", {&raw, [](const MeshFilter*) {}}};
    RunContext quiet({.threads = 1});
    try {
      Mesh input(soup(), name);
      apply_filters(input, {&station, 1}, quiet);
    } catch (const PluginError& error) {
      return std::string(error.what()).substr(std::string("plugin '': ").size());
    } catch (const MeshError& error) {
      return error.what();
    }
    return "";
  }

  Size measured(const Answer& answer, double scale) const {
    const auto& raw = *static_cast<const RawMesh*>(answer.value.get());
    // A filter that gives no mesh leaves the input as it is, and the moved input is of the other scale.
    if (!raw.given) return size_of(soup().positions, soup().triangles);
    Size size = size_of(raw.positions, raw.triangles);
    size.area /= scale * scale;
    size.reach /= scale;
    return size;
  }
};

}  // namespace

TrialSet filter_trials(const PluginManifest&) {
  TrialSet set = mesh_trials([](std::string name, TriangleSoup soup, Poison poison) -> std::unique_ptr<Trial> {
    return std::make_unique<FilterTrial>(std::move(name), std::move(soup), poison);
  });
  set.nan_may_pass = true;
  return set;
}

}  // namespace toposcope
