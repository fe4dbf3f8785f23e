#include "gateway/ctl/retime/segments.hpp"

#include "gateway/ctl/retime/tip_numbers.hpp"

namespace tactus::ctl {

Polynomial joint_segment(const TimedPoint& from, const TimedPoint& to, Eigen::Index k,
                         Interpolation order) {
  const auto end = [k](const TimedPoint& point) {
    return Boundary{point.q[k], point.dq[k], point.ddq[k]};
  };
  return join(order, end(from), end(to), to.time_s - from.time_s);
}

VectorPolynomial translation_segment(const TimedPoint& from, const TimedPoint& to,
                                     Interpolation order) {
  const auto end = [](const TimedPoint& point) {
    return BoundaryOf<Vector3>{translation_of(point.q), translation_of(point.dq),
                               translation_of(point.ddq)};
  };
  return join(order, end(from), end(to), to.time_s - from.time_s);
}

RotationSegment rotation_segment(const TimedPoint& from, const TimedPoint& to,
                                 Interpolation order) {
  const auto end = [](const TimedPoint& point) {
    return RotationBoundary{orientation_of(point.q), rotation_of(point.dq), rotation_of(point.ddq)};
  };
  return {end(from), end(to), to.time_s - from.time_s, order};
}

}  // namespace tactus::ctl
