#include "kernel/reference/space/rotation_segment.hpp"

#include "kernel/math/so3.hpp"

namespace tactus {
namespace {

/// Rotation vector and its rates at one end.
using VectorBoundary = BoundaryOf<Vector3>;

/// Angular velocity and acceleration in the rotated frame.
struct BodyMotion {
  Vector3 w, alpha;
};

/// Returns the motion of R = exp(phi) with the derivatives dphi and ddphi.
BodyMotion body_motion(const Vector3& phi, const Vector3& dphi, const Vector3& ddphi) {
  const RightJacobian j(phi);
  return {j.times(dphi), j.times(ddphi) + j.rate_times(dphi, dphi)};
}

/// Returns the derivatives of phi that give the body motion; the inverse of body_motion().
VectorBoundary vector_boundary(const Vector3& phi, const BodyMotion& motion) {
  const RightJacobian j(phi);
  const Vector3 dphi = j.inverse_times(motion.w);
  return {phi, dphi, j.inverse_times(motion.alpha - j.rate_times(dphi, dphi))};
}

/// Returns the rotation vector counted from `start`, the unit quaternion of `from`.
VectorPolynomial between(const Eigen::Quaterniond& start, const RotationBoundary& from,
                         const RotationBoundary& to, double T, Interpolation order) {
  const Vector3 phi = log_so3(from.r.conjugate() * to.r);
  const Eigen::Quaterniond base_in_from = start.conjugate();
  const Eigen::Quaterniond base_in_to = (start * exp_so3(phi)).conjugate();
  // At the start J_r is the identity and dJ_r/dt dphi = dphi x dphi = 0.
  const VectorBoundary begin = {Vector3::Zero(), base_in_from * from.w, base_in_from * from.alpha};
  return join(order, begin, vector_boundary(phi, {base_in_to * to.w, base_in_to * to.alpha}), T);
}

}  // namespace

RotationSegment::RotationSegment(const RotationBoundary& from, const RotationBoundary& to, double T,
                                 Interpolation order)
    : from_(from.r.normalized()), phi_(between(from_, from, to, T, order)), duration_(T) {}

RotationBoundary RotationSegment::at(double t) const {
  const VectorPolynomial here = phi_.from(t);
  const Vector3& phi = here.c[0];
  const BodyMotion motion = body_motion(phi, here.c[1], 2.0 * here.c[2]);
  RotationBoundary now;
  now.r = from_ * exp_so3(phi);
  now.w = now.r * motion.w;
  now.alpha = now.r * motion.alpha;
  return now;
}

TurningRates RotationSegment::rates(double t) const {
  const VectorPolynomial here = phi_.from(t);
  const TurningRates turned = turning_rates(here);
  const Eigen::Quaterniond r = from_ * exp_so3(here.c[0]);
  return {r * turned.w, r * turned.alpha, r * turned.jerk};
}

RotationSegment RotationSegment::part(double begin, double duration) const {
  RotationSegment part = *this;
  part.phi_ = phi_.from(begin);
  part.duration_ = duration;
  return part;
}

}  // namespace tactus
