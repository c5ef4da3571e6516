// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_words.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace toposcope {

std::string object_kind(int dimension) {
  static constexpr std::array<const char*, 4> kinds = {"point", "line", "surface", "volume"};
  return kinds.at(static_cast<std::size_t>(dimension));
}

std::string shape_in_words(const ShapeSpec& shape) {
  std::string arguments;
  for (const auto& [name, value] : shape.arguments) arguments += (arguments.empty() ? "" : ", ") + name + " " + value;
  return arguments.empty() ? shape.plugin : shape.plugin + " (" + arguments + ")";
}

std::string shapes_in_words(const ModelFeature& feature) {
  std::string words = shape_in_words(feature.shape);
  for (const ShapeSpec& other : feature.other_shapes) words += " or " + shape_in_words(other);
  return words;
}

std::string range_in_words(const Range& range) {
  return (range.low ? range.low->text() + " < " : "") + range.measure + (range.high ? " < " + range.high->text() : "");
}

std::string bound_in_words(const ModelFeature& feature, Index bound) {
  if (bound / 2 >= feature.ranges.size()) return "fit error < " + feature.max_fit_error->text();
  const Range& range = feature.ranges[bound / 2];
  return bound % 2 == 0 ? range.low->text() + " < " + range.measure : range.measure + " < " + range.high->text();
}

std::string arguments_in_words(const Relationship& relationship) {
  std::string words;
  for (const auto& [name, value] : relationship.arguments)
    words += (words.empty() ? "" : ", ") + name + " " + value.text();
  for (const auto& [name, value] : relationship.words) words += (words.empty() ? "" : ", ") + name + " " + value;
  if (relationship.tolerance) words += (words.empty() ? "" : ", ") + ("tolerance " + relationship.tolerance->text());
  return words;
}

std::string worksets_in_words(const ModelFeature& feature) {
  const auto joined = [](const std::vector<std::string>& types) {
    std::string words;
    for (const std::string& type : types) words += (words.empty() ? "" : " + ") + type;
    return words;
  };
  return joined(feature.worksets) +
         (feature.second_look.empty() ? "" : ", at a second look " + joined(feature.second_look));
}

std::string count_in_words(const InstanceCount& count) {
  if (!count.family()) return count.least > 0 ? "required" : "";
  if (!count.most) return count.least == 0 ? "any number" : "at least " + std::to_string(count.least);
  if (*count.most == count.least) return std::to_string(count.least);
  return std::to_string(count.least) + " to " + std::to_string(*count.most);
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string number_in_words(double number) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr};
}

}  // namespace toposcope
