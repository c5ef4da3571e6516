// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Loopy belief propagation by sums of products on a factor graph, in costs (-log of messages): exact where the graph
// has no cycles, else an estimate.

#include <cstdint>
#include <vector>

#include "toposcope/labeling/factor_graph.h"
#include "toposcope/labeling/watch.h"

namespace toposcope::posterior {

using namespace factors;

class BeliefPropagation {
 public:
  BeliefPropagation(const FactorGraph& graph, Watch& watch);

  /// True where messages need not go round: the result is exact once they stand still.
  bool forest() const;

  /// Sends every factor's messages once, in order and in reverse order by turns.
  /// \param damping  part of the old message that stays \return the largest change of a message \throw OutOfTime
  double sweep(double damping);

  /// The time of what comes after the sweeps.
  void use(Watch& watch) { watch_ = &watch; }

  std::uint64_t sweeps() const { return sweeps_; }

  /// Per variable, per value of the graph. \pre every variable's beliefs have a finite one
  std::vector<std::vector<double>> marginals() const;

  /// True where the messages have proven that no labelling has a finite cost.
  bool contradiction() const;

  /// Bethe's estimate of log Z (Yedidia, Freeman and Weiss 2005): the sum of log Z_i over variables and log Z_a over
  /// factors, less log Z_ia over edges. \throw OutOfTime
  double bethe_log_evidence();

 private:
  void incoming(std::size_t f, std::size_t k);
  template <class Visit>
  void each_row(const Factor& factor, std::size_t without, const Visit& visit);
  double reduce(const Factor& factor, std::size_t k);
  double send(std::size_t f, std::size_t k, double damping);

  const FactorGraph& graph_;
  Watch* watch_;
  std::vector<std::vector<double>> beliefs_;                ///< per variable: costs
  std::vector<std::vector<std::vector<double>>> messages_;  ///< per factor, per place in its scope: costs
  std::uint64_t sweeps_ = 0;
  std::vector<std::vector<double>> incoming_;
  std::vector<double> fresh_, sums_;
  std::vector<std::size_t> digits_;
};

}  // namespace toposcope::posterior
