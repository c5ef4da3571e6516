// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

#include "plugin/catalog.h"
#include "plugin/guard.h"
#include "plugin/option_check.h"
#include "toposcope/filters.h"
#include "toposcope/labeling.h"
#include "toposcope/relations.h"
#include "toposcope/shapes.h"
#include "toposcope/worksets.h"

namespace toposcope {

struct PluginDescriptor;

/// Loads plugins when they are first asked for and makes their objects. Safe in any thread. Objects may outlive the
/// host: libraries are never unloaded.
class PluginHost {
 public:
  explicit PluginHost(PluginCatalog catalog);
  const PluginCatalog& catalog() const { return catalog_; }

  /// One of each kind's objects.
  /// \param options  checked against the plugin's table: check_options(catalog().require(kind, id).options, ...)
  /// \throw UsageError  unknown id; PluginError  it cannot be loaded or made
  std::shared_ptr<const WorkingSetClassifier> worksets(std::string_view id, std::span<const OptionValue> options);
  std::shared_ptr<const ShapeFitter> shape(std::string_view id, std::span<const OptionValue> options);
  std::shared_ptr<const RelationTester> relation(std::string_view id, std::span<const OptionValue> options);
  std::shared_ptr<const Labeler> labeler(std::string_view id, std::span<const OptionValue> options);
  std::shared_ptr<const MeshFilter> filter(std::string_view id, std::span<const OptionValue> options);

  /// Loads the library and checks that it agrees with its manifest. \throw as above
  const PluginDescriptor& load(PluginKind kind, std::string_view id);

 private:
  std::shared_ptr<const void> make(PluginKind kind, std::string_view id, std::span<const OptionValue> options);

  PluginCatalog catalog_;
  std::mutex mutex_;
  std::map<std::string, const PluginDescriptor*, std::less<>> loaded_;
};

}  // namespace toposcope
