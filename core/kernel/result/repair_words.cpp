// SPDX-License-Identifier: BSD-3-Clause
#include "result/repair_words.h"

namespace toposcope {

std::vector<RepairCount> repair_counts(const RepairReport& report) {
  std::vector<RepairCount> counts = {
      {"merged_vertices", "merged vertices", report.merged_vertices},
      {"unreferenced_vertices", "vertices without a face", report.unreferenced_vertices},
      {"non_finite_vertices", "vertices that are not finite", report.non_finite_vertices},
      {"non_finite_faces", "faces dropped with them", report.non_finite_faces},
      {"degenerate_faces", "degenerate faces dropped", report.degenerate_faces},
      {"flat_faces", "faces without area kept", report.flat_faces},
      {"duplicate_faces", "duplicate faces dropped", report.duplicate_faces},
      {"split_edges", "edges split", report.split_edges},
      {"isolated_faces", "faces taken out of their surroundings", report.isolated_faces},
      {"split_vertices", "vertices split", report.split_vertices},
      {"turned_faces", "faces turned", report.turned_faces},
      {"cut_edges", "edges cut in a one-sided surface", report.cut_edges}};
  if (report.near_vertices > 0)
    counts.insert(counts.begin() + 1, {"near_vertices", "of them almost at one place", report.near_vertices});
  return counts;
}

std::string repair_in_words(const RepairReport& report) {
  std::string text;
  for (const RepairCount& each : repair_counts(report))
    if (each.count > 0) text += (text.empty() ? "" : ", ") + std::to_string(each.count) + " " + each.words;
  return text.empty() ? "nothing to repair" : text;
}

}  // namespace toposcope
