// SPDX-License-Identifier: BSD-3-Clause
#include "failure.h"

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "base/errors.h"

namespace toposcope::cli {
namespace {

std::terminate_handler usual_end = std::abort;

/// Takes no memory itself.
[[noreturn]] void end() noexcept {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    constexpr std::string_view words = "toposcope: out of memory; give less input at once\n";
    [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, words.data(), words.size());
    _exit(1);
  } catch (...) {
  }
  usual_end();
  std::abort();
}

}  // namespace

Failure present_failure() try { throw; } catch (const Error& error) {
  return {error.what(), error.exit_code};
} catch (const std::filesystem::filesystem_error& error) {
  return {
      error.path1().string() + ": " + error.code().message() + "; check the name, and that its folders may be entered",
      2};
} catch (const std::bad_alloc&) {
  return {"out of memory; give less input at once", 1};
} catch (const std::length_error&) {
  return {"out of memory: more is asked for than a list can hold; give less input at once", 1};
} catch (const std::system_error& error) {
  const bool exhausted = error.code() == std::errc::resource_unavailable_try_again;  // threads, processes
  return {exhausted ? std::string("the system refuses: ") + error.what() + "; are there too many threads or processes?"
                    : error.what(),
          exhausted ? 1 : 2};
} catch (const std::exception& error) {
  return {std::string("internal error: ") + error.what(), 1};
}

void end_in_words_without_memory() {
  usual_end = std::set_terminate(end);
}

}  // namespace toposcope::cli
