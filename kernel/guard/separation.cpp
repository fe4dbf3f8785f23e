#include "kernel/guard/separation.hpp"

#include <cmath>

#include "kernel/core/loop_bound.hpp"

namespace tactus {
namespace {

/// Returns the part x / y of a segment, between its ends. A segment without length has y = 0.
double part(double x, double y) {
  const double p = y > 0.0 ? x / y : 0.0;
  return p < 0.0 ? 0.0 : p > 1.0 ? 1.0 : p;
}

/// Returns the part of x that is beyond a box of half size h.
double beyond(double x, double h) {
  return x > h ? x - h : x < -h ? x + h : 0.0;
}

/// Returns half the slope, at t, of the squared distance between a box and the point a + t d. It
/// rises with t, and is linear between the six t at which the point crosses the plane of a face.
inline double slope(const Vector3& a, const Vector3& d, const Vector3& half, double t) {
  double sum = 0.0;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) sum += d[i] * beyond(a[i] + t * d[i], half[i]);
  return sum;
}

/// Returns where the segment a + t d, 0 <= t <= 1, is nearest to the box: where the slope is zero.
double nearest_to_box(const Vector3& a, const Vector3& d, const Vector3& half) {
  double low = 0.0, high = 1.0;
  double at_low = slope(a, d, half, low), at_high = slope(a, d, half, high);
  LoopBound<3> axes;
  for (int i = 0; i < 3; ++i) {
    axes.tick();
    LoopBound<2> sides;
    for (int side = -1; side <= 1; side += 2) {
      sides.tick();
      const double t = (side * half[i] - a[i]) / d[i];  // without effect if d[i] is 0
      if (!(t > low && t < high)) continue;
      const double at_t = slope(a, d, half, t);
      if (at_t < 0.0) {
        low = t;
        at_low = at_t;
      } else {
        high = t;
        at_high = at_t;
      }
    }
  }
  return low + (high - low) * part(-at_low, at_high - at_low);
}

/// Returns how far along n a segment begins, from its point a: at an end. NaN is kept.
double first_along(const Vector3& n, const Vector3& d) {
  const double at_b = n.dot(d);
  return at_b > 0.0 ? 0.0 : at_b;
}

/// Returns the gap of two cores along n, m, less their radii. `gap` is as long as n times it. What
/// is left of n where the cores meet is rounding: a direction as short as that proves nothing.
double along(const Vector3& n, double gap, double radii) {
  constexpr double kShortest = 1e-12;  // m
  const double length = std::sqrt(n.squaredNorm());
  return (length > kShortest ? gap / length : 0.0) - radii;
}

}  // namespace

// Ericson, Real-Time Collision Detection, 2005, section 5.1.9: the nearest points of two segments
// p = a + s d. If t has to be moved to an end, s follows; otherwise it keeps its value.
double separation(const Capsule& capsule, const Capsule& other) {
  const Vector3 d1 = capsule.b - capsule.a, d2 = other.b - other.a, r = capsule.a - other.a;
  const double a = d1.squaredNorm(), b = d1.dot(d2), c = d1.dot(r);
  const double e = d2.squaredNorm(), f = d2.dot(r);
  const double on_line = part(b * f - c * e, a * e - b * b);
  const double t = part(b * on_line + f, e), s = part(b * t - c, a);
  const Vector3 n = r + s * d1 - t * d2;
  const double gap = n.dot(r) + first_along(n, d1) + first_along(n, -d2);
  return along(n, gap, capsule.radius + other.radius);
}

double separation(const Capsule& capsule, const BoxShape& box) {
  const Vector3 a = box.r.transpose() * (capsule.a - box.centre);
  const Vector3 d = box.r.transpose() * (capsule.b - capsule.a);
  const Vector3 at = a + nearest_to_box(a, d, box.half) * d;
  Vector3 n;
  for (int i = 0; i < 3; ++i) n[i] = beyond(at[i], box.half[i]);
  const double gap = n.dot(a) + first_along(n, d) - n.cwiseAbs().dot(box.half);
  return along(n, gap, capsule.radius);
}

}  // namespace tactus
