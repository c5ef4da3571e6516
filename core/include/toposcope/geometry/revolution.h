// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Surfaces that are round about an axis (sphere, cylinder, cone, torus), fitted to points without normals: what their
// plugins share, part of toposcope_geometry. A kind of surface says how far a point is from it and how it is begun; the
// search, the robust refinement and the account of what is explained are the same for all.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "toposcope/shapes.h"

namespace toposcope {

/// A surface of revolution: its axis, and up to two numbers of its profile, the curve that turns about it.
struct Revolution {
  Vec3 origin = Vec3::Zero();              ///< on the axis
  Vec3 axis = Vec3::UnitZ();               ///< unit length
  std::array<double, 2> profile = {0, 0};  ///< what they mean the kind says
};

/// Signed distance of a point from the profile, and its derivatives. The point is given by its distance from the axis
/// (radius) and its position along it (height over the origin).
struct ProfileDistance {
  double value = 0;                           ///< length, negative on the inside
  double by_radius = 0;                       ///< derivative by the distance from the axis
  double by_height = 0;                       ///< derivative by the height
  std::array<double, 2> by_profile = {0, 0};  ///< derivatives by the numbers of the profile
};

/// A point with the normal of the plane through its neighbours; the normal's sign means nothing.
struct OrientedPoint {
  Vec3 point;   ///< mesh unit
  Vec3 normal;  ///< unit length
};

/// What of a surface may move in a fit.
struct Freedom {
  int shifts = 0;                ///< of the origin: 2 across the axis, or 3
  int tilts = 0;                 ///< of the axis: 2, or 0 where it means nothing
  int profile = 0;               ///< numbers of the profile, 1 or 2
  bool second_is_angle = false;  ///< the second number of the profile is in rad, the others are lengths
  /// Parameters that a fit has.
  int count() const { return shifts + tilts + profile; }
};

/// What the points that belong to a surface say of it.
struct RevolutionAccount {
  Freedom freedom{};               ///< of the kind of surface
  std::array<Vec3, 3> frame;       ///< two directions across the axis, which turn with the points, and the axis
  std::vector<double> covariance;  ///< row-major, of shifts (along the frame), tilts (rad, along the frame), profile
  double low = 0;                  ///< least height over the origin
  double high = 0;                 ///< greatest height over the origin
  double turn = 0;                 ///< part of the turn about the axis that has points, 0 to 1
  double area = 0;                 ///< that has points
  double samples = 1;              ///< independent ones: one per square of a mean edge, as many as there are points
  double position_variance = 0;    ///< mean square distance of the points from their mean, along the axis
  double reach = 0;                ///< points within it belong to the surface, mesh unit

  /// Of one parameter, by its place in the covariance.
  double variance(int parameter) const {
    return covariance[static_cast<std::size_t>(parameter) * static_cast<std::size_t>(freedom.count() + 1)];
  }
  /// Derivatives by the parameters of a point on the axis, `height` over the origin: three rows, row-major.
  std::vector<double> point_on_axis(double height) const;
  /// The same of the axis.
  std::vector<double> axis_direction() const;
  /// Covariance of quantities whose derivatives by the parameters are given, row-major.
  std::vector<double> of(std::span<const double> derivatives) const;
};

/// One kind of surface. Lengths in `through` and `about` are in any unit.
class RevolutionKind {
 public:
  virtual ~RevolutionKind() = default;
  /// As messages call it: "sphere".
  virtual const char* name() const = 0;
  /// What a fit may move.
  virtual Freedom freedom() const = 0;
  /// Of the point at that distance from the axis and that height over the origin.
  virtual ProfileDistance distance(double radius, double height, const std::array<double, 2>& profile) const = 0;
  /// So few oriented points that most such samples hold no outlier, enough for `through`.
  virtual std::size_t start_points() const = 0;
  /// A surface near the points, which are at least `start_points`; exact where they lie on one with exact normals.
  virtual std::optional<Revolution> through(std::span<const OrientedPoint> points) const = 0;
  /// A surface near the points about a given axis. `ring` lies about the axis, near the points; its height is their
  /// mean.
  virtual std::optional<Revolution> about(const Revolution& ring, std::span<const Vec3> points) const = 0;
  /// The same surface with its axis and profile as `report` wants them.
  virtual Revolution settled(const Revolution& surface) const { return surface; }
  /// How deep chords between the points lie under the surface, for each radius of the profile: how much smaller it may
  /// be than it is at the points. By the gaps about the axis, if the kind does not say otherwise.
  /// \param points  ends of chords on the surface, at least one
  virtual std::array<double, 2> sagittas(const Revolution& surface, const RevolutionAccount& account,
                                         std::span<const Vec3> points) const;
  /// Fills in parameters, measures, covariance, centroid, outline, coverage of a fit.
  /// \return why the points do not determine the surface, or nothing
  virtual std::string report(const Revolution& surface, const RevolutionAccount& account, const FitInput& input,
                             FittedShape& shape) const = 0;
};

/// A plugin of a kind of surface but for the distance to a shape. Random and regular starts are ranked by a quantile of
/// the distances, the best refined by least Geman-McClure distances (Levenberg-Marquardt); then the account of it.
class RevolutionFitter : public ShapeFitter {
 public:
  /// \param options  of a table with `scale_option`
  RevolutionFitter(std::unique_ptr<const RevolutionKind> kind, const Options& options)
      : kind_(std::move(kind)), scale_(options.real("scale")) {}
  FittedShape fit(const FitInput& input, const Options& arguments, Context& context) const override;
  /// Of `coverage`, `area`, `length`, and of radii by any name.
  Interval bounds(std::string_view measure, std::span<const Box> sets, const Options& arguments) const override;

 private:
  std::unique_ptr<const RevolutionKind> kind_;
  double scale_;  // mean edges
};

/// The row of `scale` in the option table of such a plugin.
constexpr OptionSpec scale_option(const char* meaning) {
  return {"scale", OptionType::real, "mean-edges", "1", "0.05", "20", meaning};
}

/// Radii above so many diagonals of bb(w) are those of something flat (or of a straight tube).
inline constexpr double flat_diagonals = 10;
/// An angle whose standard deviation is a greater part of it is not determined: in three deviations is nothing.
inline constexpr double most_uncertain = 1.0 / 3;
/// The same of a radius, whose deviation is stretched (curvature_stretch): before that it is a third.
inline constexpr double most_uncertain_radius = 1;

// ---- what the kinds share ----

/// Distance from the axis, and height over the origin.
struct AxisPosition {
  double radius = 0;  ///< distance from the axis
  double height = 0;  ///< along the axis
};
AxisPosition position(const Revolution& surface, const Vec3& point);

/// Least squares circle |x - c| = r in the plane, by (|x|^2) = 2 c.x + k; no circle for points on a line.
struct PlaneCircle {
  double x = 0;       ///< of the centre
  double y = 0;       ///< of the centre
  double radius = 0;  ///< at least 0
};
std::optional<PlaneCircle> plane_circle(std::span<const std::array<double, 2>> points);

/// The lines that are to be drawn along a surface, one after the other, each begun where the last one ended.
class OutlinePath {
 public:
  /// From center + x cos(from) + y sin(from) to the same of `to`.
  void arc(const Vec3& center, const Vec3& x, const Vec3& y, double from, double to);
  /// The straight line from one to the other.
  void line(const Vec3& from, const Vec3& to);
  /// Points at most `step` apart, but no more than 512.
  std::vector<Vec3> points(double step) const;

 private:
  struct Piece {
    Vec3 center, x, y;
    double from, to, length;
  };
  std::vector<Piece> pieces_;
};

/// A ring at each end of a surface and a straight line between them. \param radii  at `low` and `high`
OutlinePath two_rings(const Revolution& surface, const RevolutionAccount& account, std::array<double, 2> radii);

}  // namespace toposcope
