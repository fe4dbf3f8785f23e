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

/// Norms of the derivatives of phi (v, a, jerk, snap: first to fourth) and of the body motion,
/// at one time or as bounds between two.
struct Norms {
  double v, a, jerk, snap, w, alpha;
};

/// phi and its derivatives, by number.
using Derivatives = std::array<VectorPolynomial, Polynomial::kOrder + 1>;

Norms norms_at(const Derivatives& phi, double t) {
  const Vector3 dphi = phi[1].at(t), ddphi = phi[2].at(t);
  const BodyMotion motion = body_motion(phi[0].at(t), dphi, ddphi);
  return {dphi.norm(),         ddphi.norm(),    phi[3].at(t).norm(),
          phi[4].at(t).norm(), motion.w.norm(), motion.alpha.norm()};
}

// Bounds between two times h apart. A function f of time stays within h^2/8 max |f''| of its chord,
// and the chord's norm is largest at an end, hence
//   |f| <= max(|f| at the ends) + h^2/8 max |f''|.                                              (1)
// From the constant fifth derivative of phi, (1) bounds the fourth, third, second and first: snap
// S, jerk P, a A, v V.
//
// J_r = integral over u in [0, 1] of exp(-u [phi]x) du. The n-th derivative of exp at a skew matrix
// in directions H_1 ... H_n is a mean of products of rotations and of the H_i, so its norm is at
// most the product of the |H_i|. Along phi(t), by the chain rule and with the factors u^n
// integrated,
//   |J_r| <= 1,  |J_r'| <= V/2,  |J_r''| <= A/2 + V^2/3,  |J_r'''| <= P/2 + V A + V^3/4.
// The body motion is w = J_r phi', alpha = w' = J_r phi'' + J_r' phi'. Therefore
//   |w| <= V,  |alpha| <= A + V^2/2,                                                            (2)
//   |w''| <= P + 3/2 V A + V^3/3,
//   |alpha''| <= S + 2 V P + 3/2 A^2 + 2 V^2 A + V^4/4,
// the last two to be used in (1). The smaller of (1) and (2) holds.
Norms bounds_between(const Norms& x, const Norms& y, double fifth, double h) {
  const double k = h * h / 8.0;
  Norms most;
  most.snap = larger(x.snap, y.snap);  // linear in time
  most.jerk = larger(x.jerk, y.jerk) + k * fifth;
  most.a = larger(x.a, y.a) + k * most.snap;
  most.v = larger(x.v, y.v) + k * most.jerk;
  const double v = most.v, vv = v * v, a = most.a;
  const double ddw = most.jerk + 1.5 * v * a + vv * v / 3.0;
  const double ddalpha =
      most.snap + 2.0 * v * most.jerk + 1.5 * a * a + 2.0 * vv * a + 0.25 * vv * vv;
  most.w = smaller(v, larger(x.w, y.w) + k * ddw);
  most.alpha = smaller(a + 0.5 * vv, larger(x.alpha, y.alpha) + k * ddalpha);
  return most;
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

RotationSegment::Bounds RotationSegment::bounds() const {
  constexpr int kPieces = 32;
  Derivatives phi;
  phi[0] = phi_;
  for (std::size_t i = 1; i < phi.size(); ++i) phi[i] = phi[i - 1].derivative();
  if (linear_) {
    const double w = phi[1].at(0.0).norm();
    return {w, 0.0 * w};  // NaN if w is
  }
  const double fifth = phi[5].at(0.0).norm(), h = duration_ / kPieces;
  Norms last = norms_at(phi, 0.0);
  Bounds most = {last.w, last.alpha};
  for (int i = 1; i <= kPieces; ++i) {
    const Norms next = norms_at(phi, h * i);
    const Norms between = bounds_between(last, next, fifth, h);
    most.w = larger(most.w, between.w);
    most.alpha = larger(most.alpha, between.alpha);
    last = next;
  }
  return most;
}

}  // namespace tactus
