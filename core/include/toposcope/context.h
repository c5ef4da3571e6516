// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace toposcope {

enum class LogLevel { debug, info, warning, error };

/// What a computation needs of its surroundings: log, progress, cancelling, seed, executor, memory. There are no
/// globals and no other output. Every member may be called from any thread.
class Context {
 public:
  virtual ~Context() = default;

  /// Takes one line, without its end.
  virtual void log(LogLevel level, std::string_view message) = 0;
  /// \param fraction of the present station, 0 to 1
  virtual void progress(double fraction) = 0;
  /// True once the user (or a time limit) asked to stop: return at once with the best answer so far.
  virtual bool cancelled() const = 0;
  /// Of everything drawn at random: the same seed gives the same answer.
  virtual std::uint64_t seed() const = 0;
  /// How many run `parallel_for`'s chunks, at least 1.
  virtual unsigned threads() const = 0;
  /// Runs `body(first, last)` over disjoint chunks of [0, count), in parallel where it pays. Chunks are cut by
  /// `grain` alone, never by the thread count: write results by index and they are the same at any thread count.
  virtual void parallel_for(std::size_t count, std::size_t grain,
                            const std::function<void(std::size_t first, std::size_t last)>& body) = 0;
  /// Bytes that one computation may take at a time. Whoever is about to grow beyond them does not, and says how many
  /// it would need.
  virtual std::uint64_t memory_budget() const = 0;
};

}  // namespace toposcope
