// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace toposcope::fuzz {

/// An octahedron, which the seeds of results speak of.
inline constexpr char small_mesh[] =
    "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
    "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

}  // namespace toposcope::fuzz
