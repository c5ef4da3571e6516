// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "model/model_words.h"
#include "model/networks.h"
#include "model/show_model.h"

namespace toposcope {
namespace {

template <class Named>
std::size_t longest_name(const std::vector<Named>& items) {
  std::size_t longest = 0;
  for (const Named& item : items) longest = std::max(longest, item.name.size());
  return longest;
}

void write_object(const AbstractModel& model, Index object, std::size_t width, std::string& out) {
  const std::string indent(2 + width + 2 + 9, ' ');
  out +=
      "  " + padded(model.objects[object].name, width) + "  " + padded(object_kind(model.objects[object].dimension), 9);
  // One line for each kind of link.
  std::vector<Link> links = links_from(model, object);
  std::string lines;
  while (!links.empty()) {
    const std::string kind = links.front().kind;
    std::string line = kind + " ";
    for (const Link& link : links)
      if (link.kind == kind) line += (line.size() > kind.size() + 1 ? ", " : "") + model.objects[link.to].name;
    links.erase(std::remove_if(links.begin(), links.end(), [&](const Link& link) { return link.kind == kind; }),
                links.end());
    lines += (lines.empty() ? "" : "\n" + indent) + line;
  }
  out += lines;
  while (out.back() == ' ') out.pop_back();
  out += "\n";
}

void write_feature(const ModelFeature& feature, std::size_t width, std::string& out) {
  const std::string indent(2 + width + 2, ' ');
  out += "  " + padded(feature.name, width) + "  " + shapes_in_words(feature) + " on " + worksets_in_words(feature) +
         ", detectability " + number_in_words(feature.detectability);
  if (feature.count.family())
    out += ", instances: " + count_in_words(feature.count);
  else if (feature.required())
    out += ", " + count_in_words(feature.count);
  if (!feature.realises.empty()) out += ", realises " + feature.realises;
  out += "\n";
  for (const Range& range : feature.ranges) out += indent + range_in_words(range) + "\n";
  if (feature.max_fit_error) out += indent + "fit error < " + feature.max_fit_error->text() + "\n";
}

void write_relationship(const Model& model, const Relationship& relationship, std::size_t width, std::string& out) {
  out += "  " + padded(relationship.name, width) + "  " + relationship.plugin + "(";
  for (std::size_t i = 0; i < relationship.features.size(); ++i)
    out += (i ? ", " : "") + model.features[relationship.features[i]].name;
  out += ")";
  if (const std::string arguments = arguments_in_words(relationship); !arguments.empty()) out += ": " + arguments;
  if (!relationship.because.empty()) out += "  follows from " + relationship.because;
  out += "\n";
}

}  // namespace

std::string model_as_text(const Model& model) {
  std::string out = model.name;
  if (!model.summary.empty()) out += ": " + model.summary;
  if (!model.citation.empty()) out += " (" + model.citation + ")";
  out += "\n";

  if (!model.abstract.objects.empty()) {
    out += "\nAbstract model, root " + model.abstract.objects[model.abstract.root].name + "\n";
    const std::size_t width = longest_name(model.abstract.objects);
    for (Index object = 0; object < model.abstract.objects.size(); ++object)
      write_object(model.abstract, object, width, out);
  }

  if (!model.features.empty()) out += "\nFeatures\n";
  for (const ModelFeature& feature : model.features) write_feature(feature, longest_name(model.features), out);

  if (!model.relationships.empty()) out += "\nRelationships\n";
  for (const Relationship& relationship : model.relationships)
    write_relationship(model, relationship, longest_name(model.relationships), out);

  if (!model.overruled.empty()) out += "\nWhat would follow, but is said otherwise\n";
  for (const Overruled& each : model.overruled) out += "  by " + each.by + ": " + each.because + "\n";

  if (!model.axes.empty()) out += "\nAxes\n";
  for (const AxisFeatures& axis : model.axes) {
    out += "  " + padded(axis.direction, 5) + "  along";
    for (std::size_t i = 0; i < axis.features.size(); ++i)
      out += (i ? ", " : " ") + model.features[axis.features[i]].name;
    out += "\n";
  }

  if (!model.classes.empty()) out += "\nClasses\n";
  for (const ClassRule& rule : model.classes) {
    out += "  " + padded(rule.name, longest_name(model.classes)) + " ";
    for (const Index relationship : rule.relationships) out += " " + model.relationships[relationship].name;
    out += "\n";
  }

  if (!model.measures.empty()) out += "\nMeasures\n";
  for (const ModelMeasure& measure : model.measures) {
    out += "  " + padded(measure.name, longest_name(model.measures)) + "  " + measure.expression.text;
    if (const std::string unit = measure.expression.unit(); !unit.empty()) out += " (" + unit + ")";
    out += "\n";
  }
  return out;
}

}  // namespace toposcope
