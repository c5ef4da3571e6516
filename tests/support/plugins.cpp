// SPDX-License-Identifier: BSD-3-Clause
#include "support/plugins.h"

#include <map>

#include "base/run_context.h"

namespace toposcope::test {
namespace {

std::vector<OptionValue> checked(PluginKind kind, std::string_view id, const Settings& settings) {
  return check_options(host().catalog().require(kind, id).options, settings,
                       std::string(singular(kind)) + " '" + std::string(id) + "'");
}

}  // namespace

PluginHost& host() {
  static PluginHost made(PluginCatalog({{TOPOSCOPE_BUILD_DIR "/plugins", true}}));
  return made;
}

Context& context(unsigned threads) {
  static std::map<unsigned, RunContext> contexts;
  RunSettings settings;
  settings.threads = threads;
  return contexts.try_emplace(threads, std::move(settings)).first->second;
}

std::shared_ptr<const WorkingSetClassifier> worksets(std::string_view id, const Settings& settings) {
  return host().worksets(id, checked(PluginKind::worksets, id, settings));
}
std::shared_ptr<const ShapeFitter> shape(std::string_view id, const Settings& settings) {
  return host().shape(id, checked(PluginKind::shapes, id, settings));
}
std::shared_ptr<const RelationTester> relation(std::string_view id, const Settings& settings) {
  return host().relation(id, checked(PluginKind::relations, id, settings));
}
std::shared_ptr<const Labeler> labeler(std::string_view id, const Settings& settings) {
  return host().labeler(id, checked(PluginKind::labelers, id, settings));
}
std::shared_ptr<const MeshFilter> filter(std::string_view id, const Settings& settings) {
  return host().filter(id, checked(PluginKind::filters, id, settings));
}

Arguments::Arguments(PluginKind kind, std::string_view id, const Settings& settings)
    : values_(check_options(host().catalog().require(kind, id).arguments, settings,
                            std::string(singular(kind)) + " '" + std::string(id) + "'")) {}

}  // namespace toposcope::test
