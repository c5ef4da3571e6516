// SPDX-License-Identifier: BSD-3-Clause
#include "probability/probability_options.h"

#include <array>

namespace toposcope {

std::span<const OptionRow> probability_option_table() {
  static const std::array<OptionRow, 7> table = {{
      {"max_candidates", OptionType::integer, "", "80", "1", "1000",
       "candidates kept per feature, the best by evidence; of a family up to ten times as many"},
      {"fit_error_scale", OptionType::real, "mean-edges", "0.82", "0.001", "1000",
       "standard deviation of a point's distance from its shape, where the model says nothing"},
      {"sample_spacing", OptionType::real, "mean-edges", "4", "0.1", "1000",
       "distance at which samples of a shape count as independent"},
      {"unexplained_cost", OptionType::real, "nats", "1", "0", "100",
       "cost of an independent sample that the shape leaves out"},
      {"relation_exception", OptionType::real, "", "0.01", "1e-12", "0.5",
       "probability that a relationship fails although its features are right"},
      {"crisp", OptionType::boolean, "", "true", "", "",
       "a relationship beyond its tolerance is forbidden; false: it only costs"},
      {"certainty", OptionType::real, "", "0.99", "0.5", "0.999999", "detectability is held below this"},
  }};
  return table;
}

ProbabilityModel probability_model(const Options& options) {
  return {.sample_spacing = options.real("sample_spacing"),
          .fit_error_scale = options.real("fit_error_scale"),
          .unexplained_cost = options.real("unexplained_cost"),
          .relation_exception = options.real("relation_exception"),
          .certainty = options.real("certainty"),
          .crisp = options.boolean("crisp"),
          .max_candidates = static_cast<std::size_t>(options.integer("max_candidates"))};
}

}  // namespace toposcope
