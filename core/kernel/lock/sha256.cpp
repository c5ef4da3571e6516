// SPDX-License-Identifier: BSD-3-Clause
#include "lock/sha256.h"

#include <sys/types.h>

#include <cstdint>

#include "base/errors.h"

extern "C" {
#include <sha2.h>
}

namespace toposcope {

std::string sha256_of(const std::filesystem::path& file) {
  char hexadecimal[SHA256_DIGEST_STRING_LENGTH] = {};
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored) || SHA256File(file.c_str(), hexadecimal) == nullptr)
    throw UsageError(file.string() + ": cannot be read; check that it exists and may be read");
  return hexadecimal;
}

}  // namespace toposcope
