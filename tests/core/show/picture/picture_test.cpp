// SPDX-License-Identifier: BSD-3-Clause
// Pictures: the camera keeps things in the frame, near hides far, hollows are dark, the same at any thread count.

#include "picture/picture.h"

#include <gtest/gtest.h>
#include <png.h>

#include "base/errors.h"
#include "base/run_context.h"
#include "picture/sky_light.h"
#include "picture/stages.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "support/program.h"

namespace toposcope {
namespace {

constexpr Rgb red = {213, 94, 0}, blue = {0, 114, 178};

ShadedMesh solid_of(const TriangleSoup& soup, const Rgb& color) {
  ShadedMesh solid;
  solid.positions = soup.positions;
  solid.triangles = soup.triangles;
  solid.normals = corner_normals(soup.positions, soup.triangles);
  solid.triangle_colors.assign(soup.triangles.size(), color);
  return solid;
}

PictureStyle small_style(Background background = Background::white) {
  PictureStyle style = thumbnail_style(120, 90);
  style.background = background;
  return style;
}

const std::uint8_t* pixel(const Image& image, int x, int y) {
  return image.rgba.data() +
         4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
}

/// Whether it has the hue of red, that is more red than blue.
bool reddish(const std::uint8_t* p) {
  return p[0] > p[2] + 30;
}

TEST(Camera, FillsTheFrameButForAMargin) {
  for (const std::string text : {"iso", "front", "top", "bottom", "120,-30"}) {
    SCOPED_TRACE(text);
    const TriangleSoup box = test::make_box({3, 1, 2}, 4);
    for (const auto& [width, height] : {std::pair{400, 300}, std::pair{300, 500}}) {
      const Camera camera = camera_for(view_from(text), {}, box.positions, width, height);
      double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
      for (const Vec3& p : box.positions) {
        const Camera::Projected q = camera(p);
        EXPECT_GT(q.w, 0);
        left = std::min(left, q.x), right = std::max(right, q.x), top = std::min(top, q.y),
        bottom = std::max(bottom, q.y);
      }
      EXPECT_GE(left, 0.06 * width - 1e-6);
      EXPECT_LE(right, 0.94 * width + 1e-6);
      EXPECT_GE(top, 0.06 * height - 1e-6);
      EXPECT_LE(bottom, 0.94 * height + 1e-6);
      EXPECT_NEAR(std::min(0.88 * width - (right - left), 0.88 * height - (bottom - top)), 0, 1e-6);
    }
  }
}

TEST(Camera, SeesWhatTheViewIsNamedAfter) {
  const std::vector<Vec3> ball = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  const auto towards = [&](const std::string& text, const Stand& stand = {}) {
    return Vec3(camera_for(view_from(text), stand, ball, 100, 100).axes.row(2));
  };
  EXPECT_LT((towards("front") - Vec3(0, -1, 0)).norm(), 1e-12);
  EXPECT_LT((towards("back") - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((towards("right") - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((towards("left") - Vec3(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((towards("top") - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((towards("front", stand_from("y")) - Vec3(0, 0, 1)).norm(), 1e-12);
  for (const char* bad : {"", "iso2", "30", "30,100", "a,b", "nan,0"}) EXPECT_THROW(view_from(bad), UsageError) << bad;
  for (const char* bad : {"", "w", "+z", "zz"}) EXPECT_THROW(stand_from(bad), UsageError) << bad;
}

TEST(Picture, IsTheSameAtAnyThreadCount) {
  Composition composition;
  composition.surface = solid_of(test::make_torus(2, 0.7, 40, 20), red);
  const Camera camera = camera_for(view_from("iso"), {}, composition.surface.positions, 120, 90);
  const Image one = draw_picture(composition, camera, small_style(), test::context(1));
  const Image two = draw_picture(composition, camera, small_style(), test::context(2));
  EXPECT_EQ(one.rgba, two.rgba);
}

TEST(Picture, CoversTheObjectAlone) {
  Composition composition;
  composition.surface = solid_of(test::make_sphere(4), red);
  const Camera camera = camera_for(view_from("front"), {}, composition.surface.positions, 120, 90);
  for (const Background background : {Background::white, Background::dark, Background::transparent}) {
    const Image image = draw_picture(composition, camera, small_style(background), test::context());
    const std::uint8_t *corner = pixel(image, 0, 0), *middle = pixel(image, 60, 45);
    EXPECT_TRUE(reddish(middle));
    EXPECT_EQ(middle[3], 255);
    EXPECT_EQ(corner[3], background == Background::transparent ? 0 : 255);
    EXPECT_TRUE(background != Background::white || corner[0] == 255);
    EXPECT_TRUE(background != Background::dark || corner[0] < 40);
  }
  // Of a disk of 88 % of the height (a ball looks larger from near by than its equator).
  const Image image = draw_picture(composition, camera, small_style(Background::transparent), test::context());
  double covered = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) covered += image.rgba[i] / 255.0;
  EXPECT_NEAR(covered, pi * std::pow(0.44 * 90, 2), 0.02 * pi * std::pow(0.44 * 90, 2));
}

TEST(Picture, NearHidesFarAndHiddenLinesShineThrough) {
  Composition composition;
  composition.surface = solid_of(test::make_box({2, 2, 2}, 4), {214, 211, 206});
  const double radius = composition.line_radius = 0.06;
  const auto picture = [&](double y) {
    Drawing drawing;
    drawing.lines = {{Vec3(-0.8, y, 0), Vec3(0.8, y, 0)}};
    composition.lines = tubes(drawing, radius, blue);
    const Camera camera = camera_for(view_from("front"), {}, composition.surface.positions, 120, 90);
    return draw_picture(composition, camera, small_style(), test::context());
  };
  const auto blueness = [](const Image& image) { return pixel(image, 60, 45)[2] - pixel(image, 60, 45)[0]; };
  EXPECT_GT(blueness(picture(-1.2)), 90);  // before the box
  EXPECT_GT(blueness(picture(-1.0)), 90);  // in its face
  const int behind = blueness(picture(1.2));
  EXPECT_GT(behind, 5);
  EXPECT_LT(behind, 60);
}

/// A box there and so large, of one feature, with a line around it.
Scene box_scene(const Vec3& place, double size) {
  const TriangleSoup box = test::make_box({3, 1, 2}, 4);
  Scene scene;
  scene.features = {"rim"};
  for (const Vec3& p : box.positions) scene.input.positions.push_back(place + size * p);
  scene.input.triangles = box.triangles;
  scene.input.labels.assign(box.triangles.size(), 1);
  Drawing drawing;
  drawing.lines = {{place + size * Vec3(-1.5, -0.5, 1), place + size * Vec3(1.5, -0.5, 1)}};
  scene.found.push_back({"rim", drawing, 1});
  return scene;
}

TEST(Picture, IsTheSameWhereverAndHoweverLargeTheObjectIs) {
  RunContext context({.threads = 2});
  const auto picture = [&](const Vec3& place, double size) {
    const Scene scene = box_scene(place, size);
    return picture_of(scene, Stage::found, "", best_view(scene, {}), {}, small_style(), context);
  };
  const Image expected = picture(Vec3::Zero(), 1);
  const std::pair<Vec3, double> others[] = {
      {{500000, 5400000, 300}, 0.1}, {{0, 0, 0}, 1e39}, {{0, 0, 0}, 1e-70}, {{1e42, 0, 0}, 1e39}};
  for (const auto& [place, size] : others) {
    const Image image = picture(place, size);
    ASSERT_EQ(image.rgba.size(), expected.rgba.size());
    std::size_t other = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) other += std::abs(image.rgba[i] - expected.rgba[i]) > 24;
    EXPECT_LT(other, image.rgba.size() / 50) << size;
  }
}

TEST(Picture, OneCoordinateOutOfReachIsDrawnAllTheSame) {
  Scene scene = box_scene(Vec3::Zero(), 1);
  scene.normalised = scene.input;
  for (Vec3& p : scene.normalised->positions) p.z() += 1e39;
  RunContext context({.threads = 2});
  EXPECT_FALSE(picture_of(scene, Stage::mesh, "", {}, {}, small_style(), context).rgba.empty());
}

TEST(Stand, RefusesWhatIsNoModel) {
  Scene scene = box_scene(Vec3::Zero(), 1);
  for (const char* model : {R"({"features": {"rim": "x"}})", R"({"features": 1})", "[]",
                            R"({"features": {}, "associations": ["x"]})", R"({"features": {}, "parts": {"a": [1]}})"}) {
    scene.model = model;
    EXPECT_THROW(stand_of(scene), UsageError) << model;
  }
}

TEST(SkyLight, IsDarkInHollows) {
  // A box that is open above: its floor sees a part of the sky only.
  TriangleSoup box = test::make_box({2, 2, 2}, 8);
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return box.positions[t[0]].z() > 0.999 && box.positions[t[1]].z() > 0.999 && box.positions[t[2]].z() > 0.999;
  });
  const ShadedMesh solid = solid_of(box, red);
  const SkyLight light(solid, Eigen::Matrix3d::Identity(), 128, 128, test::context());
  const Eigen::Vector3f up(0, 0, 1);
  const float floor = light.at({0, 0, -1}, up), above = light.at({0, 0, 5}, up);
  EXPECT_NEAR(above, light.open(up), 1e-4F);
  EXPECT_LT(floor, 0.6F * above);
  EXPECT_GT(floor, 0.1F * above);
  // A convex thing hides nothing of itself.
  const SkyLight around(solid_of(test::make_sphere(4), red), Eigen::Matrix3d::Identity(), 128, 128, test::context());
  for (const Eigen::Vector3f& n :
       {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0.6F, -0.8F, 0), Eigen::Vector3f(0, 0, -1)})
    EXPECT_NEAR(around.at(n, n), around.open(n), 0.02F * around.open(n));
}

/// Half-planes about one edge, which fill the box over and over.
ShadedMesh fan_of(Index blades) {
  ShadedMesh fan;
  fan.positions = {Vec3(0, 0, -1), Vec3(0, 0, 1)};
  for (Index i = 0; i < blades; ++i) {
    const double angle = 2 * pi * i / blades;
    fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    fan.triangles.push_back({0, 1, i + 2});
  }
  return fan;
}

TEST(Picture, DrawsSoMuchAndNoMore) {
  const auto samples = [](ShadedMesh surface, int width, int height) {
    Composition composition;
    composition.surface = std::move(surface);
    PictureStyle style;
    style.width = width;
    style.height = height;
    return drawn_samples(composition, camera_for({}, {}, composition.surface.positions, width, height), style);
  };
  EXPECT_EQ(samples(solid_of(test::make_sphere(4), red), 1200, 900), 3);
  EXPECT_EQ(samples(fan_of(5000), 1200, 900), 1);
  EXPECT_EQ(samples(fan_of(5000), 120, 90), 3) << "small pictures can be afforded";
}

/// Maps together have no more pixels than can be drawn in seconds.
TEST(SkyLight, DrawsSoMuchAndNoMore) {
  const ShadedMesh sphere = solid_of(test::make_sphere(4), red);
  EXPECT_EQ(light_map_side(sphere, 192, 176), 176);
  constexpr Index blades = 5000;
  const ShadedMesh fan = fan_of(blades);
  const int side = light_map_side(fan, 192, 176);
  EXPECT_GE(side, 24);
  EXPECT_LE(192.0 * side * side * blades / 4, 6e8);  // each blade has a quarter of the box's square
  EXPECT_EQ(light_map_side({}, 192, 176), 176);
}

TEST(Png, IsReadByLibpng) {
  Image image{3, 2, {}};
  for (int i = 0; i < 24; ++i) image.rgba.push_back(static_cast<std::uint8_t>(i * 10));
  const std::string bytes = to_png(image);
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&read, bytes.data(), bytes.size()));
  read.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(read));
  ASSERT_TRUE(png_image_finish_read(&read, nullptr, pixels.data(), 0, nullptr));
  EXPECT_EQ(read.width, 3U);
  EXPECT_EQ(pixels, image.rgba);
}

/// A labelled cup, by the program.
class Render : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(test::toposcope("sample cup --faces 3000 -o " + path("cup.ply")).exit_code, 0);
    ASSERT_EQ(test::toposcope("run " + path("cup.ply") + " --model cup --no-report --out " + path("out")).exit_code, 0);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  bool there(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  test::TemporaryFolder folder_;
};

TEST_F(Render, ShowsEveryStage) {
  ASSERT_EQ(test::toposcope("render --stage all --size 160x120 " + path("out/cup")).exit_code, 0);
  for (const char* name : {"mesh", "worksets", "candidates-rim", "candidates-handleCon", "found", "marks"})
    EXPECT_TRUE(there("out/cup/" + std::string(name) + ".png")) << name;
  const Scene scene = read_scene(test::read_text(folder_ / "out/cup/scene.json"), "scene.json");
  const Stand stand = stand_of(scene);
  EXPECT_GT(stand.up.z(), 0.99);  // the rim is up of the bottom's edge
  const PictureStyle style = small_style();
  const Image plain = picture_of(scene, Stage::mesh, "", best_view(scene, stand), stand, style, test::context());
  const Image found = picture_of(scene, Stage::found, "", best_view(scene, stand), stand, style, test::context());
  std::size_t green = 0, orange = 0;  // rim and handle in the palette
  for (std::size_t i = 0; i < found.rgba.size(); i += 4) {
    const std::uint8_t* p = found.rgba.data() + i;
    green += p[1] > p[0] + 40 && p[1] > p[2] + 10;
    orange += p[0] > p[2] + 60 && p[1] > p[2] + 30;
    EXPECT_LT(std::abs(plain.rgba[i] - plain.rgba[i + 2]), 30);  // nothing is coloured before features are found
  }
  EXPECT_GT(green, 20U);
  EXPECT_GT(orange, 20U);
}

TEST_F(Render, NamesPicturesAsAsked) {
  ASSERT_EQ(test::toposcope("render --size 64x48 -o " + path("a.png") + " " + path("out/cup")).exit_code, 0);
  EXPECT_TRUE(there("a.png"));
  ASSERT_EQ(test::toposcope("render --stage mesh,found --size 64x48 --background transparent --view 30,10 --up y -o " +
                            path("b.png") + " " + path("out/cup"))
                .exit_code,
            0);
  EXPECT_TRUE(there("b-mesh.png") && there("b-found.png"));
  const std::string bytes = test::read_text(folder_ / "b-found.png");
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\0\x40\0\0\0\x30", 8));  // width, height
}

TEST_F(Render, TakesAFolderForPictures) {
  ASSERT_EQ(
      test::toposcope("render --stage mesh,found --size 64x48 -o " + path("new/") + " " + path("out/cup")).exit_code,
      0);
  EXPECT_TRUE(there("new/mesh.png") && there("new/found.png"));
  ASSERT_EQ(test::toposcope("render --size 64x48 -o " + path("new") + " " + path("out/cup")).exit_code, 0);
  EXPECT_TRUE(there("new/found.png"));
}

TEST_F(Render, SaysOfWhichStageThereIsNothing) {
  std::filesystem::remove(folder_ / "cup.truth.json");
  ASSERT_EQ(test::toposcope("run " + path("cup.ply") + " --model cup --no-report --out " + path("out")).exit_code, 0);
  const test::Outcome outcome = test::toposcope("render --stage marks,found --size 64x48 " + path("out/cup"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("has nothing to show of marks"), std::string::npos) << outcome.err;
  EXPECT_TRUE(there("out/cup/found.png"));
  EXPECT_EQ(test::toposcope("render --stage all --size 64x48 " + path("out/cup")).exit_code, 0);
}

TEST_F(Render, RefusesWhatItCannotDo) {
  for (const std::string arguments : {"--size 10", "--size 0x10", "--size 64x48x", "--size 99999x10", "--view up",
                                      "--up q", "--stage floor", "--background pink"}) {
    const test::Outcome outcome = test::toposcope("render " + arguments + " " + path("out/cup"));
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
  EXPECT_FALSE(there("out/cup/found.png"));
}

}  // namespace
}  // namespace toposcope
