// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/plugin_host.h"

#include <utility>
#include <vector>

#include "plugin/library.h"

namespace toposcope {
namespace {

/// A plugin may keep the Options that it was made with, so their values live as long as the object.
struct MadeObject {
  std::vector<OptionValue> values;
  Options options;
  void* object = nullptr;
  void (*destroy)(void*) = nullptr;

  explicit MadeObject(std::span<const OptionValue> given) : values(given.begin(), given.end()), options(values) {}
  MadeObject(const MadeObject&) = delete;
  MadeObject& operator=(const MadeObject&) = delete;
  ~MadeObject() {
    if (object != nullptr) destroy(object);
  }
};

}  // namespace

PluginHost::PluginHost(PluginCatalog catalog) : catalog_(std::move(catalog)) {}

const PluginDescriptor& PluginHost::load(PluginKind kind, std::string_view id) {
  const PluginManifest& manifest = catalog_.require(kind, id);
  const std::lock_guard lock(mutex_);
  if (const auto known = loaded_.find(id); known != loaded_.end()) return *known->second;
  const PluginDescriptor& descriptor = load_plugin_library(manifest.library, manifest.id);
  check_agreement(manifest, descriptor);
  loaded_.emplace(manifest.id, &descriptor);
  return descriptor;
}

std::shared_ptr<const void> PluginHost::make(PluginKind kind, std::string_view id,
                                             std::span<const OptionValue> options) {
  const PluginDescriptor& descriptor = load(kind, id);
  if (const std::string missing = missing_programs(catalog_.require(kind, id)); !missing.empty())
    throw PluginError(std::string(id), "is not available: " + missing);
  auto made = std::make_shared<MadeObject>(options);
  std::string error;
  try {
    made->object = descriptor.create(&made->options, &error);
  } catch (const std::exception& thrown) {
    error = thrown.what();
  } catch (...) {
    error = "an exception that is not a std::exception";
  }
  if (made->object == nullptr)
    throw PluginError(std::string(id), "could not be created: " + (error.empty() ? "it gave no reason" : error));
  made->destroy = descriptor.destroy;
  return {made, made->object};
}

// `create` returns a pointer to the kind's base class, so the way back from void is the same cast.
std::shared_ptr<const WorkingSetClassifier> PluginHost::worksets(std::string_view id,
                                                                 std::span<const OptionValue> options) {
  return std::static_pointer_cast<const WorkingSetClassifier>(make(PluginKind::worksets, id, options));
}
std::shared_ptr<const ShapeFitter> PluginHost::shape(std::string_view id, std::span<const OptionValue> options) {
  return std::static_pointer_cast<const ShapeFitter>(make(PluginKind::shapes, id, options));
}
std::shared_ptr<const RelationTester> PluginHost::relation(std::string_view id, std::span<const OptionValue> options) {
  return std::static_pointer_cast<const RelationTester>(make(PluginKind::relations, id, options));
}
std::shared_ptr<const Labeler> PluginHost::labeler(std::string_view id, std::span<const OptionValue> options) {
  return std::static_pointer_cast<const Labeler>(make(PluginKind::labelers, id, options));
}
std::shared_ptr<const MeshFilter> PluginHost::filter(std::string_view id, std::span<const OptionValue> options) {
  return std::static_pointer_cast<const MeshFilter>(make(PluginKind::filters, id, options));
}

}  // namespace toposcope
