// SPDX-License-Identifier: BSD-3-Clause
// A sphere by linear least squares: |p|^2 = 2 c.p + (r^2 - |c|^2) in the unknowns c and r^2 - |c|^2.
#include <Eigen/LU>
#include <cmath>

#include "toposcope/plugin.h"

namespace {
using namespace toposcope;
struct Fitter final : ShapeFitter {
  explicit Fitter(const Options& options) : min_points(options.integer("min_points")) {}

  FittedShape fit(const FitInput& input, const Options&, Context&) const override {
    FittedShape shape;
    shape.summary = {Termination::degenerate, "too few points, or they lie in a plane", 0, 0, 0};
    const auto count = static_cast<double>(input.points.size());
    if (count < min_points || !(input.mean_edge > 0)) return shape;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& point : input.points) mean += point / count;
    // About the mean and in units of the points' box: the system is well scaled wherever the mesh stands.
    const double unit = input.box.diagonal();
    Eigen::Matrix<double, 4, 5> system = Eigen::Matrix<double, 4, 5>::Zero();
    for (const Vec3& point : input.points) {
      const Vec3 p = (point - mean) / unit;
      const Eigen::Vector<double, 5> row(2 * p.x(), 2 * p.y(), 2 * p.z(), 1, p.squaredNorm());
      system += row.head<4>() * row.transpose() / count;
    }
    const auto solver = Eigen::FullPivLU<Eigen::Matrix4d>(system.leftCols<4>()).setThreshold(1e-9);
    if (!solver.isInvertible()) return shape;
    const Eigen::Vector4d solved = solver.solve(system.col(4));
    const double radius = unit * std::sqrt(solved[3] + solved.head<3>().squaredNorm());
    const Vec3 c = shape.centroid = mean + unit * solved.head<3>();
    shape.parameters = {{"center", 3, {c.x(), c.y(), c.z()}}, {"radius", 1, {radius}}};
    double squares = 0, area = 0;
    for (const Vec3& point : input.points) squares += std::pow(distance(shape, point), 2);
    for (const double each : input.areas) area += each;
    shape.rms = std::sqrt(squares / count);
    shape.measures = {{"radius", radius, shape.rms / std::sqrt(count)}};
    shape.explained = std::sqrt(area) / input.mean_edge;
    shape.summary = {Termination::closed_form, "", 0, squares / 2, squares / 2};
    return shape;
  }
  double distance(const FittedShape& shape, const Vec3& point) const override {
    return std::abs((point - shape.centroid).norm() - shape.parameter("radius")->values[0]);
  }
  int min_points;
};

const OptionSpec options[] = {{"min_points", OptionType::integer, "", "10", "4", "", "fewer points are not fitted"}};
const ProvidedName measures[] = {{"radius", 1, "radius of the sphere"}};
}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, Fitter,
                 {.id = "@ID@",
                  .version = "0.1.0",
                  .summary = "A sphere by linear least squares",
                  .min_arity = 1,
                  .dimension = 2,
                  .options = options,
                  .provides = measures})
