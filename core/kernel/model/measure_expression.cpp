// SPDX-License-Identifier: BSD-3-Clause
#include "model/measure_expression.h"

#include <algorithm>

#include "base/nearest_name.h"
#include "model/expression_parser.h"
#include "model/model.h"

namespace toposcope {
namespace {

struct Function {
  const char* name;
  Quantity::Kind kind;
  std::size_t features;
  int dimension, angle;
};
constexpr Function functions[] = {{"distance", Quantity::Kind::distance, 2, 1, 0},
                                  {"along", Quantity::Kind::along, 3, 1, 0},
                                  {"across", Quantity::Kind::across, 3, 1, 0},
                                  {"angle", Quantity::Kind::angle, 2, 0, 1}};

/// Adds features, their measures and the functions of them to the language.
struct MeasureParser final : ExpressionParser {
  MeasureParser(std::string_view text_to_parse, const SourceLocation& place, const std::vector<ModelFeature>& known,
                const PluginCatalog* plugins)
      : ExpressionParser(text_to_parse, place), features(known), catalog(plugins) {}

  const std::vector<ModelFeature>& features;
  const PluginCatalog* catalog;
  std::vector<Quantity> quantities;

  Part named(const Token& token) override {
    if (token.text == "ratio" && peek().is("(")) return ratio();
    for (const Function& function : functions)
      if (token.text == function.name && peek().is("(")) return call(function);
    if (peek().is("(")) {
      const std::vector<std::string> known = {"distance", "along", "across", "angle", "ratio", "min", "max", "bb"};
      fail(token, "unknown function '" + std::string(token.text) + "'; " + name_remedy(std::string(token.text), known));
    }
    --next;
    return shape_measure(feature());
  }

  Part ratio() {
    expect("(", "after ratio");
    const Part over = sum();
    const Token comma = peek();
    expect(",", "between the two values of ratio");
    const Token divisor = peek();
    const Part under = sum();
    expect(")", "after the two values of ratio");
    common_unit(over, under, comma, "take the ratio of");
    if (under.constant && *under.constant == 0) fail(divisor, "division by zero; divide by another number");
    return combine(Operation::divide, over, under, comma, {});
  }

  Part call(const Function& function) {
    const std::string name = function.name, count = std::to_string(function.features);
    expect("(", "after " + name);
    Quantity quantity{function.kind, {}, {}};
    for (std::size_t i = 0; i < function.features; ++i) {
      if (i > 0) expect(",", "between the " + count + " features of " + name);
      const Token place = peek();
      const Index named = feature();
      // The axis may be that of one of the two between which is measured.
      if (i + 1 == function.features && quantity.features.back() == named)
        fail(place, name + " takes two different features, and '" + features[named].name + "' is named twice");
      quantity.features.push_back(named);
    }
    expect(")", "after the " + count + " features of " + name);
    return ask(std::move(quantity), {.dimension = function.dimension, .angle = function.angle});
  }

  Part shape_measure(Index feature) {
    const ModelFeature& of = features[feature];
    if (!accept("."))
      fail(peek(), "'" + of.name + "' is a feature, which is no number; write " + of.name +
                       ".radius or another measure of its shape, or distance(" + of.name + ", ...)");
    const Token token = peek();
    if (token.kind != Token::Kind::name)
      fail(token, "expected the name of a measure after '" + of.name + ".', found " + shown(token));
    ++next;
    Quantity quantity{Quantity::Kind::shape_measure, {feature}, std::string(token.text)};
    Part part{.angle = is_angle_measure(quantity.measure) ? 1 : 0};
    std::vector<std::string> known;
    part.literal_zero = true;  // where its dimension is not known it goes with all
    bool found = false, all_known = catalog != nullptr;
    for (std::size_t k = 0; catalog && k <= of.other_shapes.size(); ++k) {
      const PluginManifest* shape =
          catalog->find(PluginKind::shapes, (k == 0 ? of.shape : of.other_shapes[k - 1]).plugin);
      all_known = all_known && shape;
      if (!shape) continue;
      for (const ProvidedRow& each : shape->provides) known.push_back(each.name);
      const ProvidedRow* row = shape->find_provided(quantity.measure);
      if (!row) continue;
      found = true;
      part.dimension = row->dimension;
      part.literal_zero = false;
    }
    if (!found && all_known)
      fail(token, "shape '" + of.shape.plugin + "' of feature '" + of.name + "' has no measure '" + quantity.measure +
                      "'; " + name_remedy(quantity.measure, known));
    return ask(std::move(quantity), part);
  }

  Part ask(Quantity quantity, const Part& unit) {
    const auto same = std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& each) {
      return each.kind == quantity.kind && each.features == quantity.features && each.measure == quantity.measure;
    });
    const auto place = static_cast<std::uint32_t>(same - quantities.begin());
    if (same == quantities.end()) quantities.push_back(std::move(quantity));
    emit(Operation::quantity, 0, place);
    return unit;
  }

  /// The longest name of a feature that stands here: names may hold a '-'.
  Index feature() {
    const Token token = peek();
    if (token.kind != Token::Kind::name) fail(token, "expected the name of a feature, found " + shown(token));
    const std::string_view rest = text.substr(token.offset);
    Index best = 0;
    std::size_t longest = 0;
    for (Index f = 0; f < features.size(); ++f) {
      const std::string& name = features[f].name;
      if (name.size() > longest && rest.substr(0, name.size()) == name && ends_at(token.offset + name.size())) {
        best = f;
        longest = name.size();
      }
    }
    if (longest == 0) {
      std::vector<std::string> known;
      for (const ModelFeature& each : features) known.push_back(each.name);
      fail(token, "unknown feature '" + std::string(token.text) + "'; " + name_remedy(std::string(token.text), known));
    }
    while (tokens[next].kind != Token::Kind::end && tokens[next].offset < token.offset + longest) ++next;
    return best;
  }

  /// Whether a token ends before this character.
  bool ends_at(std::size_t offset) const {
    return std::any_of(tokens.begin(), tokens.end(), [&](const Token& token) {
      return token.kind != Token::Kind::end && token.offset + token.text.size() == offset;
    });
  }
};

void refuse_working_set_boxes(const MeasureParser& parser) {
  for (const Instruction& step : parser.program.code)
    if (step.operation == Operation::workset_side)
      parser.fail(parser.tokens.front(), "names bb(w), but a measure spans several features; use bb(O)");
}

}  // namespace

bool is_angle_measure(std::string_view measure) {
  return measure.ends_with("angle") || measure.ends_with("_deg");
}

MeasureExpression MeasureExpression::parse(std::string_view text, const SourceLocation& where,
                                           const std::vector<ModelFeature>& features, const PluginCatalog* catalog) {
  MeasureParser parser(text, where, features, catalog);
  const MeasureParser::Part whole = parser.sum();
  const ExpressionToken& rest = parser.peek();
  if (rest.kind != ExpressionToken::Kind::end)
    parser.fail(rest, "unexpected " + MeasureParser::shown(rest) + "; join values by an operator");
  parser.check_stack(parser.tokens.front());
  refuse_working_set_boxes(parser);
  if (parser.quantities.empty())
    parser.fail(parser.tokens.front(), "the measure names no feature; write one of a feature, as in rim.radius");
  return {std::move(parser.program.code), std::move(parser.quantities), whole.dimension, whole.angle,
          std::string(text)};
}

std::vector<Index> MeasureExpression::features() const {
  std::vector<Index> all;
  for (const Quantity& quantity : quantities)
    for (const Index feature : quantity.features)
      if (std::find(all.begin(), all.end(), feature) == all.end()) all.push_back(feature);
  return all;
}

std::string MeasureExpression::unit() const {
  static constexpr const char* names[] = {"", "length", "area", "volume"};
  std::string unit = dimension >= 0 && dimension <= 3 ? names[dimension] : "length^" + std::to_string(dimension);
  if (angle != 0) unit += (unit.empty() ? "deg" : " deg") + (angle == 1 ? "" : "^" + std::to_string(angle));
  return unit;
}

}  // namespace toposcope
