// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "toposcope/labeling/tools.h"

namespace toposcope::factors {

/// Thrown where time is out; caught where there is something to fall back on.
struct OutOfTime {};

/// Asks a deadline every so often.
class Watch {
 public:
  explicit Watch(Deadline& deadline) : deadline_(deadline) {}
  /// \param work  steps of about a nanosecond done since the last call
  /// \throw OutOfTime
  void poll(std::size_t work = 1) {
    work_ += work + 1;
    if (work_ < interval) return;
    work_ = 0;
    if (deadline_.reached()) throw OutOfTime{};
  }

 private:
  static constexpr std::size_t interval = 50'000;
  Deadline& deadline_;
  std::size_t work_ = interval;
};

}  // namespace toposcope::factors
