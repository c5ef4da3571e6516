// SPDX-License-Identifier: BSD-3-Clause
#include "core/kernel/io/mesh_files.h"

namespace toposcope {
namespace {

using test::expect_square, test::read_text, test::refusal, test::says;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, AllFormsOfCorners) {
  for (const char* face : {"f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//1 2//1 3//1 4//1", "f 1/1/1 2/2/1 3/3/1 4/4/1",
                           "f -4 -3 -2 -1", "f 1 -3 +3 -1/5/6", "f\t1  2 \\\n 3 \\\r\n4 # the end"})
    expect_square(read_text(square + face, ".obj"));
}

TEST(ReadObj, CommentsKeywordsBlanksAndLineEnds) {
  expect_square(
      read_text("# v 9 9 9\r\nmtllib none.mtl\r\no part\r\n\r\nv 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\n  v 1 1 .0\r\n"
                "v 0 1. 0\r\nvt 0 0\r\nvn 0 0 1\r\ng f v\r\nusemtl a b\r\ns off\r\nl 1 2\r\np 1\r\nf 1 2 3 4",
                ".OBJ"));
}

TEST(ReadObj, WeightsAndColoursBehindTheCoordinates) {
  expect_square(
      read_text("v 0 0 0 1\nv 1 0 0 0.25 0.5 1.0\nv 1 1 0 255 0 0 255\nV 0 1 0 nan\nF 1 2 3\nfo 1 3 4", ".obj"));
}

TEST(ReadObj, FacesMayComeBeforeTheirVertices) {
  expect_square(read_text("f 1 2 3 4\n" + square, ".obj"));
}

TEST(ReadObj, NegativeIndicesCountFromThePlaceOfTheFace) {
  const TriangleSoup soup = read_text(square + "f -4 -3 -2\nv 5 5 5\nf -4 -3 -1\n", ".obj");
  EXPECT_EQ(soup.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(soup.triangles[1], (Triangle{1, 2, 4}));
}

TEST(ReadObj, ConcaveAndLongQuadsAreCutTheOtherWay) {
  // Corner 1 lies within the triangle of the others: the cut from 0 to 2 would fold.
  const TriangleSoup arrow = read_text("v 0 0 0\nv 1 1 0\nv 0 4 0\nv 4 0 0\nf 1 2 3 4\n", ".obj");
  EXPECT_EQ(arrow.triangles[0], (Triangle{1, 2, 3}));
  const auto area = [&](const Triangle& t) {
    const Vec3 u = arrow.positions[t[1]] - arrow.positions[t[0]], v = arrow.positions[t[2]] - arrow.positions[t[0]];
    return u.x() * v.y() - u.y() * v.x();
  };
  EXPECT_LT(area(arrow.triangles[0]), 0);
  EXPECT_LT(area(arrow.triangles[1]), 0);
  const TriangleSoup kite = read_text("v 0 0 0\nv 4 -1 0\nv 9 0 0\nv 4 1 0\nf 1 2 3 4\n", ".obj");
  EXPECT_EQ(kite.triangles[0], (Triangle{1, 2, 3}));
  EXPECT_EQ(kite.triangles[1], (Triangle{1, 3, 0}));
}

TEST(ReadObj, ErrorsNameTheLine) {
  EXPECT_TRUE(says(refusal(square + "f 1 2 5\n", ".obj"), "mesh.obj:5: a face refers to vertex 4 (from 0)"));
  EXPECT_TRUE(says(refusal(square + "f 1 2 0\n", ".obj"), ":5: vertex index 0 does not exist"));
  EXPECT_TRUE(says(refusal(square + "f 1 2 -5\n", ".obj"), ":5: vertex index -5 does not exist"));
  EXPECT_TRUE(says(refusal(square + "f 1 2 x/1\n", ".obj"), "found 'x'"));
  EXPECT_TRUE(says(refusal(square + "f 1 2 99999999999999999999\n", ".obj"), "whole number"));
  EXPECT_TRUE(says(refusal(square + "f 1 2 99999999999\n", ".obj"), ":5: face 0"));
  EXPECT_TRUE(says(refusal("v 0 0\n" + square, ".obj"), ":1: a vertex needs three coordinates"));
  EXPECT_TRUE(says(refusal("v 0 0 1x\n", ".obj"), "found '1x'"));
  EXPECT_TRUE(says(refusal("\n\nv 0 nan 0\n", ".obj"), ":3: vertex 0"));
  EXPECT_TRUE(says(refusal(square, ".obj"), "no face"));
  EXPECT_TRUE(says(refusal(square + "f 1 2\nf\n", ".obj"), "no face with three corners"));
  EXPECT_TRUE(says(refusal("hello world\n", ".obj"), "no vertex"));
  EXPECT_TRUE(says(refusal("", ".obj"), "empty"));
}

}  // namespace
}  // namespace toposcope
