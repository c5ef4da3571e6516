// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "toposcope/context.h"

namespace toposcope::cli {

namespace fs = std::filesystem;

/// The page that shows documents, looked up once. Without it, all else is still written.
class Page {
 public:
  /// Reads it; a warning where it is not there.
  /// \param file  that cannot be written without it, and \param skip  how to ask for none; for the warning
  Page(const std::string& file, const std::string& skip, Context& context);
  bool there() const { return !text_.empty(); }
  /// \throw UsageError  the file cannot be written
  void write(const fs::path& file, const std::string& document) const;

 private:
  std::string text_, file_;
};

/// index.json and index.html.
void write_index(const fs::path& folder, const std::string& document, Context& context);

}  // namespace toposcope::cli
