// SPDX-License-Identifier: BSD-3-Clause
// make_oval_can FILE.off: an elliptic can with semi-axes 40 and 26 and height 70, turned and shifted, with a little
// noise.

#include <cstdio>
#include <fstream>

#include "solids.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: make_oval_can FILE.off\n"), 2;
  const solids::Solid can = solids::oval_can(40, 26, 70, 120, 0.02, 1);
  std::ofstream file(argv[1]);
  file << "OFF\n" << can.positions.size() << ' ' << can.triangles.size() << " 0\n";
  file.precision(17);
  for (const auto& p : can.positions)  // turned about two axes, exactly orthogonal
    file << 0.6 * p.x() - 0.8 * p.z() + 11 << ' ' << p.y() - 3 << ' ' << 0.8 * p.x() + 0.6 * p.z() + 200 << '\n';
  for (const auto& t : can.triangles) file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  file.close();
  return file ? 0 : 1;
}
