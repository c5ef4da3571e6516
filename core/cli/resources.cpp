// SPDX-License-Identifier: BSD-3-Clause
#include "resources.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "base/errors.h"
#include "base/nearest_name.h"

namespace toposcope::cli {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> folders(const std::string& kind) {
  std::vector<fs::path> result;
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    result.push_back(executable.parent_path().parent_path() / kind);
    result.push_back(executable.parent_path().parent_path() / "share" / "toposcope" / kind);
  }
  if (const char* path = std::getenv("TOPOSCOPE_DATA_PATH")) {
    std::istringstream stream(path);
    for (std::string folder; std::getline(stream, folder, ':');)
      if (fs::path(folder).is_absolute()) result.push_back(fs::path(folder) / kind);
  }
  return result;
}

std::vector<fs::path> yaml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

fs::path find_resource(const std::string& kind, const std::string& name) {
  fs::path given(name);
  const std::string one = kind.substr(0, kind.size() - 1);
  if (given.extension() == ".yaml" || given.extension() == ".yml") {
    std::error_code error;
    if (!fs::is_regular_file(given, error))
      throw UsageError(name + ": no such " + one + " file" + (error ? " (" + error.message() + ")" : ""));
    return given;
  }
  std::vector<std::string> known;
  for (const fs::path& folder : folders(kind)) {
    fs::path file = folder / (name + ".yaml");
    std::error_code error;
    if (fs::is_regular_file(file, error)) return file;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error))
      if (entry.path().extension() == ".yaml")
        known.push_back(fs::relative(entry.path(), folder).replace_extension().string());
  }
  std::sort(known.begin(), known.end());
  std::string message = "no " + one + " '" + name + "'";
  if (const std::string near = nearest_name(name, known); !near.empty()) message += "; did you mean '" + near + "'?";
  if (!known.empty()) message += "; there are:";
  for (const std::string& each : known) message += " " + each;
  throw UsageError(message + "; or give a file that ends in .yaml");
}

fs::path find_page() {
  std::error_code error;
  for (const fs::path& folder : folders("web"))
    if (fs::is_regular_file(folder / "report.html", error)) return folder / "report.html";
  return {};
}

std::string page_missing() {
  return "web/report.html, the page that shows results, is not beside the program; build or install Toposcope anew, "
         "or name the folder that has it in TOPOSCOPE_DATA_PATH";
}

fs::path find_resource_folder(const std::string& kind, std::string_view name) {
  for (const fs::path& folder : folders(kind))
    if (std::error_code error; fs::is_directory(folder / name, error)) return folder / name;
  return {};
}

std::vector<fs::path> find_models(const std::string& folder_or_list) {
  std::error_code error;
  if (folder_or_list.find('/') != std::string::npos && fs::is_directory(folder_or_list, error)) {
    std::vector<fs::path> files = yaml_files(folder_or_list);
    if (files.empty()) throw UsageError(folder_or_list + ": no .yaml file in this folder; give a folder of models");
    return files;
  }
  std::vector<fs::path> files;
  std::istringstream stream(folder_or_list);
  for (std::string name; std::getline(stream, name, ',');) files.push_back(find_resource("models", name));
  if (files.empty()) throw UsageError("--models is empty; give a folder, or names separated by commas");
  return files;
}

}  // namespace toposcope::cli
