// SPDX-License-Identifier: BSD-3-Clause
// Each wrong plugin gives its own clear error and leaves the good one beside it at work.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kernel/plugin/plugin_folder.h"
#include "plugin/plugin_host.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

using test::PluginFolderFixture;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string abi(std::uint32_t minor) {
  return std::to_string(abi_major) + "." + std::to_string(minor);
}

class BadPlugins : public ::testing::Test {
 protected:
  BadPlugins() { folder.add("good"); }

  PluginHost host() const { return PluginHost(PluginCatalog({{folder.path, true}})); }

  /// What asking for the plugin says; "" when it can be made.
  static std::string error_of(PluginHost& plugins, const std::string& id) {
    try {
      plugins.shape(id, {});
      return "";
    } catch (const PluginError& error) {
      EXPECT_EQ(error.plugin, id);
      EXPECT_EQ(error.exit_code, 4);
      return error.what();
    }
  }

  static void expect_good_works(PluginHost& plugins) {
    const auto good = plugins.shape("good", {});
    const std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {2, 4, 8}};
    FitInput input;
    input.points = points;
    const FittedShape fitted = good->fit(input, Options(), test::context());
    EXPECT_EQ(fitted.centroid, Vec3(1, 2, 2));
    EXPECT_EQ(good->distance(fitted, Vec3(1, 2, 5)), 3);
  }

  std::string error_beside_good(const std::string& id) {
    PluginHost plugins = host();
    const std::string error = error_of(plugins, id);
    expect_good_works(plugins);
    EXPECT_EQ(error_of(plugins, id), error) << "asked again, the answer is the same";
    return error;
  }

  PluginFolderFixture folder;
};

TEST_F(BadPlugins, TheGoodOneIsGood) {
  PluginHost plugins = host();
  EXPECT_TRUE(plugins.catalog().problems().empty());
  EXPECT_EQ(error_of(plugins, "good"), "");
  expect_good_works(plugins);
}

TEST_F(BadPlugins, WrongMajor) {
  folder.add("wrong-major");
  EXPECT_THAT(error_beside_good("wrong-major"),
              AllOf(HasSubstr("built for plugin ABI " + std::to_string(abi_major + 1) + "."),
                    HasSubstr("this program has ABI " + abi(abi_minor)), HasSubstr("build")));
}

TEST_F(BadPlugins, NewerMinor) {
  folder.add("newer-minor");
  EXPECT_THAT(error_beside_good("newer-minor"),
              AllOf(HasSubstr("newer plugin ABI " + abi(abi_minor + 1)), HasSubstr("has ABI " + abi(abi_minor))));
}

TEST_F(BadPlugins, WrongFingerprint) {
  folder.add("wrong-fingerprint");
  const std::string error = error_beside_good("wrong-fingerprint");
  EXPECT_THAT(error, HasSubstr("(scalar=single against scalar=double)"));
}

TEST_F(BadPlugins, ShortDescriptor) {
  folder.add("short-descriptor");
  EXPECT_THAT(error_beside_good("short-descriptor"), HasSubstr("64 bytes"));
}

TEST_F(BadPlugins, MissingSymbol) {
  folder.add("missing-symbol");
  EXPECT_THAT(error_beside_good("missing-symbol"), HasSubstr("does not export the symbol 'toposcope_plugin'"));
}

TEST_F(BadPlugins, UndefinedSymbol) {
  folder.add("undefined-symbol");
  EXPECT_THAT(error_beside_good("undefined-symbol"),
              AllOf(HasSubstr("cannot be loaded"), HasSubstr("toposcope_test_undefined_function")));
}

TEST_F(BadPlugins, NullDescriptor) {
  folder.add("null-descriptor");
  EXPECT_THAT(error_beside_good("null-descriptor"), HasSubstr("returned no descriptor"));
}

TEST_F(BadPlugins, ThrowsCreating) {
  folder.add("throws-creating");
  EXPECT_THAT(error_beside_good("throws-creating"), HasSubstr("could not be created: no table of centroids here"));
}

TEST_F(BadPlugins, ThrowsRunning) {
  folder.add("throws-running");
  PluginHost plugins = host();
  const auto shape = plugins.shape("throws-running", {});
  const auto message = [](auto&& call) -> std::string {
    try {
      guard("throws-running", call);
    } catch (const PluginError& error) {
      EXPECT_EQ(error.plugin, "throws-running");
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message([&] { shape->fit({}, Options(), test::context()); }),
              HasSubstr("'throws-running': threw while running: point 7 of 3"));
  EXPECT_THAT(message([&] { shape->distance({}, Vec3::Zero()); }), HasSubstr("not a std::exception"));
  expect_good_works(plugins);
}

TEST_F(BadPlugins, ThrowsInsideAParallelLoop) {
  folder.add("throws-running");
  PluginHost plugins = host();
  const auto shape = plugins.shape("throws-running", {});
  EXPECT_THROW(test::context(2).parallel_for(100, 1,
                                             [&](std::size_t, std::size_t) {
                                               guard("throws-running",
                                                     [&] { return shape->distance({}, Vec3::Zero()); });
                                             }),
               PluginError);
}

TEST_F(BadPlugins, TruncatedLibraryAtAnyLength) {
  const auto whole = std::filesystem::file_size(PluginFolderFixture::built("good"));
  folder.write_manifest("cut");
  const auto library = folder.path / ("cut" + library_suffix());
  for (std::uintmax_t part = 0; part < 24; ++part) {
    const std::uintmax_t length = whole * part / 24;
    std::filesystem::copy_file(PluginFolderFixture::built("good"), library,
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(library, length);
    EXPECT_THAT(error_beside_good("cut"), HasSubstr("truncated or not a library")) << length << " of " << whole;
  }
  std::filesystem::resize_file(library, whole - 1);
  EXPECT_THAT(error_beside_good("cut"), HasSubstr("truncated or not a library")) << "all but the last byte";
}

TEST_F(BadPlugins, LibraryThatIsText) {
  folder.write_manifest("text");
  folder.write("text" + library_suffix(), "#!/bin/sh\necho this is no library\n");
  EXPECT_THAT(error_beside_good("text"), HasSubstr("truncated or not a library"));
}

TEST_F(BadPlugins, DuplicateIdNamesBothFilesAndNeitherWins) {
  folder.add("throws-running");
  folder.write("shapes/throws-running.plugin.json", manifest_to_json(PluginFolderFixture::manifest("throws-running")));
  std::filesystem::copy_file(PluginFolderFixture::built("throws-running"),
                             folder.path / "shapes" / ("throws-running" + library_suffix()));
  const std::string error = error_beside_good("throws-running");
  EXPECT_THAT(error, AllOf(HasSubstr((folder.path / "throws-running.plugin.json").string()),
                           HasSubstr((folder.path / "shapes" / "throws-running.plugin.json").string())));
  EXPECT_EQ(host().catalog().problems().size(), 2);
}

TEST_F(BadPlugins, ManifestThatDoesNotMatchItsLibrary) {
  folder.add("throws-running");
  PluginManifest lie = PluginFolderFixture::manifest("throws-running");
  lie.version = "9.9.9";
  lie.options.push_back({"tolerance", OptionType::real, "deg", "5", "0", "90", "an option that is not there"});
  folder.write("throws-running.plugin.json", manifest_to_json(lie));
  const std::string error = error_beside_good("throws-running");
  EXPECT_THAT(error, AllOf(HasSubstr("do not agree"), HasSubstr("version: '9.9.9' in the manifest, '1.0.0'"),
                           HasSubstr("options: 'tolerance"), ::testing::Not(HasSubstr("summary"))));
}

TEST_F(BadPlugins, ManifestWithoutLibrary) {
  folder.write_manifest("alone");
  EXPECT_THAT(error_beside_good("alone"), AllOf(HasSubstr("alone" + library_suffix()), HasSubstr("not beside it")));
}

TEST_F(BadPlugins, GarbageManifest) {
  folder.add("throws-running");
  folder.write("throws-running.plugin.json", "{\"schema\": \"toposcope.plugin/1\", \x01");
  EXPECT_THAT(error_beside_good("throws-running"),
              AllOf(HasSubstr("throws-running.plugin.json"), HasSubstr("is no JSON")));
}

}  // namespace
}  // namespace toposcope
