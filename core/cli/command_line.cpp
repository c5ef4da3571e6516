// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include <CLI/CLI.hpp>
#include <sstream>
#include <string_view>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "output.h"

namespace toposcope::cli {
namespace {

/// An unset variable of the shell leaves an empty word; and of "--out=" CLI11 would take the next word for its value.
void refuse_empty_words(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i], before = argv[i - 1];
    const bool assignment = word.starts_with("--") && word.find('=') + 1 == word.size();
    if (!word.empty() && !assignment) continue;
    const std::string name(assignment ? word.substr(0, word.size() - 1) : before.starts_with("-") ? before : "");
    throw UsageError((name.empty() ? "the word after '" + std::string(before) + "'" : name) +
                     " is empty; give a value or leave it out (is a variable of the shell unset?)");
  }
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(below->get_name());
  return names;
}

std::string unknown(const std::string& what, const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(word, known);
  return "there is no " + what + " '" + word + "'" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

/// What is wrong. A word that nobody knows explains why another is missing, so it goes first.
std::string explained(const CLI::App& command, const CLI::ParseError& error) {
  const std::vector<std::string> commands = command_names(command);
  for (const std::string& word : command.remaining()) {
    if (word.starts_with("-")) return unknown("option", word.substr(0, word.find('=')), option_names(command));
    if (!commands.empty()) return unknown("command", word, commands);
  }
  const std::string message = error.what();
  if (!commands.empty() && error.get_name() == "RequiredError")
    return "name a command: " + CLI::detail::join(commands, ", ");
  const std::string conversion = "Could not convert: ";
  if (message.starts_with(conversion)) return message.substr(conversion.size()) + ": this option takes no such value";
  return message;
}

std::string full_name(const CLI::App& command) {
  return command.get_parent() ? full_name(*command.get_parent()) + " " + command.get_name() : command.get_name();
}

}  // namespace

int run_command_line(CLI::App& app, int argc, char** argv, const int& code) try {
  refuse_empty_words(argc, argv);
  app.parse(argc, argv);
  return code;
} catch (const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {  // help or the version was asked for
    std::ostringstream text;
    const int done = app.exit(error, text, text);
    write_output(text.str());
    return done;
  }
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  complain(explained(*command, error) + "\nRun " + full_name(*command) + " --help for more information.");
  return 2;
}

}  // namespace toposcope::cli
