// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "instance_entries.h"
#include "instance_sets.h"

namespace toposcope {
namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

}  // namespace

InstanceSums::InstanceSums(const InstanceCircuit& circuit) : circuit_(circuit) {
  const std::size_t count = circuit.nodes().size();
  values_.resize(count);
  slopes_.resize(count);
  used_.resize(count);
  scales_.resize(count);
  norms_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    values_[n].resize(circuit.nodes()[n].entries);
    slopes_[n].resize(circuit.nodes()[n].entries);
    used_[n].resize(circuit.nodes()[n].candidates.size());
  }
}

double InstanceSums::sum(const InstanceWeights& weights, const std::vector<double>& number_weight_logs) {
  weights_ = &weights;
  single_ = weights.single;
  done_.assign(values_.size(), 0);
  const auto root = static_cast<Index>(values_.size() - 1);
  forward(root);
  const std::vector<Real>& value = values_[root];
  double top = minus_infinity;
  for (std::size_t k = 0; k < value.size(); ++k)
    if (value[k] > 0) top = std::max(top, static_cast<double>(std::log(value[k])) + number_weight_logs[k]);
  numbers_.assign(value.size(), 0);
  std::fill(slopes_[root].begin(), slopes_[root].end(), Real(0));
  if (top == minus_infinity) return minus_infinity;
  Real total = 0;
  for (std::size_t k = 0; k < value.size(); ++k) {
    slopes_[root][k] = std::exp(static_cast<Real>(number_weight_logs[k] - top));
    total += slopes_[root][k] * value[k];
  }
  for (std::size_t k = 0; k < value.size(); ++k) {
    slopes_[root][k] /= total;
    numbers_[k] = static_cast<double>(slopes_[root][k] * value[k]);
  }
  return scales_[root] + top + static_cast<double>(std::log(total));
}

void InstanceSums::forward(Index n) {
  if (done_[n]) return;
  done_[n] = 1;
  const InstanceCircuit::Node& node = circuit_.nodes()[n];
  std::vector<Real>& value = values_[n];
  std::fill(value.begin(), value.end(), Real(0));
  for (std::size_t i = 0; i < node.candidates.size(); ++i) used_[n][i] = single_[node.candidates[i]];
  using Kind = InstanceCircuit::Node::Kind;
  if (node.kind == Kind::clique) {
    double top = 0;
    for (const double log_weight : used_[n]) top = std::max(top, log_weight);
    value[0] = std::exp(static_cast<Real>(-top));
    for (std::size_t i = 0; i < node.candidates.size(); ++i)
      if (const auto entry = entry_with(circuit_, node, node.candidates[i]))
        value[*entry] += std::exp(static_cast<Real>(used_[n][i] - top));
    scales_[n] = top;
  } else if (node.kind == Kind::product) {
    forward(node.parts[0]);
    forward(node.parts[1]);
    const std::vector<Real>&a = values_[node.parts[0]], &b = values_[node.parts[1]];
    for_each_product(circuit_, node, [&](Index i, Index j, Index k) { value[k] += a[i] * b[j]; });
    scales_[n] = scales_[node.parts[0]] + scales_[node.parts[1]];
  } else {
    forward(node.parts[0]);
    const std::vector<double> before = single_;
    const Index decided = node.candidates[0];
    for (const Index u : node.weighed) single_[u] += weights_->pair[decided * circuit_.graph().size() + u];
    forward(node.parts[1]);
    if (!node.weighed.empty()) single_ = before;
    const double with = scales_[node.parts[1]] + used_[n][0];
    scales_[n] = std::max(scales_[node.parts[0]], with);
    const Real without_factor = std::exp(static_cast<Real>(scales_[node.parts[0]] - scales_[n]));
    const Real with_factor = std::exp(static_cast<Real>(with - scales_[n]));
    for_each_entry(circuit_, node, node.parts[0],
                   [&](Index i, Index k) { value[k] += without_factor * values_[node.parts[0]][i]; });
    for_each_entry_with(circuit_, node, [&](Index i, Index k) { value[k] += with_factor * values_[node.parts[1]][i]; });
  }
  Real& norm = norms_[n] = *std::max_element(value.begin(), value.end());
  if (!(norm > 0)) {
    norm = 1;
    return;
  }
  for (Real& entry : value) entry /= norm;
  scales_[n] += static_cast<double>(std::log(norm));
}

const std::vector<double>& InstanceSums::marginals() {
  marginals_.assign(circuit_.graph().size(), 0);
  const auto root = static_cast<Index>(values_.size() - 1);
  for (Index n = 0; n < root; ++n) std::fill(slopes_[n].begin(), slopes_[n].end(), Real(0));
  for (Index n = root + 1; n-- > 0;)
    if (done_[n]) backward(n);
  return marginals_;
}

void InstanceSums::backward(Index n) {
  const InstanceCircuit::Node& node = circuit_.nodes()[n];
  std::vector<Real>& slope = slopes_[n];
  for (Real& each : slope) each /= norms_[n];
  // The value was divided by its norm, of which the log went to the scale.
  const double scale = scales_[n] - static_cast<double>(std::log(norms_[n]));
  using Kind = InstanceCircuit::Node::Kind;
  if (node.kind == Kind::clique) {
    for (std::size_t i = 0; i < node.candidates.size(); ++i)
      if (const auto entry = entry_with(circuit_, node, node.candidates[i]))
        marginals_[node.candidates[i]] +=
            static_cast<double>(slope[*entry] * std::exp(static_cast<Real>(used_[n][i] - scale)));
  } else if (node.kind == Kind::product) {
    const std::vector<Real>&a = values_[node.parts[0]], &b = values_[node.parts[1]];
    std::vector<Real>&to_a = slopes_[node.parts[0]], &to_b = slopes_[node.parts[1]];
    for_each_product(circuit_, node, [&](Index i, Index j, Index k) {
      to_a[i] += slope[k] * b[j];
      to_b[j] += slope[k] * a[i];
    });
  } else {
    const Real without_factor = std::exp(static_cast<Real>(scales_[node.parts[0]] - scale));
    const Real with_factor = std::exp(static_cast<Real>(scales_[node.parts[1]] + used_[n][0] - scale));
    for_each_entry(circuit_, node, node.parts[0],
                   [&](Index i, Index k) { slopes_[node.parts[0]][i] += without_factor * slope[k]; });
    Real taken = 0;
    for_each_entry_with(circuit_, node, [&](Index i, Index k) {
      slopes_[node.parts[1]][i] += with_factor * slope[k];
      taken += with_factor * slope[k] * values_[node.parts[1]][i];
    });
    marginals_[node.candidates[0]] += static_cast<double>(taken);
  }
}

}  // namespace toposcope
