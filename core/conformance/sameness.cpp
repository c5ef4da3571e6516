// SPDX-License-Identifier: BSD-3-Clause
// Checks that a plugin's answers are the same where they must be.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <thread>

#include "base/run_context.h"
#include "checks.h"
#include "inputs.h"

namespace toposcope {
namespace {

/// Every ordinary input moved, against itself.
std::string compare(const Subject& subject, const TrialSet& trials, const std::vector<Motion>& motions,
                    const std::string& what) {
  const auto object = subject.make();
  const auto arguments = subject.arguments();
  RunContext context({.threads = 1});
  for (const auto& trial : trials.ordinary) {
    const Answer before = trial->run(object->object(), Options(arguments), context);
    for (const Motion& motion : motions) {
      const auto moved = trial->moved(motion);
      const auto scaled = subject.arguments({}, motion.scale);
      const Answer after = moved->run(object->object(), Options(scaled), context);
      if (!subject.flawed && !after.flaw.empty())
        throw Failure(fmt::format("on {}, {}: {}", trial->name, what, after.flaw));
      if (const std::string change = trial->change(before, after, motion); !change.empty())
        throw Failure(fmt::format("{}: {}", what, change));
    }
  }
  return fmt::format("{} inputs, {} times {}", trials.ordinary.size(), motions.size(), what);
}

}  // namespace

std::string check_repeat(const Subject& subject, const TrialSet& trials) {
  const auto object = subject.make(), other = subject.make();
  const auto arguments = subject.arguments();
  RunContext context({.threads = 1});
  for (const auto& trial : trials.ordinary) {
    const std::string first = trial->run(object->object(), Options(arguments), context).bytes;
    if (trial->run(object->object(), Options(arguments), context).bytes != first)
      throw Failure("on " + trial->name +
                    ", asked again, it answers differently; keep no state, take the context's seed");
    if (trial->run(other->object(), Options(arguments), context).bytes != first)
      throw Failure("on " + trial->name + ", another object of it answers differently");
  }
  return fmt::format("{} inputs, three times, bit for bit", trials.ordinary.size());
}

std::string check_threads(const Subject& subject, const TrialSet& trials) {
  const auto object = subject.make();
  const auto arguments = subject.arguments();
  for (const auto& trial : trials.ordinary) {
    std::string first;
    for (const unsigned threads : {1U, 2U, 3U, 7U}) {
      RunContext context({.threads = threads});
      const std::string bytes = trial->run(object->object(), Options(arguments), context).bytes;
      if (threads == 1) first = bytes;
      if (bytes != first)
        throw Failure(
            fmt::format("on {}, the answer with {} threads is another than with 1; cut work by grain alone and "
                        "write results by index",
                        trial->name, threads));
    }
    // And called by several threads at once.
    std::vector<std::string> answers(4);
    {
      std::vector<std::jthread> callers;
      for (std::string& answer : answers)
        callers.emplace_back([&] {
          RunContext context({.threads = 1});
          try {
            answer = trial->run(object->object(), Options(arguments), context).bytes;
          } catch (...) {
            answer = "threw";
          }
        });
    }
    for (const std::string& answer : answers)
      if (answer != first)
        throw Failure("on " + trial->name + ", called by four threads at once, it answers differently; keep no state");
  }
  return fmt::format("{} inputs with 1, 2, 3 and 7 threads and from 4 threads at once, bit for bit",
                     trials.ordinary.size());
}

std::string check_rotation(const Subject& subject, const TrialSet& trials) {
  std::vector<Motion> motions;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) motions.push_back({.rotation = random_rotation(seed)});
  return compare(subject, trials, motions, "turned");
}

std::string check_translation(const Subject& subject, const TrialSet& trials) {
  return compare(subject, trials, {{.shift = {3, -5, 7}}, {.shift = {-40, 20, 10}}}, "shifted");
}

std::string check_scale(const Subject& subject, const TrialSet& trials) {
  return compare(subject, trials, {{.scale = 1e-3}, {.scale = 37}, {.scale = 1e3}}, "scaled");
}

std::string check_order(const Subject& subject, const TrialSet& trials) {
  return compare(subject, trials, {{.shuffle = 1}, {.shuffle = 2}}, "in another order");
}

}  // namespace toposcope
