// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mesh/mesh.h"
#include "mesh/repair_report.h"

namespace toposcope {

/// Looks, in parallel, whether `repair` would leave a mesh as it is: most files of scanners and modellers are so.
/// \param context  null: in the calling thread alone
/// \return what the repair would report; nothing where it would change the mesh, or where only it can tell
std::optional<RepairReport> examine(const TriangleSoup& soup, Context* context);

}  // namespace toposcope
