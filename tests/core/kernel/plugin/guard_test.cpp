// SPDX-License-Identifier: BSD-3-Clause

// What comes out of a call into a plugin.

#include "plugin/guard.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace toposcope {
namespace {

TEST(Guard, NamesThePluginWhoseFaultItIs) {
  const auto thrown = [](const auto& throwing) {
    try {
      guard("odd", throwing);
    } catch (const PluginError& error) {
      return error.plugin;
    }
    return std::string();
  };
  EXPECT_EQ(thrown([] { throw std::runtime_error("x"); }), "odd");
  EXPECT_EQ(thrown([] { throw 3; }), "odd");
  EXPECT_EQ(thrown([] { throw PluginError("further-in", "x"); }), "further-in");
}

TEST(Guard, LeavesAloneWhatIsNot) {
  EXPECT_THROW(guard("odd", [] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THROW(guard("odd", [] { throw MeshError("x"); }), MeshError);
  EXPECT_EQ(guard("odd", [] { return 3; }), 3);
}

}  // namespace
}  // namespace toposcope
