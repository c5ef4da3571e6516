// SPDX-License-Identifier: BSD-3-Clause

// The program: gathers the commands, runs the one that is asked for, turns errors into messages and exit codes.

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "base/errors.h"
#include "command_line.h"
#include "commands.h"
#include "failure.h"
#include "interruption.h"
#include "output.h"

namespace {

using namespace toposcope::cli;

int dispatch(int argc, char** argv) {
  CLI::App app{"Finds, names and measures the features of a class of objects on triangle meshes.", "toposcope"};
  app.set_version_flag("--version", TOPOSCOPE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all was done; 1 a fault of the program itself, or no memory left; 2 bad usage, model, pipeline or "
      "other input but meshes, or an output that cannot be written; 3 a mesh that cannot be used, or with which the "
      "memory was at an end; 4 a plugin that cannot be used; 130 interrupted. Of several meshes or results, those that "
      "can be are done, and the exit code is that of the first that was not.");
  int code = 0;
  add_run(app, code);
  add_classify(app, code);
  add_compare(app, code);
  add_evaluate(app, code);
  add_label(app, code);
  add_prepare(app, code);
  add_report(app, code);
  add_export(app, code);
  add_render(app, code);
  add_sample(app, code);
  add_model(app, code);
  add_plugins(app, code);
  const int done = run_command_line(app, argc, argv, code);
  flush_output();
  return done;
}

/// A file that is opened must not get the number of a closed standard stream: what is printed would go into it. These
/// cannot be used, as before.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

int main(int argc, char** argv) {
  end_in_words_without_memory();
  occupy_closed_streams();
  signal(SIGXFSZ, SIG_IGN);  // a file beyond its limit is an error to be told
  try {
    return dispatch(argc, argv);
  } catch (...) {
    const Failure failure = present_failure();
    const bool stopped = interrupted();
    complain(stopped && failure.exit_code != toposcope::interrupted_exit_code ? "interrupted; " + failure.message
                                                                              : failure.message);
    return stopped ? toposcope::interrupted_exit_code : failure.exit_code;
  }
}
