// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "toposcope/context.h"

namespace toposcope {

struct RunSettings {
  unsigned threads = 0;  ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  std::optional<double> time_limit_s = {};          ///< from the making of the context; then cancelled() is true
  std::optional<std::uint64_t> memory_budget = {};  ///< bytes; by default half of the machine's memory
  /// Called by one thread at a time; may be empty. Must not call the context's log or progress.
  std::function<void(LogLevel, std::string_view)> log = {};
  std::function<void(double)> progress = {};
};

/// The kernel's Context: an arena of oneTBB threads and the callbacks of whoever started the run.
class RunContext final : public Context {
 public:
  explicit RunContext(RunSettings settings = {});
  ~RunContext() override;
  RunContext(const RunContext&) = delete;
  RunContext& operator=(const RunContext&) = delete;

  /// Asks all work to stop; safe in any thread and in a signal handler.
  void cancel() noexcept;

  void log(LogLevel level, std::string_view message) override;
  void progress(double fraction) override;
  bool cancelled() const override;
  std::uint64_t seed() const override;
  unsigned threads() const override;
  /// If chunks throw, the exception of the first of them (by index) comes out, as it would in a plain loop.
  void parallel_for(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t first, std::size_t last)>& body) override;
  std::uint64_t memory_budget() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace toposcope
