// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "base/errors.h"
#include "base/text_file.h"
#include "commands.h"
#include "options.h"
#include "output.h"
#include "resources.h"
#include "scene/page.h"
#include "session.h"
#include "stored_results.h"

namespace toposcope::cli {
namespace {

int report(const ResultOptions& options) {
  const fs::path page_file = find_page();
  if (page_file.empty()) throw UsageError(page_missing());
  const std::string page = read_text_file(page_file, "page");
  return for_each_result(options.results, options.mesh, [&](const fs::path& given) {
    const fs::path folder = result_folder(given);
    const Scene scene = stored_scene(folder, options.mesh);
    const fs::path file = folder / "report.html";
    write_file(file, page_with(page, to_json(scene, program_name()), page_file.string()));
    if (!options.quiet) say("{}\n", file.string());
  });
}

}  // namespace

void add_report(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("report", "write report.html, a page to look at, beside results");
  const auto options = std::make_shared<ResultOptions>();
  add_results(command, *options);
  command.callback([options, &code] { code = report(*options); });
}

}  // namespace toposcope::cli
