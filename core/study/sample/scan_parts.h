// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Steps of scan(): what is kept of the raw surface, and the truth of what comes out.

#include <span>

#include "sample/depth_view.h"
#include "sample/sample.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Drops the faces of which a vertex was not measured within `tolerance` by any of the views.
void keep_measured(TriangleSoup& mesh, std::span<const DepthView> views, double tolerance, Context& context);

/// Drops pieces with less than a twentieth of the largest one's faces, vertices that no face uses, and, of closed
/// surfaces, those of hollows.
void keep_large_components(TriangleSoup& mesh, bool closed);

/// How the object came to its place: rotation * (x - center), in which it was scanned, + translation.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 center = Vec3::Zero(), translation = Vec3::Zero();
};

/// \param posed   the exact mesh where it was scanned, with the features where they were before
/// \param mesh    made by the scan
/// \param reach   points farther than this from the mesh are dropped; 0: none is
Sample scanned_truth(const Sample& posed, const MeshView& mesh, const Pose& pose, double reach, Context& context);

}  // namespace toposcope
