// SPDX-License-Identifier: BSD-3-Clause
// Checks that a plugin answers whatever it is given, and comes back when it is asked to.

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <new>
#include <thread>

#include "base/errors.h"
#include "base/run_context.h"
#include "checks.h"

namespace toposcope {
namespace {

using Clock = std::chrono::steady_clock;

std::unique_ptr<Subject::Made> made(const Subject& subject) {
  auto object = subject.make();
  if (object->object() == nullptr) throw Failure("could not be created with its defaults: " + object->refusal());
  return object;
}

/// What the plugin throws, as a failure that names the input.
Answer run(const Trial& trial, const Subject::Made& made, const std::vector<OptionValue>& arguments, Context& context,
           const std::string& with = "") {
  try {
    return trial.run(made.object(), Options(arguments), context);
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& error) {
    throw Failure(fmt::format("on {}{}, threw: {}", trial.name, with, error.what()));
  } catch (...) {
    throw Failure(fmt::format("on {}{}, threw an exception that is not a std::exception", trial.name, with));
  }
}

void refuse_flaw(const Subject& subject, const Trial& trial, const Answer& answer, const std::string& with = "") {
  if (!subject.flawed && !answer.flaw.empty()) throw Failure(fmt::format("on {}{}, {}", trial.name, with, answer.flaw));
}

/// Values at the ends of an option's range; where it has no end, far out.
std::vector<std::string> extremes(const OptionRow& row) {
  if (row.type == OptionType::boolean) return {"false", "true"};
  if (row.type == OptionType::text) return option_choices(row);
  const bool real = row.type == OptionType::real;
  return {row.minimum.empty() ? (real ? "-1e300" : "-2147483647") : row.minimum,
          row.maximum.empty() ? (real ? "1e300" : "2147483647") : row.maximum};
}

/// Values that the kernel must not let through.
std::vector<std::string> beyond(const OptionRow& row) {
  if (row.type == OptionType::boolean) return {"maybe"};
  if (row.type == OptionType::text)
    return option_choices(row).empty() ? std::vector<std::string>() : std::vector<std::string>{"no-such-choice"};
  std::vector<std::string> values = {"nan", "1e999", "ten"};
  const auto past = [&](const std::string& bound, double direction) {
    if (bound.empty()) return;
    const double number = std::stod(bound);
    const double next = row.type == OptionType::integer ? number + direction
                                                        : number + direction * std::max(1e-6, 1e-6 * std::abs(number));
    values.push_back(to_string(row, {.name = row.name, .number = next, .text = ""}));
  };
  past(row.minimum, -1);
  past(row.maximum, 1);
  return values;
}

void expect_refused(const std::vector<OptionRow>& table, const OptionRow& row, const std::string& value) {
  try {
    check_option(table, row.name, value, "");
  } catch (const UsageError&) {
    return;
  }
  throw Failure(fmt::format("option '{}' may be '{}', beyond its range; mend its table", row.name, value));
}

/// Whether the plugin says that a model's arguments make no sense together.
bool refuses(const Subject::Made& object, const std::vector<OptionValue>& arguments, const Trial& trial) {
  RunContext context({.threads = 2, .time_limit_s = 0.3});
  try {
    trial.run(object.object(), Options(arguments), context);
  } catch (const std::invalid_argument&) {
    return true;
  } catch (...) {
    return false;
  }
  return false;
}

/// Everything that a plugin calls throws; `calls` counts.
class ThrowingContext final : public Context {
 public:
  struct Thrown : std::bad_alloc {};
  void log(LogLevel, std::string_view) override { fail(); }
  void progress(double) override { fail(); }
  bool cancelled() const override { return false; }
  std::uint64_t seed() const override { return 1; }
  unsigned threads() const override { return 2; }
  void parallel_for(std::size_t, std::size_t, const std::function<void(std::size_t, std::size_t)>&) override { fail(); }
  std::uint64_t memory_budget() const override { return std::uint64_t{1} << 30; }
  int calls = 0;

 private:
  [[noreturn]] void fail() {
    ++calls;
    throw Thrown();
  }
};

}  // namespace

void settle_arguments(Subject& subject, const TrialSet& trials) {
  const auto object = subject.make();
  if (object->object() == nullptr || !refuses(*object, subject.arguments(), *trials.ordinary.front())) return;
  for (const OptionRow& row : subject.manifest.arguments) {
    if (row.type != OptionType::real && row.type != OptionType::integer) continue;
    const std::vector<GivenOption> given = {{row.name, "1"}};
    try {
      if (refuses(*object, subject.arguments(given), *trials.ordinary.front())) continue;
    } catch (const UsageError&) {
      continue;  // 1 is beyond its range
    }
    subject.settle(given);
    return;
  }
}

std::string check_ordinary(const Subject& subject, const TrialSet& trials) {
  const auto object = made(subject);
  const auto arguments = subject.arguments();
  RunContext context({.threads = 2});
  for (const auto& trial : trials.ordinary) run(*trial, *object, arguments, context);
  return fmt::format("{} inputs", trials.ordinary.size());
}

std::string check_contract(const Subject& subject, const TrialSet& trials) {
  const auto object = made(subject);
  const auto arguments = subject.arguments();
  RunContext context({.threads = 2});
  for (const auto& trial : trials.ordinary) refuse_flaw(subject, *trial, run(*trial, *object, arguments, context));
  return fmt::format("the answers to {} inputs are sound", trials.ordinary.size());
}

std::string check_option_bounds(const Subject& subject, const TrialSet& trials) {
  std::size_t at = 0, past = 0, refused = 0;
  const auto attempt = [&](const Subject::Made& object, const std::vector<OptionValue>& arguments,
                           const std::string& with) {
    // A setting may mean long work: it is cut short, as a user would.
    RunContext context({.threads = 2, .time_limit_s = 0.3});
    const Trial& trial = *trials.ordinary.front();
    refuse_flaw(subject, trial, run(trial, object, arguments, context, with), with);
    ++at;
  };
  for (const OptionRow& row : subject.manifest.options) {
    for (const std::string& value : extremes(row)) {
      const std::string with = fmt::format(" with {} = {}", row.name, value);
      const auto object = subject.make({{row.name, value}});
      // A combination of values may be refused, with a reason.
      if (object->object() == nullptr)
        ++refused;
      else
        attempt(*object, subject.arguments(), with);
    }
    for (const std::string& value : beyond(row)) expect_refused(subject.manifest.options, row, value), ++past;
  }
  for (const OptionRow& row : subject.manifest.arguments) {
    for (const std::string& value : extremes(row)) {
      // So may a combination of arguments, by the table or by std::invalid_argument.
      const auto object = made(subject);
      std::vector<OptionValue> arguments;
      try {
        arguments = subject.arguments({{row.name, value}});
      } catch (const UsageError&) {
        ++refused;
        continue;
      }
      if (refuses(*object, arguments, *trials.ordinary.front()))
        ++refused;
      else
        attempt(*object, arguments, fmt::format(" with {} = {}", row.name, value));
    }
    for (const std::string& value : beyond(row)) expect_refused(subject.manifest.arguments, row, value), ++past;
  }
  if (subject.manifest.options.empty() && subject.manifest.arguments.empty()) return "it has none";
  return fmt::format("{} values at the ends of ranges{}; {} beyond are refused", at,
                     refused == 0 ? "" : fmt::format(", {} more refused with a reason", refused), past);
}

std::string check_degenerate(const Subject& subject, const TrialSet& trials) {
  const auto object = made(subject);
  const auto arguments = subject.arguments();
  RunContext context({.threads = 2});
  for (const auto& trial : trials.degenerate) refuse_flaw(subject, *trial, run(*trial, *object, arguments, context));
  return fmt::format("{} inputs, from {} to {}", trials.degenerate.size(), trials.degenerate.front()->name,
                     trials.degenerate.back()->name);
}

/// The kernel never hands out NaN, so a plugin may refuse it by an exception; it may not crash, hang or pass it on.
std::string check_poisoned(const Subject& subject, const TrialSet& trials) {
  const auto object = made(subject);
  const auto arguments = subject.arguments();
  RunContext context({.threads = 2, .time_limit_s = 5});
  for (const auto& trial : trials.poisoned) {
    Answer answer;
    try {
      answer = trial->run(object->object(), Options(arguments), context);
    } catch (const std::exception&) {
      continue;
    }
    if (!trials.nan_may_pass) refuse_flaw(subject, *trial, answer);
  }
  if (trials.nan_may_pass) return fmt::format("{} inputs are refused or answered", trials.poisoned.size());
  return fmt::format("{} inputs are refused or answered without NaN", trials.poisoned.size());
}

/// What the kernel throws into a plugin must come out of it as it was, and leave the plugin usable.
std::string check_exceptions(const Subject& subject, const TrialSet& trials) {
  const auto object = made(subject);
  const auto arguments = subject.arguments();
  RunContext context({.threads = 1});
  const Trial& trial = *trials.ordinary.front();
  const Answer before = run(trial, *object, arguments, context);
  ThrowingContext throwing;
  bool came_out = false;
  try {
    trial.run(object->object(), Options(arguments), throwing);
  } catch (const ThrowingContext::Thrown&) {
    came_out = true;
  } catch (...) {
    throw Failure("when a call of its context throws, another exception comes out of it; let it through as it is");
  }
  if (throwing.calls > 0 && !came_out)
    throw Failure("when a call of its context throws, it swallows the exception; let it through");
  if (run(trial, *object, arguments, context).bytes != before.bytes)
    throw Failure("after an exception went through it, it answers differently; keep no state");
  return throwing.calls > 0 ? "what its context throws comes out of it"
                            : "it throws none, and its context is not called";
}

std::string check_cancellation(const Subject& subject, const TrialSet& trials, double patience_s) {
  const auto object = made(subject);
  const auto arguments = subject.arguments();
  double longest = 0;
  for (const auto& trial : trials.large)
    for (const double after_s : {0.0, 0.2}) {
      RunContext context({.threads = 2, .time_limit_s = after_s});
      const auto start = Clock::now();
      const std::string with = after_s == 0 ? ", cancelled before it began" : ", cancelled after 0.2 s";
      const Answer answer = run(*trial, *object, arguments, context, with);
      const double took = std::chrono::duration<double>(Clock::now() - start).count();
      if (took > after_s + patience_s)
        throw Failure(fmt::format("on {}{}, it went on for {:.1f} s; ask context.cancelled() in long loops",
                                  trial->name, with, took - after_s));
      refuse_flaw(subject, *trial, answer, with);
      longest = std::max(longest, took - after_s);
    }
  return fmt::format("comes back with a sound answer, {:.1f} s after at most", longest);
}

}  // namespace toposcope
