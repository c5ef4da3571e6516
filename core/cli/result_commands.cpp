// SPDX-License-Identifier: BSD-3-Clause
#include "result_commands.h"

#include <CLI/CLI.hpp>

namespace toposcope::cli {
namespace {

void add_report(CLI::App& app, ReportOptions& options, int& code) {
  CLI::App* report_app = app.add_subcommand("report", "write report.html, a page to look at, beside results");
  report_app->add_option("result", options.results, "folders that toposcope run --out wrote, or their result.json")
      ->required()
      ->type_name("RESULT...");
  report_app->add_option("--mesh", options.mesh, "the mesh of one result, if it is not where it was")
      ->type_name("MESH");
  report_app->add_flag("-q,--quiet", options.quiet, "errors only");
  report_app->callback([&] { code = report(options); });
}

void add_export(CLI::App& app, ExportOptions& options, int& code) {
  CLI::App* export_app = app.add_subcommand("export", "results as files for Blender, ParaView, 3D Slicer and others");
  export_app->add_option("result", options.results, "folders that toposcope run --out wrote")
      ->required()
      ->type_name("RESULT...");
  export_app
      ->add_option("--format", options.formats, "gltf (features.glb), vtp (features.vtp), slicer (features.mrk.json)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"gltf", "vtp", "slicer"}))
      ->capture_default_str();
  export_app->add_option("--mesh", options.mesh, "the mesh of one result, if it is not where it was")
      ->type_name("MESH");
  export_app->add_flag("-q,--quiet", options.quiet, "errors only");
  export_app->callback([&] { code = export_results(options); });
}

void add_render(CLI::App& app, RenderOptions& options, int& code) {
  CLI::App* render_app = app.add_subcommand("render", "pictures of results as PNG files, without a display");
  render_app->add_option("result", options.results, "folders that toposcope run --out wrote")
      ->required()
      ->type_name("RESULT...");
  render_app->add_option("--stage", options.stages, "mesh, worksets, candidates, found, marks; several by commas; all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  render_app->add_option("-o,--out", options.out, "the picture; of several pictures the beginning of their names")
      ->type_name("FILE.png");
  render_app->add_option("--size", options.size, "pixels")->type_name("WxH")->capture_default_str();
  render_app
      ->add_option("--view", options.view,
                   "auto, iso, front, back, left, right, top, bottom, or azimuth,elevation in degrees")
      ->capture_default_str();
  render_app->add_option("--up", options.up, "which way is up: auto (the model tells), x, y, z, -x, -y, -z")
      ->capture_default_str();
  render_app->add_option("--background", options.background, "white, dark or transparent")
      ->check(CLI::IsMember({"white", "dark", "transparent"}))
      ->capture_default_str();
  render_app->add_option("--mesh", options.mesh, "the mesh of one result, if it is not where it was")
      ->type_name("MESH");
  render_app->add_option("--threads", options.threads, "threads; 0: one per processor")
      ->check(CLI::Range(0U, 1024U))
      ->capture_default_str();
  render_app->add_flag("-q,--quiet", options.quiet, "errors only");
  render_app->callback([&] { code = render(options); });
}

}  // namespace

void add_result_commands(CLI::App& app, ResultOptions& options, int& code) {
  add_report(app, options.report, code);
  add_export(app, options.exported, code);
  add_render(app, options.render, code);
}

}  // namespace toposcope::cli
