// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "toposcope/types.h"

namespace toposcope {

/// What was found in a mesh and done about it, in the order in which it is done (docs/guide/prepare.md), and what the
/// mesh is like afterwards.
struct RepairReport {
  Index merged_vertices = 0;        ///< removed: at the place of another one
  Index near_vertices = 0;          ///< of these, not at the very place of another one but too near to it to differ
  double near_distance = 0;         ///< of them the greatest, mesh unit
  Index unreferenced_vertices = 0;  ///< removed: no face uses them, or none any more
  Index non_finite_vertices = 0;    ///< removed, with the faces that use them
  Index non_finite_faces = 0;       ///< removed: a corner is not finite
  Index degenerate_faces = 0;  ///< removed: a corner twice, or an area of zero that could be removed or flipped away
  Index flat_faces = 0;        ///< of area zero, kept: removing them would open or change the surface
  Index duplicate_faces = 0;   ///< removed: of the same three corners as another one
  Index split_edges = 0;       ///< had more than two faces, or two that could not be joined
  Index isolated_faces = 0;    ///< taken out of their surroundings, where splitting edges was not enough
  Index split_vertices = 0;    ///< had more than one fan of faces
  Index turned_faces = 0;      ///< turned over, so that neighbours agree and the outside is outside
  Index cut_edges = 0;         ///< opened, since the surface has only one side (a Moebius strip)

  Index components = 0;
  Index closed_components = 0;
  Index holes = 0;  ///< loops of border edges
  Index border_edges = 0;
  long euler = 0;  ///< vertices - edges + faces
  long genus = 0;  ///< handles, summed over the components, as if every hole were closed by a disk

  /// Whether anything was done to the mesh.
  bool changed() const;
  /// Whether something was done that a user should hear of: more than merging, dropping what is empty, or turning
  /// faces.
  bool notable() const {
    return near_vertices + non_finite_faces + split_edges + isolated_faces + split_vertices + cut_edges + flat_faces >
           0;
  }
};

/// The counts of what was done to a mesh, not of what it is like.
inline constexpr Index RepairReport::*change_counts[] = {
    &RepairReport::merged_vertices,  &RepairReport::near_vertices,       &RepairReport::unreferenced_vertices,
    &RepairReport::non_finite_faces, &RepairReport::non_finite_vertices, &RepairReport::degenerate_faces,
    &RepairReport::duplicate_faces,  &RepairReport::split_edges,         &RepairReport::isolated_faces,
    &RepairReport::split_vertices,   &RepairReport::turned_faces,        &RepairReport::cut_edges};

inline bool RepairReport::changed() const {
  for (const auto count : change_counts)
    if (this->*count > 0) return true;
  return false;
}

}  // namespace toposcope
