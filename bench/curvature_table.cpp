// SPDX-License-Identifier: BSD-3-Clause

// Error of both curvature estimates on analytic surfaces, as a Markdown table. Relative error of the principal
// curvature of larger magnitude, and the error of the other one relative to the larger.
//
//   curvature_table [FACES...] [--deviation DIAGONALS]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/run_context.h"
#include "support/analytic_surfaces.h"
#include "table/table.h"
#include "toposcope/geometry/curvature.h"

namespace {

using namespace toposcope;
using test::AnalyticSurface;
using test::Sampling;

Column percent(const char* name) {
  return {name, "number", "", "{:.2f}"};
}

const std::vector<Column> columns = {"surface",
                                     "sampling",
                                     "faces",
                                     "noise",
                                     percent("default: median %"),
                                     percent("95th"),
                                     percent("other, median"),
                                     percent("dissertation: median %"),
                                     percent("95th"),
                                     percent("other, median")};

/// Larger curvature: median and 95th percentile; the other one: median.
std::array<double, 3> errors(const AnalyticSurface& surface, const Curvature& estimate) {
  std::vector<double> larger, smaller;
  for (std::size_t v = 0; v < surface.maximum.size(); ++v) {
    if (!surface.interior[v]) continue;
    double big = std::abs(estimate.maximum[v] - surface.maximum[v]);
    double small = std::abs(estimate.minimum[v] - surface.minimum[v]);
    const double size = std::max(std::abs(surface.maximum[v]), std::abs(surface.minimum[v]));
    if (std::abs(surface.maximum[v]) < std::abs(surface.minimum[v])) std::swap(big, small);
    larger.push_back(100 * big / size);
    smaller.push_back(100 * small / size);
  }
  std::sort(larger.begin(), larger.end());
  std::sort(smaller.begin(), smaller.end());
  const auto at = [](const std::vector<double>& sorted, double part) {
    return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
  };
  return {at(larger, 0.5), at(larger, 0.95), at(smaller, 0.5)};
}

void row(const std::string& name, const std::string& sampling, double noise, const AnalyticSurface& surface,
         double deviation, Context& context) {
  const Mesh mesh(surface.mesh, name);
  const MeshView& view = mesh.view();
  ShapeOperators operators = fit_shape_operators(view, context);
  diffuse(view, operators, diffusion_passes(view, deviation * view.box.diagonal(), 1), context);
  Curvature turning = turning_curvature(view, plane_fit_normals(view, context), 2, context);
  const auto ours = errors(surface, principal_curvatures(operators)), theirs = errors(surface, turning);
  fmt::print("{}", markdown_row(columns, {name, sampling, view.face_count(), fmt::format("{:.0f} %", 100 * noise),
                                          ours[0], ours[1], ours[2], theirs[0], theirs[1], theirs[2]}));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  double deviation = 0.015;  // as worksets/curvature-tree has it
  std::vector<Index> sizes;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--deviation" && i + 1 < argc)
      deviation = std::atof(argv[++i]);
    else
      sizes.push_back(static_cast<Index>(std::atoi(argv[i])));
  }
  if (sizes.empty()) sizes = {5000, 20000, 200000};
  RunContext context;
  fmt::print("{}", markdown_header(columns));
  for (const char* kind : {"sphere", "cylinder", "torus", "saddle"})
    for (const Index faces : sizes)
      for (const Sampling sampling : {Sampling::regular, Sampling::irregular})
        for (const double noise : {0.0, 0.05, 0.2})
          row(kind, sampling == Sampling::regular ? "regular" : "irregular", noise,
              test::make_surface(kind, faces, sampling, noise, 1), deviation, context);
  for (const auto& [around, bands] : {std::pair{50, 50}, {50, 500}, {50, 2500}, {24, 2304}})
    row(fmt::format("lantern {} x {}", around, bands), "", 0, test::make_lantern(around, bands), deviation, context);
}
