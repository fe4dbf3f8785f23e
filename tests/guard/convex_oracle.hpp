// The distance of two convex bodies, bracketed without libccd: by the conditional gradient method
// (Frank and Wolfe, 1956) over the pairs of their points. Every step has two points, whose distance
// is an upper bound, and a plane between the bodies, which is a lower one.
#pragma once

#include <algorithm>
#include <vector>

#include "kernel/core/types.hpp"

namespace tactus {

/// All points within `rounding` of the convex hull of these, or of circles of `radius` about them
/// in the plane of `normal`. In the base frame, m.
struct OracleBody {
  std::vector<Vector3> points;
  double radius = 0.0, rounding = 0.0;
  Vector3 normal = Vector3::UnitZ();

  Vector3 farthest(const Vector3& n) const {
    Vector3 out = n - n.dot(normal) * normal;
    out -= out.dot(normal) * normal;  // again: of n along the normal only rounding is left
    if (out.norm() > 0.0) out *= radius / out.norm();
    Vector3 best = points.front();
    for (const Vector3& point : points)
      if (n.dot(point) > n.dot(best)) best = point;
    return best + out;
  }
};

struct Bracket {
  double least = 0.0, most = 0.0;  ///< m; of the bodies, negative where they may meet
};

/// Minimises the norm of a point of the difference of the bodies, by steps along the line to the
/// point that is farthest against it and away from the one that is farthest along it.
inline Bracket bracket(const OracleBody& one, const OracleBody& other, int steps = 400) {
  struct Vertex {
    Vector3 at;
    double weight;
  };
  const auto farthest = [&](const Vector3& n) -> Vector3 {
    return one.farthest(n) - other.farthest(-n);
  };
  std::vector<Vertex> active = {{farthest(Vector3::UnitX()), 1.0}};
  Vector3 x = active.front().at;
  double least = 0.0;
  for (int i = 0; i < steps && x.norm() > 1e-9; ++i) {
    const Vector3 toward = farthest(-x);
    least = std::max(least, x.dot(toward) / x.norm());
    const auto away = std::max_element(
        active.begin(), active.end(),
        [&](const Vertex& a, const Vertex& b) { return x.dot(a.at) < x.dot(b.at); });
    const bool shrinks = x.dot(away->at - x) > x.dot(x - toward) && away->weight < 1.0;
    const Vector3 d = shrinks ? Vector3(x - away->at) : Vector3(toward - x);
    const double longest = shrinks ? away->weight / (1.0 - away->weight) : 1.0;
    if (!(d.squaredNorm() > 0.0)) break;
    const double step = std::clamp(-x.dot(d) / d.squaredNorm(), 0.0, longest);
    for (Vertex& vertex : active) vertex.weight *= shrinks ? 1.0 + step : 1.0 - step;
    if (shrinks)
      away->weight -= step;
    else
      active.push_back({toward, step});
    x += step * d;
    active.erase(std::remove_if(active.begin(), active.end(),
                                [](const Vertex& vertex) { return !(vertex.weight > 1e-14); }),
                 active.end());
    if (x.norm() - least < 1e-10) break;
  }
  const double radii = one.rounding + other.rounding;
  return {least - radii, x.norm() - radii};
}

}  // namespace tactus
