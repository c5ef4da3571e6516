// SPDX-License-Identifier: BSD-3-Clause
#include "result/shape_causes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "toposcope/geometry/lines.h"

namespace toposcope {
namespace {

using Matrix = Eigen::MatrixXd;

/// L with L L' = C; what rounding made negative is 0.
Matrix root_of(const FittedShape& shape) {
  const auto n = static_cast<Eigen::Index>(shape.covariance_of.size());
  if (n == 0) return Matrix(0, 0);
  const Matrix covariance =
      Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(shape.covariance.data(), n, n);
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

class Shape {
 public:
  Shape(const FittedShape& shape, Eigen::Index first) : shape_(shape), first_(first), root_(root_of(shape)) {}

  UncertainShape uncertain() {
    UncertainShape made;
    made.shape = &shape_;
    made.orientation = shape_.orientation;
    made.is_plane = shape_.orientation == Orientation::plane_like && shape_.parameter("point");
    next_ = first_ + root_.cols();
    made.centroid = centroid();
    if (shape_.orientation != Orientation::none) made.direction = direction();
    for (const Measure& measure : shape_.measures) {
      const auto known = row(measure.name);
      made.measures.emplace(measure.name, known ? parameter(measure.value, *known) : alone(measure.value, measure.sd));
    }
    return made;
  }

  Eigen::Index end() const { return next_; }

 private:
  std::optional<Eigen::Index> row(const std::string& name) const {
    const auto& names = shape_.covariance_of;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<Eigen::Index>(found - names.begin());
  }

  Dual parameter(double value, Eigen::Index row) const {
    Dual dual{value, Eigen::VectorXd::Zero(first_ + root_.cols())};
    dual.by.tail(root_.cols()) = root_.row(row);
    return dual;
  }

  /// Moved by a cause of its own.
  Dual alone(double value, double sd) {
    if (!(sd > 0)) return {value, {}};
    Dual dual{value, Eigen::VectorXd::Zero(++next_)};
    dual.by[next_ - 1] = sd;
    return dual;
  }

  /// Of a point or direction that the covariance names; nothing where it does not.
  std::optional<DualVector> named(const std::string& name, const Vec3& value) const {
    const ShapeParameter* given = shape_.parameter(name);
    const auto x = row(name + ".x"), y = row(name + ".y"), z = row(name + ".z");
    if (!given || given->values.size() != 3 || !x || !y || !z) return std::nullopt;
    if ((Vec3(given->values.data()) - value).norm() > 1e-9 * (1 + value.norm())) return std::nullopt;
    return DualVector{parameter(value.x(), *x), parameter(value.y(), *y), parameter(value.z(), *z)};
  }

  DualVector centroid() {
    const Vec3& c = shape_.centroid;
    for (const char* name : {"center", "point"})
      if (std::optional<DualVector> known = named(name, c)) return with_spread(*std::move(known));
    return moved(DualVector{{c.x(), {}}, {c.y(), {}}, {c.z(), {}}}, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()},
                 shape_.centroid_sd);
  }

  /// The middle of a plane's points lies less sure in the plane, that of a cylinder's along its axis, than the shape.
  DualVector with_spread(DualVector known) {
    const double more =
        3 * shape_.centroid_sd * shape_.centroid_sd - (known.x.variance() + known.y.variance() + known.z.variance());
    const Vec3& n = shape_.direction;
    if (!(more > 0) || shape_.orientation == Orientation::none) return known;
    if (shape_.orientation == Orientation::line_like) return moved(std::move(known), {n}, std::sqrt(more));
    const Vec3 u = any_perpendicular(n);
    return moved(std::move(known), {u, n.cross(u)}, std::sqrt(more / 2));
  }

  DualVector direction() {
    const Vec3& n = shape_.direction;
    for (const char* name : {"normal", "axis"})
      if (std::optional<DualVector> known = named(name, n)) return *std::move(known);
    const Vec3 u = any_perpendicular(n);
    return moved(DualVector{{n.x(), {}}, {n.y(), {}}, {n.z(), {}}}, {u, n.cross(u)}, shape_.direction_sd);
  }

  /// By independent causes along the ways given.
  DualVector moved(DualVector place, const std::vector<Vec3>& ways, double sd) {
    if (!(sd > 0)) return place;
    for (const Vec3& way : ways) {
      ++next_;
      Dual* const components[] = {&place.x, &place.y, &place.z};
      for (Eigen::Index k = 0; k < 3; ++k) {
        Dual& component = *components[k];
        component.by.conservativeResizeLike(Eigen::VectorXd::Zero(next_));
        component.by[next_ - 1] = sd * way[k];
      }
    }
    return place;
  }

  const FittedShape& shape_;
  Eigen::Index first_, next_ = 0;
  Matrix root_;
};

}  // namespace

UncertainShape Causes::add(const FittedShape& shape) {
  Shape made(shape, count_);
  UncertainShape result = made.uncertain();
  count_ = made.end();
  return result;
}

void Causes::finish(UncertainShape& shape) const {
  const auto lengthen = [&](Dual& dual) {
    if (dual.by.size() > 0) dual.by.conservativeResizeLike(Eigen::VectorXd::Zero(count_));
  };
  for (DualVector* vector : {&shape.centroid, &shape.direction})
    for (Dual* component : {&vector->x, &vector->y, &vector->z}) lengthen(*component);
  for (auto& [name, dual] : shape.measures) lengthen(dual);
}

}  // namespace toposcope
