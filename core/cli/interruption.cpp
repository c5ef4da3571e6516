// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.h"

#include <signal.h>

#include <string>

#include "base/errors.h"

namespace toposcope::cli {
namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
RunContext* interruptible = nullptr;  // the one thing a signal handler can reach
volatile sig_atomic_t signalled = 0;

void on_signal(int) {
  signalled = 1;
  if (interruptible) interruptible->cancel();
}

void handle(void (*handler)(int)) {
  struct sigaction action {};  // without SA_RESTART: what waits for a child or a pipe wakes up
  action.sa_handler = handler;
  for (const int each : signals) {
    struct sigaction before {};
    sigaction(each, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(each, &action, nullptr);  // nohup has its reasons
  }
}

}  // namespace

Interruption::Interruption(RunContext& context) {
  interruptible = &context;
  handle(on_signal);
}

Interruption::~Interruption() {
  handle(SIG_DFL);
  interruptible = nullptr;
}

bool interrupted() {
  return signalled != 0;
}

void stop_if_cancelled(const Context& context, const std::string& undone) {
  if (context.cancelled()) throw Error("interrupted; " + undone, interrupted_exit_code);
}

}  // namespace toposcope::cli
