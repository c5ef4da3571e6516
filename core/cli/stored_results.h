// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "scene/stored_result.h"

namespace toposcope::cli {

namespace fs = std::filesystem;

/// The folder of a result that is given by its folder or by a file in it. \throw UsageError  there is no result.json
fs::path result_folder(const fs::path& given);

/// scene.json of a result's folder; of a folder without one, what result.json and its mesh show.
/// \param mesh  where the mesh is now; empty: where the result says
Scene stored_scene(const fs::path& folder, const fs::path& mesh);

/// Whether a mesh is given, and no result. labels.ply, which run writes, stands for its result.
bool is_mesh_file(const fs::path& given);

/// A mesh alone, and the marks of a truth file beside it.
Scene mesh_scene(const fs::path& file);

/// Runs `body` for each result, as it was given: one that fails is reported on stderr and the others are still done.
/// \param mesh  --mesh, which only one result can have
/// \return the exit code: that of the first failure, 0 if there was none
int for_each_result(const std::vector<fs::path>& results, const fs::path& mesh,
                    const std::function<void(const fs::path& given)>& body);

}  // namespace toposcope::cli
