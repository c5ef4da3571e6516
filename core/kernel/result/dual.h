// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A number with its first derivatives by independent unit-variance causes, so that its variance is the squared length
// of them and the covariance of two numbers their product.

#include <Eigen/Core>
#include <cmath>

#include "model/expression_program.h"

namespace toposcope {

struct Dual {
  double value = 0;
  Eigen::VectorXd by;  ///< derivatives; empty: a constant

  double variance() const { return by.squaredNorm(); }
};

/// f and its derivatives by left and right.
inline Dual chain(double value, const Dual& left, double by_left, const Dual& right, double by_right) {
  Dual result{value, {}};
  if (left.by.size() > 0) result.by = by_left * left.by;
  if (right.by.size() > 0) {
    if (result.by.size() > 0)
      result.by += by_right * right.by;
    else
      result.by = by_right * right.by;
  }
  return result;
}

inline Dual operator+(const Dual& a, const Dual& b) {
  return chain(a.value + b.value, a, 1, b, 1);
}
inline Dual operator-(const Dual& a, const Dual& b) {
  return chain(a.value - b.value, a, 1, b, -1);
}
inline Dual operator*(const Dual& a, const Dual& b) {
  return chain(a.value * b.value, a, b.value, b, a.value);
}
inline Dual operator/(const Dual& a, const Dual& b) {
  return chain(a.value / b.value, a, 1 / b.value, b, -a.value / (b.value * b.value));
}
inline Dual operator-(const Dual& a) {
  return {-a.value, -a.by};
}
inline Dual abs(const Dual& a) {
  return a.value < 0 ? -a : a;
}
inline Dual atan2(const Dual& y, const Dual& x) {
  const double square = x.value * x.value + y.value * y.value;
  return chain(std::atan2(y.value, x.value), y, x.value / square, x, -y.value / square);
}

/// The value of a binary operation of an expression.
inline Dual apply(Operation operation, const Dual& left, const Dual& right) {
  switch (operation) {
    case Operation::add:
      return left + right;
    case Operation::subtract:
      return left - right;
    case Operation::multiply:
      return left * right;
    case Operation::divide:
      return left / right;
    case Operation::minimum:
      return right.value < left.value ? right : left;
    default:
      return left.value < right.value ? right : left;
  }
}

/// Three of them.
struct DualVector {
  Dual x, y, z;
  Vec3 value() const { return {x.value, y.value, z.value}; }
};

inline DualVector operator-(const DualVector& a, const DualVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline DualVector operator*(const Dual& s, const DualVector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Dual dot(const DualVector& a, const DualVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline DualVector cross(const DualVector& a, const DualVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The length. Of 0 no direction is the steepest: then each component moves it by the mean share of a random direction.
inline Dual norm(const DualVector& a) {
  const double length = a.value().norm();
  const double share = 1 / std::sqrt(3.0);
  const Vec3 direction = length > 0 ? Vec3(a.value() / length) : Vec3(share, share, share);
  Dual result = chain(length, a.x, direction.x(), a.y, direction.y());
  return chain(length, result, 1, a.z, direction.z());
}

}  // namespace toposcope
