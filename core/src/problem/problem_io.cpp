// SPDX-License-Identifier: BSD-3-Clause
#include "problem/problem_io.h"

#include <array>

#include "base/errors.h"
#include "io/file_bytes.h"
#include "io/mesh_io.h"
#include "problem/problem_formats.h"
#include "toposcope/labeling_tools.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

FileBytes read_bytes(const fs::path& path) {
  try {
    return read_file_bytes(path);
  } catch (const MeshError& error) {
    throw UsageError(error.what());
  }
}

[[noreturn]] void unknown_format(const fs::path& path) {
  throw UsageError(path.string() + ": '" + path.extension().string() +
                   "' is no format of labelling problems; known are .json, .cfn, .wcsp and .uai");
}

}  // namespace

ProblemFile read_problem(const fs::path& path) {
  const std::string where = path.string(), extension = path.extension().string();
  const bool known = extension == ".json" || extension == ".cfn" || extension == ".wcsp" || extension == ".uai";
  if (!known) unknown_format(path);
  const FileBytes bytes = read_bytes(path);
  ProblemFile file;
  if (extension == ".json") {
    file = read_problem_json(where, bytes.view());
  } else if (extension == ".cfn") {
    file = read_cfn(where, bytes.view());
  } else if (extension == ".wcsp") {
    file = read_wcsp(where, bytes.view());
  } else {
    const fs::path evidence = where + ".evid";
    file = fs::exists(evidence) ? read_uai(where, bytes.view(), read_bytes(evidence).view())
                                : read_uai(where, bytes.view(), {});
  }
  try {
    check(file.problem);
  } catch (const std::invalid_argument& error) {
    throw UsageError(where + ": " + error.what());
  }
  return file;
}

void write_problem(const fs::path& path, const LabelingProblem& problem) {
  const std::string extension = path.extension().string();
  if (extension == ".json")
    write_file(path, problem_json(problem));
  else if (extension == ".cfn")
    write_file(path, cfn_text(problem));
  else if (extension == ".wcsp")
    write_file(path, wcsp_text(problem));
  else if (extension == ".uai")
    write_file(path, uai_text(problem));
  else
    unknown_format(path);
}

}  // namespace toposcope
