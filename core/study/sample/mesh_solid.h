// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sample/solid.h"

namespace toposcope {

/// The net of a solid's surface (extract_isosurface). \throw UsageError  it would have too many cells
TriangleSoup net_of(const Solid& solid, const std::string& kind, double spacing, double level, Context& context);

/// Meshes the solid by a fine net, and thins that to the faces asked for.
/// \throw UsageError  no grid resolves the solid, or its curved parts need more faces
TriangleSoup mesh_solid(const Solid& solid, const SampleRequest& request, Context& context);

/// Tells the part of every face by its centre.
void mark_parts(Sample& sample, const Solid& solid, Context& context);

}  // namespace toposcope
