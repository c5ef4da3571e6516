// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

#include "commands.h"

namespace toposcope::cli {

struct ResultOptions {
  ReportOptions report;
  ExportOptions exported;
  RenderOptions render;
};

/// The commands that work on results: report, export, render.
void add_result_commands(CLI::App& app, ResultOptions& options, int& code);

}  // namespace toposcope::cli
