// SPDX-License-Identifier: BSD-3-Clause
#include "model/ask.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "model/model_words.h"
#include "model/networks.h"

namespace toposcope {
namespace {

constexpr std::array<std::string_view, 11> asked_relations = {
    "bounded-by", "boundary-of", "has-part", "part-of", "adjacent-to", "up", "down", "front", "back", "right", "left"};

const Consequence* found_among(const std::vector<Consequence>& all, Index object) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const Consequence& each) { return each.object == object; });
  return at == all.end() ? nullptr : &*at;
}

/// Whether the dimensions alone rule a relation out.
bool impossible(const AbstractModel& model, Index subject, std::string_view relation, Index object) {
  const int from = model.objects[subject].dimension, to = model.objects[object].dimension;
  if (relation == "bounded-by") return to >= from;
  if (relation == "boundary-of") return from >= to;
  return (relation == "has-part" || relation == "part-of") && from != to;
}

void judge(AbstractAnswer& answer, const AbstractModel& model) {
  const AbstractQuery& query = answer.query;
  const Index subject = *query.subject, object = *query.object;
  const std::vector<Consequence> all = consequences(model, subject, query.relation);
  if (const Consequence* holds = found_among(all, object)) {
    answer.verdict = Verdict::yes;
    answer.because = holds->chain;
    return;
  }
  if (subject == object || impossible(model, subject, query.relation, object)) {
    answer.verdict = Verdict::no;
    return;
  }
  // Nothing lies both ways of another, and nothing is part of its part.
  const std::vector<Consequence> inverse = consequences(model, subject, inverse_of(query.relation));
  if (const Consequence* against = found_among(inverse, object); against && query.relation != "adjacent-to") {
    answer.verdict = Verdict::no;
    answer.because = against->chain;
  }
}

/// "wall bounded-by rim", "wall bounded-by rim bounded-by tip"
std::string chain_in_words(const std::vector<Link>& chain, const AbstractModel& model) {
  std::string words = model.objects[chain.front().from].name;
  for (const Link& link : chain) words += " " + link.kind + " " + model.objects[link.to].name;
  return words;
}

std::string side_in_words(const std::optional<Index>& object, const AbstractModel& model) {
  return object ? model.objects[*object].name : "?";
}

std::string verdict_in_words(const AbstractAnswer& answer, const AbstractModel& model) {
  if (answer.verdict == Verdict::unsaid) return "  the model does not say\n";
  std::string words = answer.verdict == Verdict::yes ? "  yes" : "  no";
  if (!answer.because.empty()) return words + ": " + chain_in_words(answer.because, model) + "\n";
  const SpatialObject &from = model.objects[*answer.query.subject], &to = model.objects[*answer.query.object];
  if (*answer.query.subject == *answer.query.object) return words + ": they are one object\n";
  return words + ": a " + object_kind(from.dimension) + " is never " + answer.query.relation + " a " +
         object_kind(to.dimension) + "\n";
}

nlohmann::ordered_json chain_json(const std::vector<Link>& chain, const AbstractModel& model) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Link& link : chain)
    list.push_back({{"from", model.objects[link.from].name},
                    {"link", link.kind},
                    {"to", model.objects[link.to].name},
                    {"line", link.where.line}});
  return list;
}

}  // namespace

AbstractAnswer answer(const AbstractQuery& query, const Model& model) {
  AbstractAnswer answer;
  answer.query = query;
  const AbstractModel& abstract = model.abstract;
  const auto find = [&](Index subject, std::string_view walked, std::string_view told) {
    for (Consequence& each : consequences(abstract, subject, walked))
      if (query.dimension < 0 || abstract.objects[each.object].dimension == query.dimension)
        answer.found.push_back({std::string(told), std::move(each)});
  };
  if (query.relation.empty())
    for (const std::string_view relation : asked_relations) find(*query.subject, relation, relation);
  else if (query.subject && query.object)
    judge(answer, abstract);
  else if (query.subject)
    find(*query.subject, query.relation, query.relation);
  else
    find(*query.object, inverse_of(query.relation), query.relation);
  return answer;
}

std::string to_text(const AbstractAnswer& answer, const Model& model) {
  const AbstractModel& abstract = model.abstract;
  const AbstractQuery& query = answer.query;
  const bool everything = query.relation.empty();
  std::string text = side_in_words(query.subject, abstract);
  if (everything)
    text += " (" + object_kind(abstract.objects[*query.subject].dimension) + ")\n";
  else
    text += " " + query.relation + " " + side_in_words(query.object, abstract) + "\n";
  if (query.subject && query.object) return text + verdict_in_words(answer, abstract);
  std::size_t width = 0;
  for (const AbstractAnswer::Found& found : answer.found)
    width = std::max(width, abstract.objects[found.consequence.object].name.size());
  for (const AbstractAnswer::Found& found : answer.found) {
    const SpatialObject& object = abstract.objects[found.consequence.object];
    const std::vector<Link>& chain = found.consequence.chain;
    text += "  " + (everything ? padded(found.relation, 11) + "  " : "") + padded(object.name, width) + "  " +
            padded(object_kind(object.dimension), 7) + "  " +
            (chain.size() == 1 ? "line " + std::to_string(chain[0].where.line) : chain_in_words(chain, abstract)) +
            "\n";
  }
  if (answer.found.empty()) text += "  nothing that the model says\n";
  return text;
}

std::string to_json(const AbstractAnswer& answer, const Model& model) {
  using Json = nlohmann::ordered_json;
  const AbstractModel& abstract = model.abstract;
  const AbstractQuery& query = answer.query;
  const auto named = [&](const std::optional<Index>& object) {
    return object ? Json(abstract.objects[*object].name) : Json(nullptr);
  };
  Json json = {{"model", model.name}, {"question", query.text}, {"subject", named(query.subject)}};
  json["relation"] = query.relation.empty() ? Json(nullptr) : Json(query.relation);
  json["object"] = named(query.object);
  if (query.subject && query.object) {
    json["verdict"] = answer.verdict == Verdict::yes ? "yes" : answer.verdict == Verdict::no ? "no" : "unsaid";
    json["because"] = chain_json(answer.because, abstract);
    return json.dump() + "\n";
  }
  json["found"] = Json::array();
  for (const AbstractAnswer::Found& found : answer.found) {
    const SpatialObject& object = abstract.objects[found.consequence.object];
    json["found"].push_back({{"relation", found.relation},
                             {"name", object.name},
                             {"dimension", object_kind(object.dimension)},
                             {"because", chain_json(found.consequence.chain, abstract)}});
  }
  return json.dump() + "\n";
}

}  // namespace toposcope
