// SPDX-License-Identifier: BSD-3-Clause
#include "support/program.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace toposcope::test {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "toposcope-test-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

Outcome shell(const std::string& command) {
  const TemporaryFolder folder;
  const std::string both = "( " + command + " ) >" + (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(both.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"), read_text(folder / "err")};
}

Outcome toposcope(const std::string& arguments) {
  return shell(std::string(TOPOSCOPE_BUILD_DIR) + "/bin/toposcope " + arguments);
}

}  // namespace toposcope::test
