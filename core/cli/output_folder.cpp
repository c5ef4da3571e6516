// SPDX-License-Identifier: BSD-3-Clause
#include "output_folder.h"

#include <set>
#include <system_error>

#include "base/errors.h"
#include "base/file_name.h"

namespace toposcope::cli {
namespace fs = std::filesystem;

void refuse_same_stem(const std::vector<fs::path>& meshes, const std::string& option) {
  std::set<std::string> stems;
  for (const fs::path& mesh : meshes)
    if (!stems.insert(file_name(mesh.stem().string())).second)
      throw UsageError("two meshes are named '" + mesh.stem().string() +
                       "': their results would have the same name below " + option + "; run them apart");
}

void make_folder(const fs::path& folder, const std::string& option) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error) && !error) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw UsageError(folder.string() + ": cannot make this folder (" + error.message() + "); name another with " +
                     option);
}

}  // namespace toposcope::cli
