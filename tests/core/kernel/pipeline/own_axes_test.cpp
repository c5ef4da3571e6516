// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/own_axes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "mesh/mesh.h"
#include "model/read_model.h"
#include "support/meshes.h"

namespace toposcope {
namespace {

/// A chair: what is back of the seat, what is up, and two arms.
const Model& chair() {
  static const Model model = model_from_text(R"(schema: toposcope.model/1
name: chair
objects: {chair: volume, seat: volume, back: volume, leftArm: volume, rightArm: volume, frame: volume}
parts: {chair: [seat, back, leftArm, rightArm, frame]}
associations:
  - {from: back, back: seat, up: frame}
  - {from: leftArm, left: rightArm}
features:
  sitting: {realises: seat, worksets: [planar], shape: plane}
  leaning: {realises: back, worksets: [planar], shape: plane}
  left: {realises: leftArm, worksets: [convex], shape: circle}
  right: {realises: rightArm, worksets: [convex], shape: circle}
axes:
  up: [sitting]
)",
                                             "chair.yaml", nullptr);
  return model;
}

FittedShape shape_at(const Vec3& centroid, double sd = 0.01) {
  FittedShape shape;
  shape.centroid = centroid;
  shape.centroid_sd = sd;
  return shape;
}

/// x to the right, y to the front, z up; the seat's normal points down, and the back leans.
struct Chair {
  Chair() : shapes{shape_at({0, 0, 5}), shape_at({0.1, -4, 8}), shape_at({-3, 0, 6}), shape_at({3, 0, 6})} {
    shapes[0].orientation = Orientation::plane_like;
    shapes[0].direction = Vec3(0, 0.02, -1).normalized();
    shapes[0].direction_sd = 0.01;
  }
  OwnAxes axes() const {
    std::vector<const FittedShape*> found;
    for (std::size_t i = 0; i < shapes.size(); ++i) found.push_back(missing[i] ? nullptr : &shapes[i]);
    return own_axes(chair(), found, middle);
  }
  void turn(const Eigen::Matrix3d& matrix) {
    for (FittedShape& shape : shapes) {
      shape.centroid = matrix * shape.centroid;
      shape.direction = matrix * shape.direction;
    }
    middle.point = matrix * middle.point;
  }
  std::vector<FittedShape> shapes;
  std::vector<bool> missing = {false, false, false, false};
  Place middle{Vec3(0, 0, 4), 0.5};
};

TEST(OwnAxes, AreThoseOfTheWords) {
  const OwnAxes axes = Chair().axes();
  ASSERT_TRUE(axes.up && axes.front && axes.right);
  EXPECT_NEAR(axes.up->direction.z(), 1, 1e-3);
  EXPECT_NEAR(axes.front->direction.y(), 1, 1e-2);
  EXPECT_NEAR(axes.right->direction.x(), 1, 1e-2);
  EXPECT_GT(right_handed(axes).value(), 0.999);
  EXPECT_NEAR(axes.up->direction.dot(axes.right->direction), 0, 1e-12);
  EXPECT_NEAR(axes.front->direction.dot(axes.right->direction), 0, 1e-12);
}

TEST(OwnAxes, TurnWithTheObjectAndAMirrorImageIsLeftHanded) {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  Chair turned;
  const OwnAxes before = turned.axes();
  turned.turn(turn);
  const OwnAxes after = turned.axes();
  EXPECT_NEAR((after.up->direction - turn * before.up->direction).norm(), 0, 1e-12);
  EXPECT_NEAR((after.right->direction - turn * before.right->direction).norm(), 0, 1e-12);
  EXPECT_NEAR(right_handed(after).value(), right_handed(before).value(), 1e-12);
  Chair mirrored;
  mirrored.turn(Vec3(-1, 1, 1).asDiagonal());
  EXPECT_NEAR(right_handed(mirrored.axes()).value(), 1 - right_handed(before).value(), 1e-12);
  Chair renamed;
  std::swap(renamed.shapes[2], renamed.shapes[3]);
  EXPECT_LT(right_handed(renamed.axes()).value(), 0.001);
}

TEST(OwnAxes, WhatIsNotFoundTellsNothing) {
  Chair chair;
  chair.missing = {false, true, false, false};
  EXPECT_FALSE(chair.axes().front);
  EXPECT_FALSE(chair.axes().up) << "the frame is nothing to look for, and the back was not found";
  EXPECT_FALSE(right_handed(chair.axes()));
  chair.missing = {false, false, true, true};
  EXPECT_FALSE(chair.axes().right);
  EXPECT_TRUE(chair.axes().up);
}

TEST(OwnAxes, WhatIsLevelIsUncertain) {
  Chair chair;
  chair.shapes[1].centroid.z() = chair.middle.point.z() + 0.05;  // a tenth of the middle's deviation
  const double p = right_handed(chair.axes()).value();
  EXPECT_GT(p, 0.5);
  EXPECT_LT(p, 0.65);
}

/// Without a normal to go by, up is known to within 45 degrees alone.
TEST(OwnAxes, AnAxisOfItsAssociationsAloneIsLessCertain) {
  Chair chair;
  const double named = right_handed(chair.axes()).value();
  chair.shapes[0].orientation = Orientation::none;
  const OwnAxes axes = chair.axes();
  ASSERT_TRUE(axes.up);
  EXPECT_GT(axes.up->direction.z(), 0);
  EXPECT_LT(right_handed(axes).value(), named);
}

TEST(OwnAxes, TheMiddleIsThatOfTheSurface) {
  const Mesh torus(test::make_torus(2, 0.6, 40, 20), "torus");
  const Place middle = middle_of(torus.view());
  EXPECT_NEAR(middle.point.norm(), 0, 1e-9);
  EXPECT_NEAR(middle.sd, torus.view().box.c() / 6.928, 1e-3);
}

}  // namespace
}  // namespace toposcope
