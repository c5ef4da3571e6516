// SPDX-License-Identifier: BSD-3-Clause
#include "check_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/errors.h"
#include "examination.h"
#include "toposcope/system/programs.h"

extern "C" char** environ;  // NOLINT(readability-redundant-declaration)

namespace toposcope::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int report_descriptor = 3;
constexpr int patience_ms = 120'000;         // for one check
constexpr int memory_patience_ms = 900'000;  // valgrind makes it thirty times slower
constexpr int memory_errors_exit_code = 77;

/// A file of its own, removed at the end.
class TemporaryFile {
 public:
  TemporaryFile() : path_((fs::temp_directory_path() / "toposcope-check-XXXXXX").string()) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0)
      throw Error("the file " + path_ + " cannot be made (" + std::strerror(errno) + "); set TMPDIR to a folder that " +
                      "may be written",
                  1);
    close(descriptor);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { unlink(path_.c_str()); }
  const std::string& path() const { return path_; }
  /// Its first line that says something, cut to a readable length; empty where there is none.
  std::string first_line(std::string_view containing = "") const {
    std::ifstream stream(path_);
    for (std::string line; std::getline(stream, line);)
      if (!line.empty() && line.find(containing) != line.npos) return line.substr(0, 160);
    return "";
  }

 private:
  std::string path_;
};

std::string own_program() {
  return fs::read_symlink("/proc/self/exe").string();
}

/// A child whose output goes to a file and whose report comes line by line.
class Child {
 public:
  Child(std::vector<std::string> command, const std::string& output) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("no pipe: ") + std::strerror(errno), 1);
    report_ = ends[0];
    std::vector<char*> argv;
    for (std::string& each : command) argv.push_back(each.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_TRUNC | O_APPEND, 0);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], report_descriptor);
    const int error = posix_spawn(&process_, command[0].c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error != 0) throw Error(command[0] + " cannot be started: " + std::strerror(error), 1);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    close(report_);
    if (process_ > 0) kill(process_, SIGKILL), waitpid(process_, nullptr, 0);
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
      pollfd waiting{report_, POLLIN, 0};
      const int ready = poll(&waiting, 1, timeout_ms);
      if (ready < 0 && errno == EINTR) continue;
      if (ready <= 0) return Read::silence;
      char bytes[4096];
      const ssize_t count = read(report_, bytes, sizeof bytes);
      if (count <= 0) return Read::end;
      buffer_.append(bytes, static_cast<std::size_t>(count));
    }
  }

  /// In words, after its report has ended.
  std::string end(int& exit_code) {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (WIFSIGNALED(status)) return fmt::format("crashed: {}", strsignal(WTERMSIG(status)));
    return fmt::format("ended the process with exit code {}", exit_code);
  }

 private:
  pid_t process_ = 0;
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
  void end(const Verdict& verdict) override {
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

}  // namespace

std::vector<Verdict> examine_in_process(const fs::path& library) {
  const TemporaryFile output;
  Child child({own_program(), "plugins", "check", "--child", library.string()}, output.path());
  std::vector<Verdict> verdicts;
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
  const std::string said = output.first_line();
  if (!done || exit_code != 0)
    verdicts.push_back({begun, Outcome::failed, on + words + (said.empty() ? "" : " (" + said + ")")});
  else if (!said.empty())
    verdicts.push_back({"output", Outcome::failed,
                        "it writes '" + said + "' to the terminal; a plugin says things through its context's log"});
  return verdicts;
}

Verdict examine_memory(const fs::path& library) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return {
      "memory", Outcome::skipped,
      "valgrind and a sanitizer do not go together; " + library.filename().string() + " was checked by the sanitizer"};
#endif
  const auto valgrind = find_program("valgrind");
  if (!valgrind) return {"memory", Outcome::skipped, "valgrind is not installed (apt-get install valgrind)"};
  const TemporaryFile output, log;
  Child child({valgrind->string(), "--quiet", "--leak-check=full", "--show-leak-kinds=definite",
               "--errors-for-leak-kinds=definite", fmt::format("--error-exitcode={}", memory_errors_exit_code),
               "--log-file=" + log.path(), own_program(), "plugins", "check", "--brief", "--child", library.string()},
              output.path());
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
  std::string what = log.first_line("lost in loss record");
  if (what.empty()) what = log.first_line();
  return {"memory", Outcome::failed,
          "valgrind: " + what.substr(what.find("== ") == what.npos ? 0 : what.find("== ") + 3)};
}

int examine_here(const fs::path& library, bool brief) {
  // No core file for a crash that is expected, and no machine brought to its knees by a plugin that eats memory.
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const rlimit memory{rlim_t{8} << 30, rlim_t{8} << 30};
  if (!brief) setrlimit(RLIMIT_AS, &memory);
#endif
  ReportSink sink;
  examine_plugin(library, brief, sink);
  sink.done();
  return 0;
}

}  // namespace toposcope::cli
