// SPDX-License-Identifier: BSD-3-Clause
#include "examination.h"

#include <fmt/format.h>

#include <functional>

#include "base/errors.h"
#include "checks.h"
#include "plugin/library.h"

namespace toposcope {
namespace {

/// Runs checks one after the other; a check throws Failure, or whatever the plugin throws.
class Examiner {
 public:
  explicit Examiner(VerdictSink& sink) : sink_(sink) {}

  /// \return true when it passed or was skipped
  bool check(const std::string& name, const std::function<std::string()>& body) {
    sink_.begin(name);
    try {
      sink_.end({name, Outcome::passed, body()});
      return true;
    } catch (const Failure& failure) {
      sink_.end({name, Outcome::failed, failure.what()});
    } catch (const std::exception& error) {
      sink_.end({name, Outcome::failed, std::string("threw: ") + error.what()});
    } catch (...) {
      sink_.end({name, Outcome::failed, "threw an exception that is not a std::exception"});
    }
    return false;
  }
  void skip(const std::string& name, const std::string& why) { sink_.end({name, Outcome::skipped, why}); }

 private:
  VerdictSink& sink_;
};

/// Says what the plugin gets, before it gets it.
class AnnouncedTrial final : public Trial {
 public:
  AnnouncedTrial(std::unique_ptr<const Trial> trial, VerdictSink& sink)
      : Trial(trial->name), trial_(std::move(trial)), sink_(sink) {}
  Answer run(const void* object, const Options& arguments, Context& context) const override {
    sink_.on(name);
    return trial_->run(object, arguments, context);
  }
  std::unique_ptr<Trial> moved(const Motion& motion) const override {
    return std::make_unique<AnnouncedTrial>(trial_->moved(motion), sink_);
  }
  std::string change(const Answer& before, const Answer& after, const Motion& motion) const override {
    return trial_->change(before, after, motion);
  }

 private:
  std::unique_ptr<const Trial> trial_;
  VerdictSink& sink_;
};

TrialSet announced(TrialSet trials, VerdictSink& sink) {
  for (Trials* list : {&trials.ordinary, &trials.degenerate, &trials.poisoned, &trials.large})
    for (auto& trial : *list) trial = std::make_unique<const AnnouncedTrial>(std::move(trial), sink);
  return trials;
}

std::string after_id(const PluginError& error) {
  const std::string text = error.what(), head = "plugin '" + error.plugin + "': ";
  return text.starts_with(head) ? text.substr(head.size()) : text;
}

}  // namespace

void examine_plugin(const std::filesystem::path& library, const Examination& examination, VerdictSink& sink) {
  Examiner examiner(sink);
  PluginManifest manifest;
  const PluginDescriptor* descriptor = nullptr;
  const bool sound = examiner.check("manifest", [&]() -> std::string {
    std::filesystem::path file = library;
    file.replace_extension();
    file += manifest_suffix;
    try {
      if (!std::filesystem::exists(file))
        throw Failure("its manifest '" + file.string() +
                      "' is not beside it; build the plugin with toposcope_add_plugin");
      manifest = read_manifest(file);
      descriptor = &load_plugin_library(library, manifest.id);
      check_agreement(manifest, *descriptor);
    } catch (const PluginError& error) {
      throw Failure(after_id(error));
    }
    return fmt::format("manifest and library agree; ABI {}.{}", manifest.abi_major, manifest.abi_minor);
  });
  if (!sound) return;
  if (const std::string missing = missing_programs(manifest); !missing.empty()) {
    examiner.skip("run", missing);
    return;
  }
  Subject subject(manifest, *descriptor);
  const TrialSet trials = announced(trials_for(manifest), sink);
  settle_arguments(subject, trials);
  if (!examiner.check("ordinary input", [&] { return check_ordinary(subject, trials); })) {
    examiner.skip("the others", "a plugin that fails on ordinary input is not tried further");
    return;
  }
  if (examination.brief) {
    examiner.check("degenerate input", [&] { return check_degenerate(subject, trials); });
    return;
  }
  subject.flawed = !examiner.check("contract", [&] { return check_contract(subject, trials); });
  examiner.check("options", [&] { return check_option_bounds(subject, trials); });
  examiner.check("degenerate input", [&] { return check_degenerate(subject, trials); });
  examiner.check("NaN", [&] { return check_poisoned(subject, trials); });
  examiner.check("exceptions", [&] { return check_exceptions(subject, trials); });
  examiner.check("cancellation", [&] { return check_cancellation(subject, trials, examination.patience_s); });
  if (!examiner.check("repeat", [&] { return check_repeat(subject, trials); })) {
    for (const char* name : {"threads", "invariance"})
      examiner.skip(name, "answers that change from run to run cannot be compared");
    return;
  }
  examiner.check("threads", [&] { return check_threads(subject, trials); });
  if (trials.pose) {
    examiner.check("rotation", [&] { return check_rotation(subject, trials); });
    examiner.check("translation", [&] { return check_translation(subject, trials); });
    examiner.check("scale", [&] { return check_scale(subject, trials); });
  }
  examiner.check("order", [&] { return check_order(subject, trials); });
}

}  // namespace toposcope
