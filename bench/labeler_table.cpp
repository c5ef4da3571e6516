// SPDX-License-Identifier: BSD-3-Clause
// least-error beside toulbar2 on problems shaped like those of meshes, auctions and warehouses: the table of
// docs/measured/labelers.md.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <optional>
#include <regex>

#include "formats/problem_io.h"
#include "support/classic_problems.h"
#include "support/planted_problems.h"
#include "support/plugins.h"
#include "table/table.h"

namespace {

using namespace toposcope;

/// toulbar2's own solving time in seconds, without reading; nothing where it did not prove an optimum.
struct Rival {
  std::optional<double> seconds, cost;
};

Rival toulbar2(const LabelingProblem& problem, double limit_s) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "toposcope_labeler_table.cfn";
  write_problem(file, problem);
  const std::string command = fmt::format("toulbar2 -timer={:.0f} '{}' 2>&1", limit_s, file.string());
  Rival rival;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return rival;
  const std::regex optimum(R"(Optimum: (-?[0-9.]+) .* and ([0-9.e+-]+) seconds)");
  char line[4096];
  while (std::fgets(line, sizeof line, pipe)) {
    std::cmatch match;
    if (std::regex_search(line, match, optimum)) rival = {std::atof(match[2].first), std::atof(match[1].first)};
  }
  pclose(pipe);
  std::filesystem::remove(file);
  return rival;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

const std::vector<Column> columns = {"kind",
                                     "size",
                                     "proven",
                                     {"median ms", "ms", "ms", "{:.1f}"},
                                     {"worst ms", "ms", "ms", "{:.1f}"},
                                     {"worst gap", "number", "nats", "{:.3g}"},
                                     "toulbar2 proven",
                                     {"median ms", "ms", "ms", "{:.0f}"},
                                     {"worst ms", "ms", "ms", "{:.0f}"},
                                     "optima that differ"};

struct Kind {
  const char* name;
  std::string size;
  std::function<LabelingProblem(std::uint64_t seed)> make;
};

void row(const Kind& kind, int seeds, double limit_s) {
  std::vector<double> ours, theirs, gaps;
  int proven = 0, rival_proven = 0, differ = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const LabelingProblem problem = kind.make(static_cast<std::uint64_t>(seed));
    const std::clock_t start = std::clock();  // as the rival counts: processor time
    const LabelingOutcome outcome =
        test::labeler("least-error")->solve(problem, {.k_best = 1, .time_limit_s = limit_s}, test::context());
    ours.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    gaps.push_back(outcome.labelings[0].cost - outcome.lower_bound);
    proven += outcome.optimal;
    const Rival rival = toulbar2(problem, limit_s);
    theirs.push_back(rival.seconds.value_or(limit_s));
    rival_proven += rival.seconds.has_value();
    differ += outcome.optimal && rival.cost && std::abs(*rival.cost - outcome.labelings[0].cost) > 1e-3;
  }
  const auto worst = [](const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); };
  fmt::print("{}",
             markdown_row(columns, {kind.name, kind.size, fmt::format("{} of {}", proven, seeds), 1e3 * median(ours),
                                    1e3 * worst(ours), worst(gaps), fmt::format("{} of {}", rival_proven, seeds),
                                    1e3 * median(theirs), 1e3 * worst(theirs), std::to_string(differ)}));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"least-error and toulbar2 side by side on seeded problems"};
  int seeds = 5;
  double limit_s = 10;
  app.add_option("--seeds", seeds, "problems of each kind")->capture_default_str();
  app.add_option("--limit", limit_s, "seconds for each problem")->capture_default_str();
  std::string only;
  app.add_option("--kind", only, "of these alone: planted, random, auction or warehouses");
  CLI11_PARSE(app, argc, argv);
  fmt::print("{}", markdown_header(columns));
  std::vector<Kind> kinds;
  for (const bool structured : {true, false})
    for (const auto& [features, candidates] : {std::pair<Index, Index>{8, 20}, {12, 50}, {20, 60}, {40, 60}})
      kinds.push_back(
          {structured ? "planted" : "random", fmt::format("{} x {}", features, candidates),
           [kind = test::PlantedKind{.features = features, .candidates = candidates, .structured = structured}](
               std::uint64_t seed) { return test::planted_problem(kind, seed); }});
  for (const auto& [goods, bids] : {std::pair<Index, Index>{20, 60}, {40, 100}, {60, 150}, {80, 200}})
    kinds.push_back({"auction", fmt::format("{} goods, {} bids", goods, bids),
                     [=](std::uint64_t seed) { return test::auction(goods, bids, seed); }});
  for (const auto& [places, stores] : {std::pair<Index, Index>{15, 30}, {25, 50}, {40, 80}})
    kinds.push_back({"warehouses", fmt::format("{} for {} stores", places, stores),
                     [=](std::uint64_t seed) { return test::warehouses(places, stores, seed); }});
  for (const Kind& kind : kinds)
    if (only.empty() || only == kind.name) row(kind, seeds, limit_s);
}
