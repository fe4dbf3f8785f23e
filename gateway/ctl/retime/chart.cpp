#include "gateway/ctl/retime/chart.hpp"

#include "gateway/ctl/retime/tip_numbers.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/reference/space/vector_bounds.hpp"

namespace tactus::ctl {

Numbers Chart::to(const Numbers& position) const {
  if (!tip_) return position - origin_;
  const Vector3 way = translation_of(position) - translation_of(origin_);
  return stacked(way, log_so3(orientation_of(origin_).conjugate() * orientation_of(position)));
}

PathPlace Chart::from(const PathPlace& x) const {
  PathPlace place = x;
  if (!tip_) {
    place.q += origin_;
    return place;
  }
  VectorPolynomial phi;
  phi.c = {rotation_of(x.q),          rotation_of(x.dq), rotation_of(x.ddq) / 2.0,
           rotation_of(x.dddq) / 6.0, Vector3::Zero(),   Vector3::Zero()};
  const TurningRates turning = turning_rates(phi);
  const Eigen::Quaterniond r = orientation_of(origin_) * exp_so3(phi.c[0]);
  place.q = tip_position(translation_of(origin_) + translation_of(x.q), r);
  place.dq.tail<3>() = r * turning.w;
  place.ddq.tail<3>() = r * turning.alpha;
  place.dddq.tail<3>() = r * turning.jerk;
  return place;
}

}  // namespace tactus::ctl
