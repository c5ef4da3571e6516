// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "checks.h"

namespace toposcope {
namespace {

/// A value for an option that the user must give: the middle of its range, by ratio where the range is above 0.
std::string middle(const OptionRow& row) {
  if (row.type == OptionType::boolean) return "false";
  if (row.type == OptionType::text) {
    const auto choices = option_choices(row);
    return choices.empty() ? "text" : choices.front();
  }
  const double low = row.minimum.empty() ? 1 : std::stod(row.minimum);
  const double high = row.maximum.empty() ? std::max(low, 1.0) : std::stod(row.maximum);
  const double value = low > 0 ? std::sqrt(low * high) : (low + high) / 2;
  OptionValue rounded{
      .name = row.name, .number = row.type == OptionType::integer ? std::round(value) : value, .text = ""};
  return to_string(row, rounded);
}

std::vector<OptionValue> values(const std::vector<OptionRow>& table, std::vector<GivenOption> given) {
  for (const OptionRow& row : table) {
    const bool known =
        std::any_of(given.begin(), given.end(), [&](const auto& each) { return each.first == row.name; });
    if (!known && row.default_value.empty()) given.emplace_back(row.name, middle(row));
  }
  return check_options(table, given, "the plugin");
}

}  // namespace

TrialSet trials_for(const PluginManifest& plugin) {
  switch (plugin.kind) {
    case PluginKind::worksets:
      return workset_trials(plugin);
    case PluginKind::shapes:
      return shape_trials(plugin);
    case PluginKind::relations:
      return relation_trials(plugin);
    case PluginKind::labelers:
      return labeler_trials(plugin);
    case PluginKind::filters:
      return filter_trials(plugin);
  }
  throw std::logic_error("a kind that is none");
}

Subject::Made::Made(const PluginDescriptor& descriptor, std::vector<OptionValue> values)
    : descriptor_(descriptor), values_(std::move(values)), options_(values_) {
  object_ = descriptor.create(&options_, &refusal_);
  if (object_ == nullptr && refusal_.empty())
    throw Failure("refuses its options without a reason; say it in the 'error' of create");
}

Subject::Made::~Made() {
  if (object_ != nullptr) descriptor_.destroy(object_);
}

std::unique_ptr<Subject::Made> Subject::make(const std::vector<GivenOption>& given) const {
  return std::make_unique<Made>(descriptor_, values(manifest.options, given));
}

std::vector<OptionValue> Subject::arguments(const std::vector<GivenOption>& given, double scale) const {
  std::vector<GivenOption> all = given;
  for (const GivenOption& each : settled_)
    if (std::none_of(given.begin(), given.end(), [&](const auto& other) { return other.first == each.first; }))
      all.push_back(each);
  std::vector<OptionValue> checked = values(manifest.arguments, all);
  for (std::size_t i = 0; i < checked.size(); ++i)
    if (manifest.arguments[i].unit == "length") checked[i].number *= scale;
  return checked;
}

}  // namespace toposcope
