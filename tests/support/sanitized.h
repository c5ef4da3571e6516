// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace toposcope::test {

/// Whether this build has a sanitizer (TOPOSCOPE_SANITIZE): a test takes four to thirty times as long there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

}  // namespace toposcope::test

/// On top of a test that a sanitizer makes take more than ten minutes on two cores: leaves it out there, and says why
/// and what runs the same code instead.
#define SKIP_WHEN_SANITIZED(condition, why)                                 \
  do {                                                                      \
    if (::toposcope::test::sanitized && (condition))                        \
      GTEST_SKIP() << "NOT CHECKED: too slow under a sanitizer; " << (why); \
  } while (false)
