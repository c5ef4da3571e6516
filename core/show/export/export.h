// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "scene/stored_result.h"

namespace toposcope {

// A result in formats that other people's tools read, with the mesh whole. Points are in the mesh's own frame and unit.

/// 3D Slicer markups (.mrk.json, schema 1.0.3): circles and outlines as closed curves, segments as lines, and a list of
/// points with a feature's name at the middle of each. The coordinate system is LPS, which Slicer takes meshes to be
/// in.
std::string to_slicer_markups(const LabelledMesh& labelled);

/// glTF 2.0 (.glb): a node for each feature found, with its part of the mesh and its shape, and one for the rest.
std::string to_gltf(const LabelledMesh& labelled, const std::string& program);

/// VTK's XML PolyData (.vtp): the mesh and the shapes, a label per cell; names and probabilities as field data.
std::string to_vtp(const LabelledMesh& labelled);

}  // namespace toposcope
