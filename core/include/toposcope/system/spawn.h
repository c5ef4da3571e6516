// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>
#include <spawn.h>

namespace toposcope {

/// Attributes of a program to be started. Of the signals that the calling thread blocks none stay blocked there:
/// workers of a run block those that end programs, and a child would ignore them for ever.
class SpawnAttributes {
 public:
  /// \param flags  further POSIX_SPAWN_...
  explicit SpawnAttributes(int flags = 0) {
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, static_cast<short>(flags | POSIX_SPAWN_SETSIGMASK));
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

}  // namespace toposcope
