// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Plugins as a test sees them: loaded at run time from the build tree, as the program does.

#include <memory>
#include <string_view>
#include <vector>

#include "plugin/plugin_host.h"
#include "toposcope/context.h"

namespace toposcope::test {

using Settings = std::vector<GivenOption>;  ///< {{"method", "powell"}}: what differs from the defaults

/// Over the plugins of this build tree alone; made once.
PluginHost& host();

/// A quiet context with `threads` threads and seed 1; one per thread count, made once.
Context& context(unsigned threads = 1);

/// \throw UsageError, PluginError as PluginHost does
std::shared_ptr<const WorkingSetClassifier> worksets(std::string_view id, const Settings& settings = {});
std::shared_ptr<const ShapeFitter> shape(std::string_view id, const Settings& settings = {});
std::shared_ptr<const RelationTester> relation(std::string_view id, const Settings& settings = {});
std::shared_ptr<const Labeler> labeler(std::string_view id, const Settings& settings = {});
std::shared_ptr<const MeshFilter> filter(std::string_view id, const Settings& settings = {});

/// Checked model arguments of a shape or relation; keep it while its Options are in use:
///   const Arguments arguments(PluginKind::shapes, "line-group", {{"segments", "3"}});
///   shape("line-group")->fit(input, arguments.options(), context());
class Arguments {
 public:
  Arguments(PluginKind kind, std::string_view id, const Settings& settings = {});
  Options options() const { return Options(values_); }

 private:
  std::vector<OptionValue> values_;
};

}  // namespace toposcope::test
