// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_trial.h"

#include <limits>
#include <numeric>

namespace toposcope {

MeshTrial::MeshTrial(std::string called, TriangleSoup soup, Poison poison)
    : Trial(std::move(called)), soup_(std::move(soup)), mesh_(soup_, name), view_(mesh_.view()) {
  if (poison == Poison::none) return;
  const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  poisoned_ = soup_.positions;
  if (poison == Poison::all) poisoned_.assign(poisoned_.size(), none);
  poisoned_[poisoned_.size() / 2] = none;
  view_.positions = poisoned_;
}

std::vector<Index> MeshTrial::vertex_order(const Motion& motion) const {
  if (motion.shuffle == 0) return {};
  // As moved() draws it: first the order of the vertices.
  std::vector<Index> old_of(soup_.positions.size());
  std::iota(old_of.begin(), old_of.end(), Index{0});
  Random(motion.shuffle).shuffle(old_of);
  return old_of;
}

TrialSet mesh_trials(const std::function<std::unique_ptr<Trial>(std::string, TriangleSoup, Poison)>& make) {
  TrialSet set;
  set.ordinary.push_back(make("an uneven torus", uneven_torus(48, 20), Poison::none));
  set.ordinary.push_back(make("a wavy sheet", wavy_sheet(36, 26), Poison::none));
  set.ordinary.push_back(make("a block", block(14), Poison::none));
  for (NamedSoup& each : degenerate_soups())
    set.degenerate.push_back(make(std::move(each.name), std::move(each.soup), Poison::none));
  set.poisoned.push_back(make("a torus with one vertex that is NaN", uneven_torus(24, 12), Poison::one_vertex));
  set.poisoned.push_back(make("a torus of nothing but NaN", uneven_torus(24, 12), Poison::all));
  set.large.push_back(make("a torus of 100,000 faces", uneven_torus(320, 157), Poison::none));
  return set;
}

}  // namespace toposcope
