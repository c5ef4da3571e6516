// SPDX-License-Identifier: BSD-3-Clause
#include "hitting_set.h"

namespace toposcope {
namespace {

using Sets = std::vector<std::vector<std::size_t>>;

class Search {
 public:
  Search(const Sets& sets, std::size_t items, std::size_t limit, Deadline& deadline, std::vector<std::size_t>& found)
      : sets_(sets), limit_(limit), deadline_(deadline), found_(found), chosen_(items, 0), barred_(items, 0) {}

  bool run() {
    descend();
    return any_ && !stopped_;
  }

 private:
  bool hit(const std::vector<std::size_t>& set) const {
    for (const std::size_t item : set)
      if (chosen_[item] != 0) return true;
    return false;
  }

  // Sets not yet hit that have no item in common: each needs an item of its own.
  std::size_t disjoint() {
    touched_.assign(chosen_.size(), 0);
    std::size_t count = 0;
    for (const std::vector<std::size_t>& set : sets_) {
      bool apart = !hit(set);
      for (std::size_t k = 0; k < set.size() && apart; ++k) apart = touched_[set[k]] == 0;
      if (!apart) continue;
      ++count;
      for (const std::size_t item : set) touched_[item] = 1;
    }
    return count;
  }

  void descend() {
    if ((++nodes_ & 63U) == 0) stopped_ = stopped_ || deadline_.reached();
    if (stopped_ || count_ + disjoint() >= limit_) return;
    const std::vector<std::size_t>* fewest = nullptr;
    std::size_t least = 0;
    for (const std::vector<std::size_t>& set : sets_) {
      if (hit(set)) continue;
      std::size_t open = 0;
      for (const std::size_t item : set) open += barred_[item] == 0;
      if (open == 0) return;
      if (fewest == nullptr || open < least) {
        fewest = &set;
        least = open;
      }
    }
    if (fewest == nullptr) {
      found_.clear();
      for (std::size_t item = 0; item < chosen_.size(); ++item)
        if (chosen_[item] != 0) found_.push_back(item);
      any_ = true;
      limit_ = count_;
      return;
    }
    std::vector<std::size_t> tried;
    for (const std::size_t item : *fewest) {
      if (barred_[item] != 0) continue;
      chosen_[item] = 1;
      ++count_;
      descend();
      --count_;
      chosen_[item] = 0;
      barred_[item] = 1;  // the others are tried without it
      tried.push_back(item);
    }
    for (const std::size_t item : tried) barred_[item] = 0;
  }

  const Sets& sets_;
  std::size_t limit_;
  Deadline& deadline_;
  std::vector<std::size_t>& found_;
  std::vector<char> chosen_, barred_, touched_;
  std::size_t count_ = 0, nodes_ = 0;
  bool any_ = false, stopped_ = false;
};

}  // namespace

bool smallest_hitting_set(const Sets& sets, std::size_t items, std::size_t limit, Deadline& deadline,
                          std::vector<std::size_t>& found) {
  return Search(sets, items, limit, deadline, found).run();
}

}  // namespace toposcope
