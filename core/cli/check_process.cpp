// SPDX-License-Identifier: BSD-3-Clause
#include "check_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/errors.h"
#include "examination.h"
#include "interruption.h"
#include "toposcope/system/programs.h"
#include "toposcope/system/spawn.h"
#include "toposcope/system/temporary_folder.h"

extern "C" char** environ;  // NOLINT(readability-redundant-declaration)

namespace toposcope::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int report_descriptor = 3;
constexpr int patience_ms = 120'000;         // for one check
constexpr int memory_patience_ms = 900'000;  // valgrind makes it thirty times slower
constexpr int memory_errors_exit_code = 77;

/// A folder for all that a check leaves behind, removed with what is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(temporary_folder("check")) {}
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A file's first line that says something, cut to a readable length; empty where there is none.
std::string first_line(const std::string& file, std::string_view containing = "") {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && line.find(containing) != line.npos) return line.substr(0, 160);
  return "";
}

/// The environment with another folder for temporary files.
std::vector<std::string> environment_with(const std::string& temporary) {
  std::vector<std::string> all = {"TMPDIR=" + temporary};
  for (char** each = environ; *each; ++each)
    if (!std::string_view(*each).starts_with("TMPDIR=")) all.emplace_back(*each);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& each : texts) all.push_back(each.data());
  all.push_back(nullptr);
  return all;
}

std::string own_program() {
  return fs::read_symlink("/proc/self/exe").string();
}

/// A child in a process group of its own, whose output goes to a file and whose report comes line by line.
class Child {
 public:
  Child(std::vector<std::string> command, const std::string& output, const TemporaryFolder& folder,
        const Context& context)
      : context_(context) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("no pipe: ") + std::strerror(errno), 1);
    report_ = ends[0];
    std::vector<std::string> environment = environment_with(folder.path());
    const SpawnAttributes attributes(POSIX_SPAWN_SETPGROUP);  // to be ended with all that it has started
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND,
                                     0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], report_descriptor);
    const int error = posix_spawn(&process_, command[0].c_str(), &actions, attributes.get(), pointers(command).data(),
                                  pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error != 0) throw Error(command[0] + " cannot be started: " + std::strerror(error), 1);
    group_ = process_;
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    close(report_);
    if (group_ > 0) kill(-group_, SIGKILL);
    if (process_ > 0) waitpid(process_, nullptr, 0);
  }

  enum class Read { line, end, silence };
  /// The next line of the report.
  Read next(std::string& line, int timeout_ms) {
    for (;;) {
      if (const std::size_t at = buffer_.find('\n'); at != buffer_.npos) {
        line = buffer_.substr(0, at);
        buffer_.erase(0, at + 1);
        return Read::line;
      }
      if (!wait(timeout_ms)) return Read::silence;
      char bytes[4096];
      const ssize_t count = read(report_, bytes, sizeof bytes);
      if (count <= 0) return Read::end;
      buffer_.append(bytes, static_cast<std::size_t>(count));
    }
  }

  /// In words, after its report has ended.
  std::string end(int& exit_code) {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) stop_if_cancelled(context_, undone);
    process_ = 0;
    exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (WIFSIGNALED(status)) return fmt::format("crashed: {}", strsignal(WTERMSIG(status)));
    return fmt::format("ended the process with exit code {}", exit_code);
  }

 private:
  static constexpr const char* undone = "the plugin at hand and those after it were not checked";

  /// For something to read, in short turns: a signal may come between asking and waiting. \return false: in vain
  bool wait(int timeout_ms) const {
    constexpr int turn_ms = 100;
    for (int waited = 0; waited < timeout_ms; waited += turn_ms) {
      stop_if_cancelled(context_, undone);
      pollfd waiting{report_, POLLIN, 0};
      if (poll(&waiting, 1, turn_ms) > 0) return true;
    }
    return false;
  }

  const Context& context_;
  pid_t process_ = 0, group_ = 0;
  int report_ = -1;
  std::string buffer_;
};

Outcome outcome_of(const std::string& word) {
  return word == "ok" ? Outcome::passed : word == "skip" ? Outcome::skipped : Outcome::failed;
}

/// Writes what examine_in_process reads.
class ReportSink final : public VerdictSink {
 public:
  void begin(const std::string& check) override { line({{"begin", check}}); }
  void on(const std::string& input) override { line({{"on", input}}); }
  void end(const CheckVerdict& verdict) override {
    const char* outcome = verdict.outcome == Outcome::passed   ? "ok"
                          : verdict.outcome == Outcome::failed ? "fail"
                                                               : "skip";
    line({{"check", verdict.check}, {"outcome", outcome}, {"detail", verdict.detail}});
  }
  void done() { line({{"done", true}}); }

 private:
  static void line(const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t count = write(report_descriptor, text.data() + at, text.size() - at);
      if (count <= 0) return;
      at += static_cast<std::size_t>(count);
    }
  }
};

/// \param valgrind  the program
CheckVerdict memory_of(const std::vector<fs::path>& libraries, const std::string& valgrind, const Context& context) {
  const TemporaryFolder folder;
  const std::string log = folder.file("log");
  std::vector<std::string> command = {valgrind,
                                      "--quiet",
                                      "--leak-check=full",
                                      "--show-leak-kinds=definite",
                                      "--errors-for-leak-kinds=definite",
                                      fmt::format("--error-exitcode={}", memory_errors_exit_code),
                                      "--log-file=" + log,
                                      own_program(),
                                      "plugins",
                                      "check",
                                      "--brief",
                                      "--child"};
  for (const fs::path& library : libraries) command.push_back(library.string());
  Child child(std::move(command), folder.file("output"), folder, context);
  std::string line;
  bool done = false;
  Child::Read read = Child::Read::end;
  while (!done && (read = child.next(line, memory_patience_ms)) == Child::Read::line)
    done = Json::parse(line).contains("done");
  if (read == Child::Read::silence) return {"memory", Outcome::failed, "did not come back under valgrind"};
  int exit_code = 0;
  const std::string words = child.end(exit_code);
  if (done && exit_code == 0) return {"memory", Outcome::passed, "under valgrind no leak and no access out of bounds"};
  if (exit_code != memory_errors_exit_code) return {"memory", Outcome::failed, words + " under valgrind"};
  std::string what = first_line(log, "lost in loss record");
  if (what.empty()) what = first_line(log);
  return {"memory", Outcome::failed,
          "valgrind: " + what.substr(what.find("== ") == what.npos ? 0 : what.find("== ") + 3)};
}

}  // namespace

std::vector<CheckVerdict> examine_in_process(const fs::path& library, const Context& context) {
  const TemporaryFolder folder;
  const std::string output = folder.file("output");
  Child child({own_program(), "plugins", "check", "--child", library.string()}, output, folder, context);
  std::vector<CheckVerdict> verdicts;
  std::string line, begun = "start", on;
  bool done = false;
  Child::Read read = Child::Read::end;
  while (!done && (read = child.next(line, patience_ms)) == Child::Read::line) {
    const Json json = Json::parse(line);
    done = json.contains("done");
    if (json.contains("begin")) begun = json["begin"], on.clear();
    if (json.contains("on")) on = "on " + json["on"].get<std::string>() + ", ";
    if (json.contains("check")) verdicts.push_back({json["check"], outcome_of(json["outcome"]), json["detail"]});
    if (json.contains("check")) begun = "end", on.clear();
  }
  if (read == Child::Read::silence) {
    verdicts.push_back({begun, Outcome::failed, fmt::format("{}did not come back in {} s", on, patience_ms / 1000)});
    return verdicts;
  }
  int exit_code = 0;
  const std::string words = child.end(exit_code);
  const std::string said = first_line(output);
  if (!done || exit_code != 0)
    verdicts.push_back({begun, Outcome::failed, on + words + (said.empty() ? "" : " (" + said + ")")});
  else if (!said.empty())
    verdicts.push_back({"output", Outcome::failed,
                        "it writes '" + said + "' to the terminal; a plugin says things through its context's log"});
  return verdicts;
}

std::vector<CheckVerdict> examine_memory(const std::vector<fs::path>& libraries,
                                         [[maybe_unused]] const Context& context) {
  const auto skipped = [&](const char* why) {
    return std::vector<CheckVerdict>(libraries.size(), {"memory", Outcome::skipped, why});
  };
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return skipped("valgrind and a sanitizer do not go together; the sanitizer checked it");
#endif
  const auto valgrind = find_program("valgrind");
  if (!valgrind) return skipped("valgrind is not installed (apt-get install valgrind)");
  std::vector<CheckVerdict> verdicts(libraries.size());
  if (libraries.size() > 1) {
    const CheckVerdict together = memory_of(libraries, valgrind->string(), context);
    if (together.outcome == Outcome::passed) return std::vector<CheckVerdict>(libraries.size(), together);
  }
  std::transform(libraries.begin(), libraries.end(), verdicts.begin(),
                 [&](const fs::path& library) { return memory_of({library}, valgrind->string(), context); });
  return verdicts;
}

int examine_here(const std::vector<fs::path>& libraries, bool brief) {
  // No core file for a crash that is expected, and no machine brought to its knees by a plugin that eats memory.
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const rlimit memory{rlim_t{8} << 30, rlim_t{8} << 30};
  if (!brief) setrlimit(RLIMIT_AS, &memory);
#endif
  ReportSink sink;
  for (const fs::path& library : libraries) examine_plugin(library, {.brief = brief}, sink);
  sink.done();
  return 0;
}

}  // namespace toposcope::cli
