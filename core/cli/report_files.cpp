// SPDX-License-Identifier: BSD-3-Clause
#include "report_files.h"

#include "base/text_file.h"
#include "io/mesh_io.h"
#include "resources.h"
#include "scene/page.h"

namespace toposcope::cli {

Page::Page(const std::string& file, const std::string& skip, Context& context) : file_(find_page().string()) {
  if (!file_.empty())
    text_ = read_text_file(file_, "page");
  else
    context.log(LogLevel::warning, "no " + file + " is written: " + page_missing() + skip);
}

void Page::write(const fs::path& file, const std::string& document) const {
  if (there()) write_file(file, page_with(text_, document, file_));
}

void write_index(const fs::path& folder, const std::string& document, Context& context) {
  write_file(folder / "index.json", document);
  Page("index.html", "", context).write(folder / "index.html", document);
}

}  // namespace toposcope::cli
