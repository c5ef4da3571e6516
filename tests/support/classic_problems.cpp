// SPDX-License-Identifier: BSD-3-Clause
#include "support/classic_problems.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "toposcope/labeling/tools.h"

namespace toposcope::test {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 random_;
};

void add_variable(LabelingProblem& problem, std::string name, std::vector<double> costs) {
  LabelingVariable& variable = problem.variables.emplace_back();
  variable.name = std::move(name);
  variable.optional = false;
  variable.costs = std::move(costs);
}

}  // namespace

LabelingProblem auction(Index goods, Index bids, std::uint64_t seed) {
  Draw draw(seed);
  LabelingProblem problem;
  problem.name = "auction";
  std::vector<std::set<std::uint64_t>> asked(bids);
  for (Index b = 0; b < bids; ++b) {
    const std::size_t count = 2 + draw.below(4);
    while (asked[b].size() < count) asked[b].insert(draw.below(goods));
    const double price =
        std::floor(static_cast<double>(count * (40 + draw.below(121))) / 3) + 1 + static_cast<double>(draw.below(30));
    add_variable(problem, "bid" + std::to_string(b), {price, 0});
    for (Index c = 0; c < b; ++c)
      if (std::any_of(asked[b].begin(), asked[b].end(), [&](auto good) { return asked[c].contains(good); }))
        problem.constraints.push_back(
            {"b" + std::to_string(c) + "-" + std::to_string(b), {c, b}, {0, 0, 0, forbidden}, {}});
  }
  return problem;
}

LabelingProblem warehouses(Index warehouses, Index stores, std::uint64_t seed) {
  Draw draw(seed);
  const auto place = [&] { return std::pair{draw.unit(), draw.unit()}; };
  constexpr double opening = 3000, unit_distance = 3000;
  LabelingProblem problem;
  problem.name = "warehouses";
  std::vector<std::pair<double, double>> at;
  for (Index w = 0; w < warehouses; ++w) {
    at.push_back(place());
    add_variable(problem, "warehouse" + std::to_string(w), {0, opening});
  }
  for (Index s = 0; s < stores; ++s) {
    const auto here = place();
    std::vector<double> costs;
    for (const auto& [x, y] : at)
      costs.push_back(std::floor(unit_distance * std::hypot(x - here.first, y - here.second)));
    add_variable(problem, "store" + std::to_string(s), costs);
    for (Index w = 0; w < warehouses; ++w) {
      LabelingConstraint serves{"w" + std::to_string(w) + "-" + std::to_string(s), {w, warehouses + s}, {}, {}};
      serves.costs.assign(2 * static_cast<std::size_t>(warehouses), 0);
      serves.costs[w] = forbidden;  // a closed one
      problem.constraints.push_back(std::move(serves));
    }
  }
  return problem;
}

}  // namespace toposcope::test
