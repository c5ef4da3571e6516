// SPDX-License-Identifier: BSD-3-Clause
// One text as an expression over boxes, as a range, and as an expression over found features.
#include "fuzz_catalog.h"
#include "fuzz_document.h"
#include "model/expression.h"
#include "model/measure_expression.h"
#include "model/read_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  static const Model model = model_from_text(
      "schema: toposcope.model/1\nname: cup\nfeatures:\n"
      "  rim: {worksets: [convex], shape: circle}\n"
      "  wall: {worksets: [planar], shape: plane}\n"
      "  edge: {worksets: [convex], shape: {plugin: line-group, segments: 3}}\n",
      "model.yaml", &fuzz::catalog());
  const SourceLocation where{"model.yaml", 1, 1};
  ExpressionBoxes boxes;
  boxes.object.sides = {3, 2, 1};
  boxes.worksets.sides = {1, 0.5, 0};
  fuzz::read_document(data, size, [&](const std::string& text) {
    const Expression expression = Expression::parse(text, where);
    expression.fits(expression.dimension());
    expression.evaluate(boxes);
    positive_on_mesh(expression, boxes, where, "tolerance");
  });
  for (const int dimension : {any_dimension, 0, 1})
    fuzz::read_document(data, size, [&](const std::string& text) { parse_range(text, where, dimension); });
  for (const PluginCatalog* known : {static_cast<const PluginCatalog*>(nullptr), &fuzz::catalog()})
    fuzz::read_document(data, size, [&](const std::string& text) {
      const MeasureExpression expression = MeasureExpression::parse(text, where, model.features, known);
      expression.features();
      expression.unit();
    });
  return 0;
}
