// SPDX-License-Identifier: BSD-3-Clause

// A program that is started from a thread which blocks signals does not block them.

#include "toposcope/system/spawn.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <thread>

namespace toposcope {
namespace {

/// The exit code of a program that sends itself SIGTERM; 128 + the signal where that ended it.
int of_a_child_that_is_asked_to_end(const posix_spawnattr_t* attributes) {
  char shell[] = "/bin/sh", flag[] = "-c", command[] = "kill -TERM $$; exit 3";
  char* const arguments[] = {shell, flag, command, nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, shell, nullptr, attributes, arguments, nullptr) != 0) return -1;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(SpawnAttributes, LeaveNoSignalBlocked) {
  std::thread([] {
    sigset_t ending;
    sigemptyset(&ending);
    sigaddset(&ending, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ending, nullptr);
    EXPECT_EQ(of_a_child_that_is_asked_to_end(nullptr), 3) << "or there is nothing to test";
    EXPECT_EQ(of_a_child_that_is_asked_to_end(SpawnAttributes().get()), 128 + SIGTERM);
  }).join();
}

}  // namespace
}  // namespace toposcope
