#include "kernel/reference/rotation_segment.hpp"

#include <cstddef>

#include "kernel/math/so3.hpp"

namespace tactus {
namespace {

/// Rotation vector and its rates at one end.
struct VectorBoundary {
  Vector3 phi, dphi, ddphi;
};

/// Angular velocity and acceleration in the rotated frame.
struct BodyMotion {
  Vector3 w, alpha;
};

/// R = exp(phi) moving at dphi and ddphi.
BodyMotion body_motion(const Vector3& phi, const Vector3& dphi, const Vector3& ddphi) {
  const RightJacobian j(phi);
  return {j.times(dphi), j.times(ddphi) + j.rate_times(dphi, dphi)};
}

/// The rates of phi that give the body motion; the inverse of body_motion.
VectorBoundary vector_boundary(const Vector3& phi, const BodyMotion& motion) {
  const RightJacobian j(phi);
  const Vector3 dphi = j.inverse_times(motion.w);
  return {phi, dphi, j.inverse_times(motion.alpha - j.rate_times(dphi, dphi))};
}

/// Of two numbers; NaN if either is.
double larger(double a, double b) {
  return a > b ? a : b >= a ? b : a + b;
}
double smaller(double a, double b) {
  return a < b ? a : b <= a ? b : a + b;
}

using Bounds = RotationSegment::Bounds;

/// phi and its derivatives, by number.
using Derivatives = std::array<VectorPolynomial, Polynomial::kOrder + 1>;

/// phi passed with these derivatives. The axes turn: w x w is zero and w x alpha is not.
RotationSegment::Rates rates_of(const Vector3& phi, const Vector3& dphi, const Vector3& ddphi,
                                const Vector3& dddphi) {
  const RightJacobian j(phi);
  RotationSegment::Rates rates;
  rates.w = j.times(dphi);
  rates.alpha = j.times(ddphi) + j.rate_times(dphi, dphi);
  rates.jerk = j.second_rate(dphi, ddphi, dddphi) + rates.w.cross(rates.alpha);
  return rates;
}

/// Norms at one time: of the first four derivatives of phi, and of the motion.
struct Norms {
  double v, a, p, snap;
  Bounds motion;
};

Norms norms_at(const Derivatives& phi, double t) {
  const Vector3 dphi = phi[1].at(t), ddphi = phi[2].at(t), dddphi = phi[3].at(t);
  const RotationSegment::Rates rates = rates_of(phi[0].at(t), dphi, ddphi, dddphi);
  return {dphi.norm(),
          ddphi.norm(),
          dddphi.norm(),
          phi[4].at(t).norm(),
          {rates.w.norm(), rates.alpha.norm(), rates.jerk.norm()}};
}

// Bounds between two times h apart. A function f of time stays within h^2/8 max |f''| of its chord,
// and the chord's norm is largest at an end, hence
//   |f| <= max(|f| at the ends) + h^2/8 max |f''|.                                              (1)
// From F, the constant fifth derivative of phi, (1) bounds the fourth, third, second and first:
// S, P, A, V.
//
// In axes that do not turn, those of the start, the motion is w = J phi' and its derivatives, with
// the left Jacobian J(phi) = J_r(-phi) = integral over u in [0, 1] of exp(u [phi]x) du. The n-th
// derivative of exp at a skew matrix in directions H_1 ... H_n is a mean of products of rotations
// and of the H_i, so its norm is at most the product of the |H_i|. Along phi(t), by the chain rule
// and with the factors u^n integrated,
//   |J| <= 1,  |J'| <= V/2,  |J''| <= A/2 + V^2/3,  |J'''| <= P/2 + V A + V^3/4,
//   |J''''| <= S/2 + 4/3 V P + A^2 + 3/2 V^2 A + V^4/5.
// Therefore, by Leibniz' rule for J phi',
//   |w| <= V,  |w'| <= A + V^2/2,  |w''| <= P + 3/2 V A + V^3/3,                                (2)
//   |w'''| <= S + 2 V P + 3/2 A^2 + 2 V^2 A + V^4/4,
//   |w''''| <= F + 5/2 V S + 5 A P + 10/3 V^2 P + 5 V A^2 + 5/2 V^3 A + V^5/5,
// the last three to be used in (1) for w, alpha = w' and the jerk w''. The smaller of (1) and (2)
// holds.
Bounds bounds_between(const Norms& x, const Norms& y, double fifth, double h) {
  const double k = h * h / 8.0;
  const double s = larger(x.snap, y.snap);  // linear in time
  const double p = larger(x.p, y.p) + k * fifth;
  const double a = larger(x.a, y.a) + k * s;
  const double v = larger(x.v, y.v) + k * p, vv = v * v;
  const double w2 = p + 1.5 * v * a + vv * v / 3.0;
  const double w3 = s + 2.0 * v * p + 1.5 * a * a + 2.0 * vv * a + 0.25 * vv * vv;
  const double w4 = fifth + 2.5 * v * s + 5.0 * a * p + 10.0 / 3.0 * vv * p + 5.0 * v * a * a +
                    2.5 * vv * v * a + 0.2 * vv * vv * v;
  return {smaller(v, larger(x.motion.w, y.motion.w) + k * w2),
          smaller(a + 0.5 * vv, larger(x.motion.alpha, y.motion.alpha) + k * w3),
          smaller(w2, larger(x.motion.jerk, y.motion.jerk) + k * w4)};
}

}  // namespace

RotationSegment::RotationSegment(const RotationBoundary& from, const RotationBoundary& to, double T,
                                 Order order)
    : from_(from.r.normalized()), duration_(T), linear_(order == Order::kLinear) {
  const Vector3 phi = log_so3(from.r.conjugate() * to.r);
  const Eigen::Quaterniond base_in_from = from_.conjugate();
  const Eigen::Quaterniond base_in_to = (from_ * exp_so3(phi)).conjugate();
  const VectorBoundary a =
      vector_boundary(Vector3::Zero(), {base_in_from * from.w, base_in_from * from.alpha});
  const VectorBoundary b = vector_boundary(phi, {base_in_to * to.w, base_in_to * to.alpha});
  for (int i = 0; i < 3; ++i) {
    const Boundary start = {a.phi[i], a.dphi[i], a.ddphi[i]};
    const Boundary end = {b.phi[i], b.dphi[i], b.ddphi[i]};
    phi_.axis[static_cast<std::size_t>(i)] = order == Order::kQuintic ? quintic(start, end, T)
                                             : order == Order::kCubic ? cubic(start, end, T)
                                                                      : linear(start, end, T);
  }
}

RotationBoundary RotationSegment::at(double t) const {
  const VectorPolynomial dphi = phi_.derivative();
  const Vector3 phi = phi_.at(t);
  const BodyMotion motion = body_motion(phi, dphi.at(t), dphi.derivative().at(t));
  RotationBoundary now;
  now.r = from_ * exp_so3(phi);
  now.w = now.r * motion.w;
  now.alpha = now.r * motion.alpha;
  return now;
}

RotationSegment RotationSegment::part(double begin, double duration) const {
  RotationSegment part = *this;
  part.phi_ = phi_.from(begin);
  part.duration_ = duration;
  return part;
}

RotationSegment::Rates RotationSegment::rates(double t) const {
  const VectorPolynomial dphi = phi_.derivative(), ddphi = dphi.derivative();
  return rates_of(phi_.at(t), dphi.at(t), ddphi.at(t), ddphi.derivative().at(t));
}

RotationSegment::Bounds RotationSegment::bounds() const {
  constexpr int kPieces = 32;
  Derivatives phi;
  phi[0] = phi_;
  for (std::size_t i = 1; i < phi.size(); ++i) phi[i] = phi[i - 1].derivative();
  if (linear_) {
    const double w = phi[1].at(0.0).norm();
    return {w, 0.0 * w, 0.0 * w};  // NaN if w is
  }
  const double fifth = phi[5].at(0.0).norm(), h = duration_ / kPieces;
  Norms last = norms_at(phi, 0.0);
  Bounds most = last.motion;
  for (int i = 1; i <= kPieces; ++i) {
    const Norms next = norms_at(phi, h * i);
    const Bounds between = bounds_between(last, next, fifth, h);
    most = {larger(most.w, between.w), larger(most.alpha, between.alpha),
            larger(most.jerk, between.jerk)};
    last = next;
  }
  return most;
}

}  // namespace tactus
