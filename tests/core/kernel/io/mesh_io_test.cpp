// SPDX-License-Identifier: BSD-3-Clause
#include <clocale>
#include <locale>

#include "core/kernel/io/gltf_files.h"
#include "support/meshes.h"

namespace toposcope {
namespace {

using test::bytes, test::refusal, test::says, test::ScratchFolder;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class RoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, GivesTheSameMesh) {
  const ScratchFolder folder;
  const auto path = folder.path() / ("mesh" + std::string(GetParam()));
  TriangleSoup soup = test::transformed(test::make_torus(2, 0.7, 13, 9), test::random_rotation(5), 0.1, {1, 2, 3});
  if (path.extension() == ".stl")  // what single precision can hold
    for (Vec3& p : soup.positions) p = (p.array() * 4096).round() / 4096;
  write_mesh(path, soup.positions, soup.triangles);
  const TriangleSoup back = read_soup(path);
  ASSERT_EQ(back.triangles.size(), soup.triangles.size());
  EXPECT_EQ(back.positions.size(), soup.positions.size());
  for (std::size_t f = 0; f < soup.triangles.size(); ++f)
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(back.positions[back.triangles[f][i]], soup.positions[soup.triangles[f][i]]) << "to the last bit";
  if (path.extension() != ".stl") {
    EXPECT_EQ(back.positions, soup.positions);
    EXPECT_EQ(back.triangles, soup.triangles);
  }
  EXPECT_EQ(back.input_faces, soup.triangles.size());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "no temporary file is left";
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, ::testing::Values(".ply", ".obj", ".stl", ".off", ".PLY"));

TEST(WriteMesh, PlyHoldsColoursAndLabels) {
  const ScratchFolder folder;
  const auto path = folder.path() / "mesh.ply";
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const std::vector<Rgb> colors = {{1, 2, 255}};
  const std::vector<std::int32_t> labels = {-7};
  write_mesh(path, positions, triangles, {colors, labels});
  const std::string content = content_of(path);
  EXPECT_TRUE(
      says(content, "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int label\nend_header\n"));
  EXPECT_EQ(content.substr(content.size() - 7), std::string("\1\2\xff") + bytes(std::int32_t{-7}));
  EXPECT_EQ(read_soup(path).triangles, triangles);
  EXPECT_THROW(write_mesh(path, positions, triangles, {std::vector<Rgb>(2), {}}), MeshError);
  EXPECT_EQ(content_of(path), content) << "what failed leaves the file as it was";
}

TEST(WriteMesh, RefusesWhatItCannotWrite) {
  const ScratchFolder folder;
  const std::vector<Vec3> positions = {{0, 0, 0}, {1e60, 0, 0}, {0, 1, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}}, wrong = {{0, 1, 3}};
  EXPECT_THROW(write_mesh(folder.path() / "mesh.step", positions, triangles), UsageError);
  EXPECT_THROW(write_mesh(folder.path() / "mesh.stl", positions, triangles), MeshError) << "beyond single precision";
  EXPECT_THROW(write_mesh(folder.path() / "mesh.ply", positions, wrong), MeshError);
  EXPECT_THROW(write_mesh(folder.path() / "none" / "mesh.ply", positions, triangles), UsageError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteFile, ReplacesWholeAndFollowsLinks) {
  const ScratchFolder folder;
  const auto path = folder.put("a.txt", "old content");
  std::filesystem::create_symlink(path, folder.path() / "link.txt");
  write_file(folder.path() / "link.txt", "new");
  EXPECT_EQ(content_of(path), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.txt"));
  write_file(path, "");
  EXPECT_EQ(content_of(path), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(WriteFile, SaysWhatWentWrong) {
  const ScratchFolder folder;
  const auto reason = [](const std::filesystem::path& path) {
    try {
      write_file(path, "content");
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_TRUE(says(reason(folder.path()), "it is a folder"));
  EXPECT_TRUE(says(reason(folder.path() / "none" / "a"), "No such file"));
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_TRUE(says(reason("/dev/full"), "No space left"));
  }
}

TEST(ReadMesh, FilesThatAreNone) {
  const ScratchFolder folder;
  EXPECT_THROW(read_mesh(folder.path() / "none.ply"), MeshError);
  EXPECT_THROW(read_mesh(folder.path()), MeshError);
  if (std::filesystem::exists("/dev/zero")) {
    EXPECT_THROW(read_mesh("/dev/zero"), MeshError) << "has no end";
  }
  EXPECT_TRUE(says(refusal("hello", ".step"), "use .ply, .obj, .stl, .off, .glb or .gltf"));
}

TEST(ReadMesh, TheLocalePlaysNoRole) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const ScratchFolder folder;
  const TriangleSoup soup = test::make_grid(40, 40, 1234567.25, 0.125);
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    write_mesh(folder.path() / name, soup.positions, soup.triangles);
    EXPECT_EQ(read_soup(folder.path() / name).positions, soup.positions) << name;
  }
  std::locale::global(before);
}

/// What the C library does, which a library may ask.
TEST(ReadMesh, AnInstalledCommaLocalePlaysNoRole) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  bool found = false;
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8", "de_DE", "nl_NL.UTF-8", "pt_BR.UTF-8"})
    found = found || (std::setlocale(LC_ALL, name) && *std::localeconv()->decimal_point == ',');
  if (!found) GTEST_SKIP() << "no locale with a decimal comma is installed (locale-gen de_DE.UTF-8)";
  const Vec3 expected(1.5, -0.25, 1e-3);
  const std::string v = "1.5 -0.25 1e-3\n", all = v + "1 0 0\n0 1 0\n";
  EXPECT_EQ(test::read_text("v " + v + "v 1 0 0\nv 0 1 0\nf 1 2 3\n", ".obj").positions[0], expected);
  EXPECT_EQ(test::read_text("OFF 3 1 0\n" + all + "3 0 1 2\n", ".off").positions[0], expected);
  EXPECT_EQ(
      test::read_text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                      "z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n" +
                          all + "3 0 1 2\n",
                      ".ply")
          .positions[0],
      expected);
  EXPECT_EQ(test::read_text("solid\nfacet\nouter loop\nvertex " + v + "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
                            ".stl")
                .positions[0],
            expected);
  test::GltfFile gltf = test::square_gltf();
  gltf.scene({{{"mesh", 0}, {"translation", {1.5, -0.25, 1e-3}}}}, {0});
  EXPECT_EQ(test::read_text(gltf.glb(), ".glb").positions[0], expected);
  std::setlocale(LC_ALL, before.c_str());
}

/// Files gathered from the issue trackers of other mesh programs: each is read or refused, never worse.
TEST(ReadMesh, HostileFilesAreReadOrRefused) {
  const std::filesystem::path folder = std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "../shared/data/dirty";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "the collection of hostile files is not at " << folder;
  std::size_t read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    try {
      const Mesh mesh = read_mesh(entry.path());
      EXPECT_GT(mesh.view().box.a(), 0);
      EXPECT_GT(mesh.view().mean_edge, 0);
      EXPECT_TRUE(std::isfinite(mesh.view().box.diagonal()));
      ++read;
    } catch (const MeshError& error) {
      EXPECT_TRUE(says(error.what(), entry.path().filename().string()));
      ++refused;
    }
    // The same file damaged: cut short at several places, and with bytes overwritten.
    const std::string whole = content_of(entry.path());
    for (std::size_t i = 1; i < 8; ++i) {
      refusal(whole.substr(0, whole.size() * i / 8), entry.path().extension().string());
      std::string damaged = whole;
      for (std::size_t at = i; at < damaged.size(); at += 97) damaged[at] = static_cast<char>(damaged[at] ^ (1 << i));
      refusal(damaged, entry.path().extension().string());
    }
  }
  EXPECT_GE(read, 90U);
  EXPECT_GE(refused, 20U);
}

TEST(WriteMesh, SaysWhereStlLosesTheForm) {
  const test::ScratchFolder folder;
  const std::vector<Triangle> one = {{0, 1, 2}};
  const auto warning = [&](double offset, double scale, const char* name) {
    const std::vector<Vec3> corners = {Vec3(offset, 0, 0), Vec3(offset + scale, 0, 0), Vec3(offset, scale, 0)};
    return write_mesh(folder.path() / name, corners, one);
  };
  EXPECT_EQ(warning(0, 1, "mesh.stl"), "");
  EXPECT_TRUE(test::says(warning(5.4e6, 0.001, "utm.stl"), "1 of 1 faces lose their form"));
  EXPECT_TRUE(test::says(warning(0, 1e-70, "tiny.stl"), "write PLY"));
  EXPECT_EQ(warning(5.4e6, 0.001, "utm.ply"), "");
}

}  // namespace
}  // namespace toposcope
