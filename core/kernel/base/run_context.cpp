// SPDX-License-Identifier: BSD-3-Clause
#include "base/run_context.h"

#include <signal.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace toposcope {
namespace {

using Clock = std::chrono::steady_clock;

unsigned machine_threads() {
  return static_cast<unsigned>(std::max(1, tbb::info::default_concurrency()));
}

std::uint64_t machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  constexpr std::uint64_t unknown = std::uint64_t{4} << 30;
  return pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) : unknown;
}

/// The failure that a plain loop would have met: that of the lowest chunk. Chunks above a failed one are skipped,
/// chunks below it still run.
class FirstFailure {
 public:
  bool skips(std::size_t chunk) const { return chunk > chunk_.load(std::memory_order_relaxed); }
  void record(std::size_t chunk, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (chunk >= chunk_.load(std::memory_order_relaxed)) return;
    chunk_.store(chunk, std::memory_order_relaxed);
    error_ = std::move(error);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::atomic<std::size_t> chunk_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
};

#if defined(__SANITIZE_THREAD__)
/// The distribution's oneTBB is not instrumented: the sanitizer would report its every hand-over and hide real races.
template <class Run>
void run_all(tbb::task_arena&, unsigned threads, std::size_t chunks, const Run& run) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) run(chunk);
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
  work();
}
#else
/// Isolated: a thread that waits here must not pick up a chunk of an outer loop, whose state it is in the midst of.
template <class Run>
void run_all(tbb::task_arena& arena, unsigned, std::size_t chunks, const Run& run) {
  arena.execute([&] { tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, chunks, run); }); });
}
#endif

/// A signal goes to a thread of the caller, who knows when it may end the program, and never to a worker.
class SignalsToTheCaller final : public tbb::task_scheduler_observer {
 public:
  explicit SignalsToTheCaller(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) { observe(true); }
  ~SignalsToTheCaller() override { observe(false); }
  void on_scheduler_entry(bool worker) override {
    if (!worker) return;
    sigset_t ending;
    sigemptyset(&ending);
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, each);
    pthread_sigmask(SIG_BLOCK, &ending, nullptr);
  }
};

/// oneTBB makes no more threads than cores unless told to, before there is an arena.
std::unique_ptr<tbb::global_control> more_than_cores(unsigned threads) {
  if (threads <= machine_threads()) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

}  // namespace

struct RunContext::State {
  explicit State(RunSettings given)
      : settings(std::move(given)),
        threads(settings.threads == 0 ? machine_threads() : settings.threads),
        more_threads(more_than_cores(threads)),
        arena(static_cast<int>(threads)) {
    if (settings.time_limit_s)
      deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(std::clamp(*settings.time_limit_s, 0.0, 1e9)));
  }

  RunSettings settings;
  unsigned threads;
  std::unique_ptr<tbb::global_control> more_threads;
  tbb::task_arena arena;
  SignalsToTheCaller signals{arena};
  std::optional<Clock::time_point> deadline;
  std::atomic<bool> cancelled = false;
  std::mutex callbacks;
};

RunContext::RunContext(RunSettings settings) : state_(std::make_unique<State>(std::move(settings))) {}
RunContext::~RunContext() = default;

void RunContext::cancel() noexcept {
  state_->cancelled.store(true, std::memory_order_relaxed);
}

void RunContext::log(LogLevel level, std::string_view message) {
  if (!state_->settings.log) return;
  const std::lock_guard lock(state_->callbacks);
  state_->settings.log(level, message);
}

void RunContext::progress(double fraction) {
  if (!state_->settings.progress) return;
  const std::lock_guard lock(state_->callbacks);
  state_->settings.progress(std::clamp(fraction, 0.0, 1.0));
}

bool RunContext::cancelled() const {
  return state_->cancelled.load(std::memory_order_relaxed) || (state_->deadline && Clock::now() >= *state_->deadline);
}

std::uint64_t RunContext::seed() const {
  return state_->settings.seed;
}

std::uint64_t RunContext::memory_budget() const {
  return state_->settings.memory_budget.value_or(machine_memory() / 2);
}

unsigned RunContext::threads() const {
  return state_->threads;
}

void RunContext::parallel_for(std::size_t count, std::size_t grain,
                              const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t chunks = count / grain + (count % grain != 0);
  if (state_->threads == 1 || chunks <= 1) {
    for (std::size_t first = 0; first < count; first += std::min(grain, count - first))
      body(first, first + std::min(grain, count - first));
    return;
  }
  FirstFailure failure;
  const auto run = [&](std::size_t chunk) {
    if (failure.skips(chunk)) return;
    try {
      body(chunk * grain, chunk * grain + std::min(grain, count - chunk * grain));
    } catch (...) {
      failure.record(chunk, std::current_exception());
    }
  };
  run_all(state_->arena, state_->threads, chunks, run);
  failure.rethrow();
}

}  // namespace toposcope
