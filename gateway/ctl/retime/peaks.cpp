#include "gateway/ctl/retime/peaks.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/ctl/retime/segments.hpp"

namespace tactus::ctl {
namespace {

/// Raises `most` to the largest magnitude, as a fraction of the bound. Most segments of a
/// trajectory are not the worst, which the hull shows at once.
void raise(double& most, const Polynomial& polynomial, double T, double bound) {
  const auto fraction = [bound](const Extremes& range) {
    return std::max(range.max, -range.min) / bound;
  };
  if (fraction(hull(polynomial, T)) > most)
    most = std::max(most, fraction(extremes(polynomial, T)));
}

void raise_by_joints(Peaks& most, const TimedPoint& from, const TimedPoint& to,
                     const MotionBounds& bounds, Interpolation order) {
  const double T = to.time_s - from.time_s;
  for (Eigen::Index k = 0; k < bounds.v.size(); ++k) {
    const Polynomial v = joint_segment(from, to, k, order).derivative(), a = v.derivative();
    raise(most.v, v, T, bounds.v[k]);
    raise(most.a, a, T, bounds.a[k]);
    raise(most.j, a.derivative(), T, bounds.j[k]);
  }
}

void raise_by_tip(Peaks& most, const TimedPoint& from, const TimedPoint& to,
                  const MotionBounds& bounds, Interpolation order) {
  const double T = to.time_s - from.time_s;
  const VectorBounds found[] = {translation_bounds(translation_segment(from, to, order), T),
                                rotation_segment(from, to, order).bounds()};
  for (Eigen::Index k = 0; k < 2; ++k) {
    most.v = std::max(most.v, found[k].v / bounds.v[k]);
    most.a = std::max(most.a, found[k].a / bounds.a[k]);
    most.j = std::max(most.j, found[k].j / bounds.j[k]);
  }
}

}  // namespace

double Peaks::stretch() const {
  return std::max({v, std::sqrt(a), std::cbrt(j)});
}

Peaks peaks(const std::vector<TimedPoint>& points, bool tip, const MotionBounds& bounds,
            bool quintic) {
  const Interpolation order = quintic ? Interpolation::kQuintic : Interpolation::kCubic;
  Peaks most;
  for (std::size_t i = 1; i < points.size(); ++i)
    (tip ? raise_by_tip : raise_by_joints)(most, points[i - 1], points[i], bounds, order);
  return most;
}

}  // namespace tactus::ctl
