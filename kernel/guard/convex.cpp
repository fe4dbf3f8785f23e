#include "kernel/guard/convex.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"

namespace tactus {
namespace {

/// Returns the distance of a point from the segment from the origin to `tip`.
double from_segment(const Vector3& point, const Vector3& tip) {
  const double square = tip.squaredNorm();
  const double part = square > 0.0 ? std::clamp(point.dot(tip) / square, 0.0, 1.0) : 0.0;
  return (point - part * tip).norm();
}

}  // namespace

double radius_around(const Hull& points, const Vector3& tip) {
  double radius = 0.0;
  LoopBound<Hull::kMost> all;
  for (int i = 0; i < points.count(); ++i) {
    all.tick();
    radius = std::max(radius, from_segment(points[i], tip));
  }
  return radius;
}

Vector3 Convex::take(const Hull& points) {
  Vector3 low = points[0], high = points[0];
  LoopBound<Hull::kMost> all;
  for (int i = 1; i < points.count(); ++i) {
    all.tick();
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  core = Core::kHull;
  hull = &points;
  middle = 0.5 * (low + high);
  return high - low;
}

Vector3 Convex::farthest(const Vector3& n) const {
  if (core == Core::kHull) return hull->farthest(n) - middle;
  if (core == Core::kSegment) return n.dot(half) < 0.0 ? Vector3(-half) : half;
  Vector3 point = half;
  if (core == Core::kCylinder) {
    const double across = std::sqrt(n.x() * n.x() + n.y() * n.y());
    const double scale = across > 0.0 ? half.x() / across : 0.0;
    point.x() = scale * n.x();
    point.y() = scale * n.y();
  } else {
    if (n.x() < 0.0) point.x() = -point.x();
    if (n.y() < 0.0) point.y() = -point.y();
  }
  if (n.z() < 0.0) point.z() = -point.z();
  return point;
}

}  // namespace tactus
