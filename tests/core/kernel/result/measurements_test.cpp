// SPDX-License-Identifier: BSD-3-Clause
#include "result/measurements.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "support/meshes.h"
#include "toposcope/geometry/lines.h"

namespace toposcope {
namespace {

using Matrix = Eigen::MatrixXd;

Model model_of(const std::vector<std::string>& expressions) {
  Model model;
  for (const char* name : {"a", "b", "c"}) {
    ModelFeature& feature = model.features.emplace_back();
    feature.name = name;
  }
  for (const std::string& text : expressions)
    model.measures.push_back(
        {text, MeasureExpression::parse(text, {"m.yaml", 1, 1}, model.features, nullptr), {"m.yaml", 1, 1}});
  return model;
}

/// A covariance of `size` parameters, of standard deviations about `sd`.
Matrix some_covariance(Eigen::Index size, double sd, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Matrix root = Matrix::NullaryExpr(size, size, [&] { return sd * normal(random) / std::sqrt(double(size)); });
  return root * root.transpose();
}

void set_covariance(FittedShape& shape, const Matrix& covariance) {
  shape.covariance.assign(covariance.data(), covariance.data() + covariance.size());
}

/// Tilts of a direction are as covariances of fits have them: across it.
Matrix across(Matrix covariance, const Vec3& direction, Eigen::Index first) {
  const Eigen::Matrix3d projection = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  Matrix all = Matrix::Identity(covariance.rows(), covariance.cols());
  all.block<3, 3>(first, first) = projection;
  return all * covariance * all.transpose();
}

FittedShape circle(const Vec3& center, const Vec3& normal, double radius, const Matrix& covariance) {
  FittedShape shape;
  const Vec3 n = normal.normalized();
  shape.parameters = {{"center", 3, {center.x(), center.y(), center.z()}},
                      {"normal", 3, {n.x(), n.y(), n.z()}},
                      {"radius", 1, {radius}}};
  shape.measures = {{"radius", radius, std::sqrt(covariance(6, 6))}, {"coverage", 0.5, 0.01}};
  shape.covariance_of = {"center.x", "center.y", "center.z", "normal.x", "normal.y", "normal.z", "radius"};
  set_covariance(shape, across(covariance, n, 3));
  shape.orientation = Orientation::plane_like;
  shape.direction = n;
  shape.centroid = center;
  return shape;
}

FittedShape plane(const Vec3& point, const Vec3& normal, double sd = 0, double tilt = 0) {
  FittedShape shape;
  const Vec3 n = normal.normalized();
  shape.parameters = {{"point", 3, {point.x(), point.y(), point.z()}}, {"normal", 3, {n.x(), n.y(), n.z()}}};
  shape.covariance_of = {"point.x", "point.y", "point.z", "normal.x", "normal.y", "normal.z"};
  Matrix covariance = Matrix::Zero(6, 6);
  covariance.topLeftCorner<3, 3>() = sd * sd * n * n.transpose();
  covariance.bottomRightCorner<3, 3>() = tilt * tilt * (Eigen::Matrix3d::Identity() - n * n.transpose());
  set_covariance(shape, covariance);
  shape.orientation = Orientation::plane_like;
  shape.direction = n;
  shape.direction_sd = tilt;
  shape.centroid = point;
  shape.centroid_sd = sd / std::sqrt(3.0);
  return shape;
}

/// Moves the parameters of a circle by a normal deviate of its covariance.
FittedShape drawn(const FittedShape& shape, std::mt19937_64& random) {
  const Matrix covariance = Eigen::Map<const Matrix>(shape.covariance.data(), 7, 7);
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(covariance);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd unit = Eigen::VectorXd::NullaryExpr(7, [&] { return normal(random); });
  const Eigen::VectorXd move =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().cwiseProduct(unit).eval();
  return circle(shape.centroid + move.head<3>(), shape.direction + move.segment<3>(3),
                shape.measures[0].value + move[6], covariance);
}

double value_of(const std::string& expression, const std::vector<const FittedShape*>& shapes) {
  const Measurements measured = measure(model_of({expression}), shapes, Box{});
  EXPECT_EQ(measured.all[0].why, "");
  return measured.all[0].value;
}

TEST(Measurements, AreTheQuantitiesOfKnownShapes) {
  const FittedShape top = plane({1, 2, 5}, Vec3::UnitZ()), floor = plane({-7, 3, 1}, -Vec3::UnitZ());
  const Matrix exact = Matrix::Zero(7, 7);
  const FittedShape ring = circle({4, 0, 0}, {0, 1, 1}, 2, exact);
  const std::vector<const FittedShape*> shapes = {&top, &floor, &ring};
  EXPECT_NEAR(value_of("distance(a, b)", shapes), 4, 1e-12) << "of planes: across them";
  EXPECT_NEAR(value_of("distance(a, c)", shapes), 5, 1e-12) << "a plane counts as all of it";
  EXPECT_NEAR(value_of("distance(c, b)", shapes), 1, 1e-12);
  EXPECT_NEAR(value_of("along(a, b, c)", shapes), 1, 1e-12);
  EXPECT_NEAR(value_of("across(a, b, c)", shapes), std::hypot(11, 3), 1e-12);
  EXPECT_NEAR(value_of("angle(a, c)", shapes), 45, 1e-9);
  EXPECT_NEAR(value_of("angle(a, b)", shapes), 0, 1e-9) << "normals have no sign";
  EXPECT_NEAR(value_of("ratio(c.radius, distance(a, b))", shapes), 0.5, 1e-12);
  EXPECT_NEAR(value_of("pi * c.radius * c.radius", shapes), 4 * pi, 1e-12);
  EXPECT_NEAR(value_of("max(c.radius, distance(a, b)) - min(1, 2) * c.radius", shapes), 2, 1e-12);
}

TEST(Measurements, LinesMakeAnglesWithPlanesByTheirTilt) {
  const FittedShape floor = plane(Vec3::Zero(), Vec3::UnitZ());
  FittedShape axis;
  axis.orientation = Orientation::line_like;
  axis.direction = Vec3(0, std::cos(0.3), std::sin(0.3));
  EXPECT_NEAR(value_of("angle(a, b)", {&floor, &axis, nullptr}), 0.3 * 180 / pi, 1e-9);
}

TEST(Measurements, DeviationsAndCovariancesAreThoseOfMonteCarlo) {
  std::mt19937_64 random(7);
  const FittedShape first = circle({1, 2, 3}, {1, 2, -1}, 2, some_covariance(7, 0.01, random));
  const FittedShape second = circle({-2, 0, 1}, {0, 1, 1}, 3, some_covariance(7, 0.01, random));
  const FittedShape third = circle({0, 4, 1.5}, {2, 1, 0}, 1, some_covariance(7, 0.02, random));
  const Model model =
      model_of({"distance(a, b)", "angle(a, b)", "along(a, b, c)", "across(a, b, c)", "ratio(a.radius, b.radius) + 1",
                "a.radius * c.radius / b.radius", "max(a.radius, b.radius)", "2 * distance(b, c) - b.radius"});
  const std::vector<const FittedShape*> shapes = {&first, &second, &third};
  const Measurements stated = measure(model, shapes, Box{});
  constexpr int draws = 20000;
  const auto n = static_cast<Eigen::Index>(model.measures.size());
  Matrix values(draws, n);
  for (int i = 0; i < draws; ++i) {
    const FittedShape a = drawn(first, random), b = drawn(second, random), c = drawn(third, random);
    const std::vector<const FittedShape*> moved = {&a, &b, &c};
    const Measurements one = measure(model, moved, Box{});
    for (Eigen::Index k = 0; k < n; ++k) values(i, k) = one.all[static_cast<std::size_t>(k)].value;
  }
  const Matrix centered = values.rowwise() - values.colwise().mean();
  const Matrix covariance = centered.transpose() * centered / (draws - 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_NEAR(stated.all[i].sd / std::sqrt(covariance(k, k)), 1, 0.03) << stated.all[i].name;
    for (Eigen::Index l = 0; l < n; ++l)
      EXPECT_NEAR(stated.between(i, static_cast<std::size_t>(l)) / std::sqrt(covariance(k, k) * covariance(l, l)),
                  covariance(k, l) / std::sqrt(covariance(k, k) * covariance(l, l)), 0.04)
          << stated.all[i].name << " and " << stated.all[static_cast<std::size_t>(l)].name;
  }
}

TEST(Measurements, OfOneShapeCountItsCovariance) {
  Matrix covariance = Matrix::Zero(7, 7);
  covariance(0, 0) = covariance(6, 6) = 0.04;
  covariance(0, 6) = covariance(6, 0) = -0.04;
  const FittedShape ring = circle({5, 0, 0}, Vec3::UnitZ(), 2, covariance);
  const FittedShape wall = plane(Vec3::Zero(), Vec3::UnitX());
  const Model model = model_of({"distance(a, b) + a.radius", "distance(a, b) - a.radius", "b.area"});
  const std::vector<const FittedShape*> shapes = {&ring, &wall, nullptr};
  const Measurements measured = measure(model, shapes, Box{});
  EXPECT_NEAR(measured.all[0].sd, 0, 1e-9) << "what the centre gains the radius loses";
  EXPECT_NEAR(measured.all[1].sd, 0.4, 1e-9);
}

TEST(Measurements, WhatTheCovarianceDoesNotNameMovesByItself) {
  FittedShape segment;
  segment.centroid = {3, 0, 0};
  segment.centroid_sd = 0.2;
  segment.orientation = Orientation::line_like;
  segment.direction = Vec3::UnitX();
  segment.direction_sd = 0.01;
  segment.measures = {{"length", 4, 0.3}};
  const FittedShape wall = plane(Vec3::Zero(), Vec3::UnitX(), 0.1);
  const Model model = model_of({"distance(a, b)", "a.length", "angle(a, b)"});
  const std::vector<const FittedShape*> shapes = {&segment, &wall, nullptr};
  const Measurements measured = measure(model, shapes, Box{});
  EXPECT_NEAR(measured.all[0].sd, std::hypot(0.2, 0.1), 1e-9);
  EXPECT_NEAR(measured.all[1].sd, 0.3, 1e-12);
  EXPECT_NEAR(measured.all[2].value, 90, 1e-9);
  EXPECT_GT(measured.all[2].sd, 0.3) << "0.01 rad are 0.57 degrees";
  EXPECT_EQ(measured.between(0, 1), 0);
}

TEST(Measurements, TheMiddleOfAPlaneIsUnsureAlongIt) {
  FittedShape floor = plane(Vec3::Zero(), Vec3::UnitZ(), 0.1);
  floor.centroid_sd = std::sqrt((0.1 * 0.1 + 2 * 0.5 * 0.5) / 3);
  const FittedShape ring = circle({3, 0, 4}, Vec3::UnitZ(), 1, Matrix::Zero(7, 7));
  const std::vector<const FittedShape*> shapes = {&floor, &ring, nullptr};
  const Measurements measured = measure(model_of({"distance(a, b)", "across(b, a, b)"}), shapes, Box{});
  EXPECT_NEAR(measured.all[0].sd, 0.1, 1e-9);
  EXPECT_NEAR(measured.all[1].value, 3, 1e-12);
  EXPECT_NEAR(measured.all[1].sd, 0.5, 1e-9);
}

TEST(Measurements, WithoutAFeatureThereIsNoValueButTheOthersStay) {
  const FittedShape floor = plane(Vec3::Zero(), Vec3::UnitZ()), top = plane({0, 0, 2}, Vec3::UnitZ());
  const Model model = model_of({"distance(a, b)", "distance(a, c)", "a.radius", "ratio(distance(a, b), bb(O).c)"});
  const std::vector<const FittedShape*> shapes = {&floor, &top, nullptr};
  const Measurements measured = measure(model, shapes, Box{});
  EXPECT_EQ(measured.all[0].why, "");
  EXPECT_EQ(measured.all[1].why, "'c' is missing");
  EXPECT_EQ(measured.all[2].why, "the shape of 'a' has no measure 'radius'");
  EXPECT_NE(measured.all[3].why, "") << "division by a side of 0";
  EXPECT_EQ(measured.covariance.size(), 16U);
}

TEST(Measurements, PoseDoesNotMatter) {
  std::mt19937_64 random(3);
  const Matrix zero = Matrix::Zero(7, 7);
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Eigen::Matrix3d turn = test::random_rotation(seed);
    const auto at = [&](const Vec3& x) { return Vec3(turn * x + Vec3(5, -3, 8)); };
    const FittedShape floor = plane(at({1, 1, 0}), turn * Vec3(0, 0.1, 1), 0.1, 0.02);
    const FittedShape ring = circle(at({0, 2, 3}), turn * Vec3(1, 0, 1), 2, zero);
    const std::vector<const FittedShape*> shapes = {&floor, &ring, nullptr};
    const Measurements there = measure(model_of({"distance(a, b)", "angle(a, b)", "across(a, a, b)"}), shapes, Box{});
    const FittedShape floor0 = plane({1, 1, 0}, Vec3(0, 0.1, 1), 0.1, 0.02);
    const FittedShape ring0 = circle({0, 2, 3}, Vec3(1, 0, 1), 2, zero);
    const std::vector<const FittedShape*> shapes0 = {&floor0, &ring0, nullptr};
    const Measurements here = measure(model_of({"distance(a, b)", "angle(a, b)", "across(a, a, b)"}), shapes0, Box{});
    for (std::size_t i = 0; i < here.all.size(); ++i) {
      EXPECT_NEAR(there.all[i].value, here.all[i].value, 1e-9);
      EXPECT_NEAR(there.all[i].sd, here.all[i].sd, 1e-9);
    }
  }
}

}  // namespace
}  // namespace toposcope
