// SPDX-License-Identifier: BSD-3-Clause
#include "base/sha256.h"

#include <sys/types.h>

#include <cstdint>

#include "base/errors.h"

extern "C" {
#include <sha2.h>
}

namespace toposcope {

struct Sha256::State {
  SHA2_CTX context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  SHA256Init(&state_->context);
}
Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
  SHA256Update(&state_->context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string Sha256::hex() {
  char hexadecimal[SHA256_DIGEST_STRING_LENGTH] = {};
  SHA256End(&state_->context, hexadecimal);
  return hexadecimal;
}

std::string sha256_of_text(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return hash.hex();
}

std::string sha256_of(const std::filesystem::path& file) {
  char hexadecimal[SHA256_DIGEST_STRING_LENGTH] = {};
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored) || SHA256File(file.c_str(), hexadecimal) == nullptr)
    throw UsageError(file.string() + ": cannot be read; check that it exists and may be read");
  return hexadecimal;
}

}  // namespace toposcope
