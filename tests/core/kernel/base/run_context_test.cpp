// SPDX-License-Identifier: BSD-3-Clause
#include "base/run_context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace toposcope {
namespace {

RunSettings with_threads(unsigned threads) {
  RunSettings settings;
  settings.threads = threads;
  return settings;
}

using Chunks = std::set<std::pair<std::size_t, std::size_t>>;

Chunks chunks_of(std::size_t count, std::size_t grain, unsigned threads) {
  RunContext context(with_threads(threads));
  Chunks chunks;
  std::mutex mutex;
  context.parallel_for(count, grain, [&](std::size_t first, std::size_t last) {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(chunks.emplace(first, last).second);
  });
  return chunks;
}

TEST(RunContext, MayTakeHalfOfTheMemoryUnlessToldOtherwise) {
  EXPECT_GT(RunContext().memory_budget(), std::uint64_t{1} << 26);
  RunSettings settings;
  settings.memory_budget = 12345;
  EXPECT_EQ(RunContext(settings).memory_budget(), 12345U);
}

TEST(RunContext, ChunksAreCutByGrainAlone) {
  const Chunks expected = {{0, 4}, {4, 8}, {8, 10}};
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    EXPECT_EQ(chunks_of(10, 4, threads), expected) << threads;
    EXPECT_EQ(chunks_of(8, 4, threads), (Chunks{{0, 4}, {4, 8}})) << threads;
    EXPECT_EQ(chunks_of(3, 4, threads), (Chunks{{0, 3}})) << threads;
    EXPECT_EQ(chunks_of(2, 0, threads), (Chunks{{0, 1}, {1, 2}})) << threads;
    EXPECT_TRUE(chunks_of(0, 4, threads).empty()) << threads;
    EXPECT_EQ(chunks_of(5, static_cast<std::size_t>(-1), threads), (Chunks{{0, 5}})) << threads;
  }
}

TEST(RunContext, NestedLoopsDoEveryChunkOnce) {
  RunContext context(with_threads(4));
  std::vector<std::atomic<int>> visits(20 * 30);
  context.parallel_for(20, 1, [&](std::size_t outer, std::size_t) {
    context.parallel_for(30, 1, [&](std::size_t inner, std::size_t) { ++visits[outer * 30 + inner]; });
  });
  EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& count) { return count == 1; }));
}

TEST(RunContext, ANestedLoopDoesNotRunAnotherOuterChunk) {
  RunContext context(with_threads(4));
  std::atomic<bool> interleaved = false;
  context.parallel_for(64, 1, [&](std::size_t, std::size_t) {
    thread_local bool busy = false;
    if (busy) interleaved = true;
    busy = true;
    context.parallel_for(64, 1, [](std::size_t, std::size_t) { std::this_thread::yield(); });
    busy = false;
  });
  EXPECT_FALSE(interleaved);
}

TEST(RunContext, TheFirstFailureComesOut) {
  for (const unsigned threads : {1U, 2U, 8U}) {
    RunContext context(with_threads(threads));
    for (int round = 0; round < 50; ++round) {
      try {
        context.parallel_for(200, 1, [](std::size_t chunk, std::size_t) {
          if (chunk >= 17 && chunk % 2 == 1) throw std::runtime_error(std::to_string(chunk));
        });
        FAIL() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "17") << threads;
      }
    }
  }
}

TEST(RunContext, CancelsWhenAsked) {
  RunContext context;
  EXPECT_FALSE(context.cancelled());
  context.cancel();
  EXPECT_TRUE(context.cancelled());
}

TEST(RunContext, CancelsAtItsDeadline) {
  RunSettings over, far;
  over.time_limit_s = 0;
  far.time_limit_s = 1e300;
  EXPECT_TRUE(RunContext(over).cancelled());
  EXPECT_FALSE(RunContext(far).cancelled());
}

TEST(RunContext, CallbacksAreCalledByOneThreadAtATime) {
  RunSettings settings = with_threads(4);
  std::vector<std::string> messages;  // no lock of its own: the sanitizer runs would see a race
  double last = -1;
  settings.log = [&](LogLevel, std::string_view message) { messages.emplace_back(message); };
  settings.progress = [&](double fraction) { last = fraction; };
  RunContext context(settings);
  context.parallel_for(1000, 1, [&](std::size_t i, std::size_t) { context.log(LogLevel::info, std::to_string(i)); });
  EXPECT_EQ(messages.size(), 1000);
  EXPECT_EQ(std::set<std::string>(messages.begin(), messages.end()).size(), 1000);
  context.progress(7);
  EXPECT_EQ(last, 1);
}

TEST(RunContext, KnowsItsSettings) {
  RunSettings settings = with_threads(3);
  settings.seed = 42;
  RunContext context(settings);
  EXPECT_EQ(context.threads(), 3);
  EXPECT_EQ(context.seed(), 42);
  EXPECT_GE(RunContext().threads(), 1);
  context.log(LogLevel::error, "no callback, no output");
}

}  // namespace
}  // namespace toposcope
