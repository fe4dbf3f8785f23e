#include "gateway/ctl/retime/missed_corners.hpp"

#include <algorithm>

#include "gateway/ctl/retime/segments.hpp"
#include "gateway/ctl/retime/tip_numbers.hpp"

namespace tactus::ctl {
namespace {

constexpr int kThirds = 30;  // of a segment that are left out, one after the other: down to 5e-6

/// Distance from a corner, as the largest fraction of a tolerance. A channel without one is
/// straight there.
double distance(const Numbers& position, const PathPiece& blend, const Numbers& tolerance) {
  const Numbers far = lengths(blend.chart.to(position), tolerance.size());
  return (tolerance > 0.0).select(far / tolerance, 0.0).maxCoeff();
}

/// Returns the least value on [0, T] of a function that falls, then rises.
template <class Function>
double least(Function value, double T) {
  double begin = 0.0, end = T;
  for (int i = 0; i < kThirds; ++i) {
    const double low = begin + (end - begin) / 3.0, high = end - (end - begin) / 3.0;
    if (value(low) < value(high))
      end = high;
    else
      begin = low;
  }
  return value((begin + end) / 2.0);
}

double least_of_joints(const TimedPoint& from, const TimedPoint& to, const PathPiece& blend,
                       const Numbers& tolerance, Interpolation order) {
  std::vector<Polynomial> joints;
  for (Eigen::Index k = 0; k < from.q.size(); ++k)
    joints.push_back(joint_segment(from, to, k, order));
  Numbers q = from.q;
  const auto value = [&](double t) {
    for (std::size_t k = 0; k < joints.size(); ++k)
      q[static_cast<Eigen::Index>(k)] = joints[k].at(t);
    return distance(q, blend, tolerance);
  };
  return least(value, to.time_s - from.time_s);
}

double least_of_tip(const TimedPoint& from, const TimedPoint& to, const PathPiece& blend,
                    const Numbers& tolerance, Interpolation order) {
  const VectorPolynomial p = translation_segment(from, to, order);
  const RotationSegment r = rotation_segment(from, to, order);
  const auto value = [&](double t) {
    return distance(tip_position(p.at(t), r.at(t).r), blend, tolerance);
  };
  return least(value, r.duration());
}

bool passes(const TimedPoint& from, const TimedPoint& to, const PathPiece& blend,
            const RetimeSettings& settings) {
  const Interpolation order = settings.jerk ? Interpolation::kQuintic : Interpolation::kCubic;
  const auto least = settings.tip ? least_of_tip : least_of_joints;
  return least(from, to, blend, settings.corners.tolerance, order) <= 1.0;
}

}  // namespace

std::vector<std::size_t> missed_corners(const PathSection& section,
                                        const std::vector<TimedPoint>& points,
                                        const RetimeSettings& settings) {
  std::vector<std::size_t> missed;
  if (points.empty() || settings.corners.tolerance.size() == 0) return missed;
  double s = 0.0;
  for (const PathPiece& piece : section.pieces) {
    const double middle = s + piece.length / 2.0;
    s += piece.length;
    if (piece.corner == 0) continue;
    const auto next =
        std::lower_bound(points.begin() + 1, points.end() - 1, middle,
                         [](const TimedPoint& point, double wanted) { return point.s < wanted; });
    // The nearest place may be in a segment beside that of the middle.
    const auto end = next + 1 == points.end() ? next : next + 1;
    auto to = next - 1 == points.begin() ? next : next - 1;
    while (to <= end && !passes(*(to - 1), *to, piece, settings)) ++to;
    if (to > end) missed.push_back(piece.corner);
  }
  return missed;
}

}  // namespace tactus::ctl
