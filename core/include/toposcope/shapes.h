// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"
#include "toposcope/options.h"
#include "toposcope/types.h"

namespace toposcope {

/// What a direction of a shape means, so that relations compare like with unlike: a segment is perpendicular to a
/// circle when its direction is parallel to the circle's normal.
enum class Orientation : std::uint32_t {
  none,
  plane_like,  ///< `direction` is a normal: circle, plane, line group of two or more segments
  line_like    ///< `direction` is along the shape: one segment, an axis
};

enum class Termination : std::uint32_t {
  closed_form,  ///< nothing to iterate
  converged,
  iteration_limit,
  failed,     ///< no fit; see `message`
  degenerate  ///< the points do not determine the shape; see `message`
};

/// A fitter's account of itself: why it stopped, cost before and after.
struct FitSummary {
  Termination termination = Termination::failed;  ///< how it ended
  std::string message;                            ///< one line, why; may be empty
  int iterations = 0;                             ///< of the refinement
  double initial_cost = 0;  ///< half the sum of squared (or robustified) distances, in squared mesh units
  double final_cost = 0;    ///< likewise
  /// Whether the fit came to an end.
  bool usable() const { return termination == Termination::closed_form || termination == Termination::converged; }
};

/// One entry of `parameters` in result.json. `columns` is 1 for a number, 3 for a point or direction;
/// `values.size() / columns` entries (several for `endpoints`). Lengths in mesh units, angles in rad.
struct ShapeParameter {
  std::string name;            ///< as result.json has it
  int columns = 1;             ///< numbers in an entry
  std::vector<double> values;  ///< entry by entry, lengths in mesh units
};

/// A number that the model's ranges may bound, named and with its dimension in the plugin's measure table.
struct Measure {
  std::string name;  ///< of the table
  double value = 0;  ///< mesh unit to the power that the table says; angles in rad
  double sd = 0;     ///< standard deviation, same unit
};

/// A shape fitted to the points of one or more working sets (G(W) and E(W) of dissertation 3.4.1).
struct FittedShape {
  FitSummary summary;                      ///< of the fit
  std::vector<ShapeParameter> parameters;  ///< as result.json has them
  std::vector<Measure> measures;           ///< of those that the plugin provides
  std::vector<std::string> covariance_of;  ///< names of the free parameters, in the order of `covariance`
  std::vector<double> covariance;          ///< row-major square matrix, products of their units

  Orientation orientation = Orientation::none;  ///< what `direction` means
  Vec3 direction = Vec3::UnitZ();               ///< unit length
  double direction_sd = 0;                      ///< rad; root mean square of its tilts' standard deviations
  Vec3 centroid = Vec3::Zero();                 ///< mesh unit
  double centroid_sd = 0;                       ///< mesh unit; root mean square over its components

  std::vector<Vec3> outline;    ///< mesh unit; points along the shape, at most about one mean edge apart (at most 512)
  bool outline_closed = false;  ///< its last point is joined to the first

  double rms = std::numeric_limits<double>::infinity();  ///< of the explained points' distances, mesh unit
  double explained = 0;    ///< arc length (curves) or square root of area (surfaces) that has points, in mean edges
  double unexplained = 0;  ///< the same measure of the points that the shape leaves out
  double coverage = 1;     ///< part of the shape that has points, 0 to 1

  /// By name; null where the shape has none of it.
  const Measure* measure(std::string_view name) const { return named(measures, name); }
  /// \copydoc measure
  const ShapeParameter* parameter(std::string_view name) const { return named(parameters, name); }

 private:
  template <class Item>
  static const Item* named(const std::vector<Item>& items, std::string_view name) {
    for (const Item& item : items)
      if (item.name == name) return &item;
    return nullptr;
  }
};

/// The points to fit and the lengths that give them scale.
struct FitInput {
  std::span<const Vec3> points;        ///< the working sets' points, one set after the other
  std::span<const double> areas;       ///< the surface that each point stands for, a third of its triangles; squared
                                       ///< mesh units
  std::span<const Index> set_offsets;  ///< size sets + 1, into `points`
  std::span<const Box> set_boxes;      ///< one per set
  Box box;                             ///< bb(w): of all points
  Box object_box;                      ///< bb(O)
  double mean_edge = 0;                ///< mesh unit
  std::span<const double> integrated_mean_curvature = {};  ///< of each point's surface (mean_curvature_measure of
                                                           ///< toposcope/geometry/curvature.h), mesh unit; empty: not
                                                           ///< known
  const MeshView* mesh = nullptr;                          ///< that the points are vertices of; null: of none
  std::span<const Index> vertices = {};                    ///< of `mesh`, one per point; empty where it is null
};

/// What a measure may be.
struct Interval {
  double low = -std::numeric_limits<double>::infinity();  ///< in the unit of the measure
  double high = std::numeric_limits<double>::infinity();  ///< likewise
};

/// Fits one kind of shape (dissertation 4.4). Thread-safe: `fit` is called from many threads at once.
class ShapeFitter {
 public:
  virtual ~ShapeFitter() = default;
  /// Never throws for points it cannot fit: says so in the summary.
  /// \throw std::invalid_argument  arguments that make no sense together
  /// \param arguments  what the model says of the shape (`segments: 3`), checked against the descriptor's arguments
  virtual FittedShape fit(const FitInput& input, const Options& arguments, Context& context) const = 0;
  /// Distance from a point to a shape that this fitter made, mesh unit.
  virtual double distance(const FittedShape& shape, const Vec3& point) const = 0;
  /// What the boxes of the working sets alone say of a measure, so that a group that cannot meet the model's ranges
  /// is dropped before it is fitted. Must contain every value that `fit` could return.
  virtual Interval bounds(std::string_view /*measure*/, std::span<const Box> /*sets*/,
                          const Options& /*arguments*/) const {
    return {};
  }
};

}  // namespace toposcope
