// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "component_tree.h"

namespace component_tree {

/// The two halves of every long ring: of a component that encloses a part of the surface and is some twice as long as
/// it is wide, cut across at the middle of its length. The edge of a sheet that stands on both sides of an object
/// without touching it, as a T-tail's stabiliser, is one ring, and a feature may be one side of it. Halves have their
/// ring's saliency; those in two pieces, or of fewer vertices than `min_vertices`, are left out.
Components halves_of_rings(const toposcope::MeshView& mesh, const Components& components, Index min_vertices);

}  // namespace component_tree
