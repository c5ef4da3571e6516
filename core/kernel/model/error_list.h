// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/errors.h"
#include "model/source_location.h"

namespace toposcope {

/// The errors found in one file, so that the user sees all of them at once.
class ErrorList {
 public:
  /// \param message  what is wrong, and the remedy
  void add(const SourceLocation& where, const std::string& message) {
    add_located(where, where.str() + ": " + message);
  }

  /// An error that names its place itself.
  void add_located(const SourceLocation& where, const std::string& message) { errors_.push_back({where, message}); }

  bool empty() const { return errors_.empty(); }

  /// \throw UsageError  all errors in the order of the file, one a line
  void throw_if_any() const;

 private:
  struct Entry {
    SourceLocation where;
    std::string message;
  };
  std::vector<Entry> errors_;
};

}  // namespace toposcope
