// SPDX-License-Identifier: BSD-3-Clause
#include <signal.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include "base/errors.h"
#include "io/mesh_io.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw UsageError(path.string() + ": cannot be written (" + reason +
                   "); check the folder, its permissions and the space left");
}

/// \return 0 or an errno; closes the file
int write_and_close(std::FILE* file, std::string_view content) {
  int error = std::fwrite(content.data(), 1, content.size(), file) == content.size() ? 0 : errno;
  if (std::fclose(file) != 0 && error == 0) error = errno;
  return error;
}

/// A new file beside the target, so that the rename stays on one file system.
std::FILE* open_beside(const fs::path& target, fs::path& temporary) {
  constexpr int most_attempts = 1000;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    temporary = target;
    temporary += ".part" + std::to_string(attempt);
    if (std::FILE* file = std::fopen(temporary.c_str(), "wbx")) return file;
    if (errno != EEXIST) break;
  }
  return nullptr;
}

/// While it lives, this thread ends for no signal, so that none leaves a file half-written.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, each);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

void write_file(const fs::path& path, std::string_view content) {
  std::error_code error;
  fs::path target = path;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {  // a device or pipe: nothing to replace
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) fail(path, std::strerror(errno));
    if (const int code = write_and_close(file, content)) fail(path, std::strerror(code));
    return;
  }
  if (fs::is_symlink(fs::symlink_status(path, error)))
    if (const fs::path real = fs::weakly_canonical(path, error); !error) target = real;

  const SignalsWait wait;
  fs::path temporary;
  std::FILE* file = open_beside(target, temporary);
  if (!file) fail(path, std::strerror(errno));
  if (const int code = write_and_close(file, content)) {
    fs::remove(temporary, error);
    fail(path, std::strerror(code));
  }
  fs::rename(temporary, target, error);
  if (error) {
    const std::string reason = error.message();
    fs::remove(temporary, error);
    fail(path, reason);
  }
}

}  // namespace toposcope
