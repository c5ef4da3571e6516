// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace toposcope {

/// An error meant for the user: names the place, the value, the constraint and the remedy. `exit_code` is what
/// the program returns for it.
class Error : public std::runtime_error {
 public:
  Error(const std::string& message, int code) : std::runtime_error(message), exit_code(code) {}
  int exit_code;
};

/// What a shell reports of a program that Ctrl-C ended.
inline constexpr int interrupted_exit_code = 130;

/// Bad usage, bad model, bad pipeline: exit code 2.
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(message, 2) {}
};

/// A mesh that cannot be used: exit code 3.
struct MeshError : Error {
  explicit MeshError(const std::string& message) : Error(message, 3) {}
};

/// A plugin that cannot be used: exit code 4.
struct PluginError : Error {
  PluginError(const std::string& id, const std::string& message)
      : Error("plugin '" + id + "': " + message, 4), plugin(id) {}
  std::string plugin;
};

}  // namespace toposcope
