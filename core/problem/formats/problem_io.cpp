// SPDX-License-Identifier: BSD-3-Clause
#include "formats/problem_io.h"

#include <fmt/format.h>

#include <stdexcept>

#include "base/errors.h"
#include "formats/problem_formats.h"
#include "io/extension.h"
#include "io/mesh_io.h"
#include "reading/problem_text.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

void note_names(const LabelingProblem& problem, const char* format, std::vector<std::string>& notes) {
  bool violations = false;
  for (const LabelingConstraint& constraint : problem.constraints)
    violations = violations || !constraint.violations.empty();
  notes.push_back(fmt::format("{} does not keep names{}", format, violations ? " and violations" : ""));
}

std::string text_of(const ProblemFile& file, const std::string& extension, std::vector<std::string>& notes) {
  if (extension == ".json") return problem_json(file);
  if (extension == ".uai") {
    note_names(file.problem, ".uai", notes);
    if (file.top < forbidden) notes.push_back(fmt::format(".uai does not keep the top of {}", file.top));
    return std::move(write_uai(file.problem).text);
  }
  const bool cfn = extension == ".cfn";
  WrittenProblem written = cfn ? write_cfn(file.problem, file.top, file.maximize) : write_wcsp(file.problem, file.top);
  if (!written.exact) notes.push_back(fmt::format("costs are rounded to {} digits after the point", written.decimals));
  if (!cfn && (written.decimals > 0 || written.shift > 0))
    notes.push_back(fmt::format("costs of .wcsp are whole and not negative: cost c is written as 10^{} (c + {})",
                                written.decimals, written.shift));
  if (!cfn) note_names(file.problem, ".wcsp", notes);
  return std::move(written.text);
}

}  // namespace

void require_problem_extension(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".json" && extension != ".cfn" && extension != ".wcsp" && extension != ".uai")
    throw UsageError(path.string() + ": '" + path.extension().string() +
                     "' is no format of labelling problems; known are .json, .cfn, .wcsp and .uai (unpack a compressed "
                     "file first)");
}

ProblemFile read_problem(const fs::path& path, std::uint64_t memory_budget) {
  memory_budget /= 4;  // labelers make tables of their own from these
  require_problem_extension(path);
  const std::string extension = lower_extension(path), where = path.string();
  const std::string text = read_problem_text(path);
  ProblemFile file;
  if (extension == ".json") {
    file = read_problem_json(where, text, memory_budget);
  } else if (extension == ".cfn") {
    file = read_cfn(where, text, memory_budget);
  } else if (extension == ".wcsp") {
    file = read_wcsp(where, text, memory_budget);
  } else {
    const fs::path evidence = where + ".evid";
    file = read_uai(where, text, memory_budget);
    if (fs::exists(evidence)) read_uai_evidence(file.problem, evidence.string(), read_problem_text(evidence));
  }
  return file;
}

std::vector<std::string> write_problem(const fs::path& path, const ProblemFile& file) {
  require_problem_extension(path);
  std::vector<std::string> notes;
  try {
    write_file(path, text_of(file, lower_extension(path), notes));
  } catch (const std::invalid_argument& error) {
    throw UsageError(path.string() + ": cannot be written: " + error.what());
  }
  return notes;
}

std::vector<std::string> write_problem(const fs::path& path, const LabelingProblem& problem) {
  ProblemFile file;
  file.problem = problem;
  return write_problem(path, file);
}

}  // namespace toposcope
