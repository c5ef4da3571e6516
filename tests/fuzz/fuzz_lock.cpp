// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_document.h"
#include "lock/run_lock.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  return fuzz::read_document(data, size, [](const std::string& text) {
    const RunLock lock = read_lock(fuzz::file_of("run.lock", text));
    to_json(lock);
    require_same(lock, lock, "run.lock");
    require_same(lock, {}, "run.lock");
  });
}
