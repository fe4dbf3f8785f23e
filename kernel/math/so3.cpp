#include "kernel/math/so3.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kernel/math/arctangent.hpp"
#include "kernel/math/sincos.hpp"

namespace tactus {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr std::size_t kTerms = 8;  // for s < 1: the first term left out, 1 / 22!, is 2^-60 of c_6

constexpr std::array<double, 2 * kTerms + 6> inverse_factorials() {
  std::array<double, 2 * kTerms + 6> inverse{};
  double factorial = 1.0;  // exact up to 22!
  for (std::size_t n = 0; n < inverse.size(); ++n) {
    if (n > 0) factorial *= static_cast<double>(n);
    inverse[n] = 1.0 / factorial;
  }
  return inverse;
}
constexpr auto kInverseFactorial = inverse_factorials();

/// Returns the power series of c_n for 0 <= s < 1 and n <= 7.
double series(std::size_t n, double s) {
  double sum = 0.0;
#pragma GCC unroll 8
  for (std::size_t k = kTerms; k-- > 0;) sum = kInverseFactorial[2 * k + n] - s * sum;
  return sum;
}

/// Returns the sign that makes the first nonzero number positive.
double sign_of_first(const Eigen::Quaterniond& r) {
  for (const double number : {r.w(), r.x(), r.y(), r.z()}) {
    if (number != 0.0) return number < 0.0 ? -1.0 : 1.0;
  }
  return 1.0;
}

}  // namespace

Stumpff stumpff(double s) {
  Stumpff c;
  if (s < 1.0) {  // c_n = 1/n! - s c_(n+2): nothing cancels downwards
    c.c7 = series(7, s);
    c.c6 = series(6, s);
    c.c5 = kInverseFactorial[5] - s * c.c7;
    c.c4 = kInverseFactorial[4] - s * c.c6;
    c.c3 = kInverseFactorial[3] - s * c.c5;
    c.c2 = kInverseFactorial[2] - s * c.c4;
    c.c1 = 1.0 - s * c.c3;
    c.c0 = 1.0 - s * c.c2;
  } else {
    const double theta = std::sqrt(s);
    const SinCos trig = sincos(theta);
    c.c0 = trig.cos;
    c.c1 = trig.sin / theta;
    c.c2 = (1.0 - c.c0) / s;
    c.c3 = (1.0 - c.c1) / s;
    c.c4 = (kInverseFactorial[2] - c.c2) / s;
    c.c5 = (kInverseFactorial[3] - c.c3) / s;
    c.c6 = (kInverseFactorial[4] - c.c4) / s;
    c.c7 = (kInverseFactorial[5] - c.c5) / s;
  }
  return c;
}

Eigen::Quaterniond exp_so3(const Vector3& phi) {
  const Stumpff c = stumpff(0.25 * phi.squaredNorm());  // of half the angle
  const Vector3 v = 0.5 * c.c1 * phi;
  return {c.c0, v.x(), v.y(), v.z()};
}

Vector3 log_so3(const Eigen::Quaterniond& r) {
  const double size = r.squaredNorm();
  if (!(size >= 0.25 && size <= 4.0)) return Vector3::Constant(kNaN);
  const double sign = sign_of_first(r);
  const double n = r.vec().norm(), w = sign * r.w();
  const double scale = n > 0.0 ? 2.0 * arctangent(n, w) / n : 2.0 / w;
  return sign * scale * r.vec();
}

RightJacobian::RightJacobian(const Vector3& phi) : phi_(phi), c_(stumpff(phi.squaredNorm())) {}

Matrix3 RightJacobian::matrix() const {
  Matrix3 j;
  for (int i = 0; i < 3; ++i) j.col(i) = times(Vector3::Unit(i));
  return j;
}

Vector3 RightJacobian::times(const Vector3& v) const {
  const Vector3 x = phi_.cross(v);
  return v - c_.c2 * x + c_.c3 * phi_.cross(x);
}

Vector3 RightJacobian::inverse_times(const Vector3& v) const {
  // I + [phi]x / 2 + (1 - (|phi|/2) cot(|phi|/2)) / |phi|^2 [phi]x^2, where (|phi|/2) cot(|phi|/2)
  // = c_1 / (2 c_2), 2 c_2 = 1 - 2 s c_4 and c_1 = 1 - s c_3.
  const double k = (c_.c3 - 2.0 * c_.c4) / (2.0 * c_.c2);
  const Vector3 x = phi_.cross(v);
  return v + 0.5 * x + k * phi_.cross(x);
}

Vector3 RightJacobian::rate_times(const Vector3& dphi, const Vector3& v) const {
  // dc_n/ds = (n c_(n+2) - c_(n+1)) / 2 and ds/dt = 2 phi . dphi
  const double half_ds = phi_.dot(dphi);
  const double dc2 = half_ds * (2.0 * c_.c4 - c_.c3);
  const double dc3 = half_ds * (3.0 * c_.c5 - c_.c4);
  const Vector3 x = phi_.cross(v), dx = dphi.cross(v);
  return -dc2 * x - c_.c2 * dx + dc3 * phi_.cross(x) + c_.c3 * (dphi.cross(x) + phi_.cross(dx));
}

RightJacobian::Rates RightJacobian::rates(const Vector3& dphi, const Vector3& ddphi,
                                          const Vector3& dddphi) const {
  // J_r dphi = dphi - c_2 x + c_3 m with x = phi x dphi and m = phi x x, differentiated twice
  const Vector3 x = phi_.cross(dphi), dx = phi_.cross(ddphi);
  const Vector3 ddx = dphi.cross(ddphi) + phi_.cross(dddphi);
  const Vector3 m = phi_.cross(x), dm = dphi.cross(x) + phi_.cross(dx);
  const Vector3 ddm = ddphi.cross(x) + 2.0 * dphi.cross(dx) + phi_.cross(ddx);
  // dc_n/dt = h (n c_(n+2) - c_(n+1)) with h = (ds/dt) / 2
  const double h = phi_.dot(dphi), dh = dphi.squaredNorm() + phi_.dot(ddphi);
  const double k2 = 2.0 * c_.c4 - c_.c3, k3 = 3.0 * c_.c5 - c_.c4;
  const double dc2 = h * k2, dc3 = h * k3;
  const double ddc2 = dh * k2 + h * h * (8.0 * c_.c6 - 5.0 * c_.c5 + c_.c4);
  const double ddc3 = dh * k3 + h * h * (15.0 * c_.c7 - 7.0 * c_.c6 + c_.c5);
  return {dphi - c_.c2 * x + c_.c3 * m, ddphi - (dc2 * x + c_.c2 * dx) + (dc3 * m + c_.c3 * dm),
          dddphi - (ddc2 * x + 2.0 * dc2 * dx + c_.c2 * ddx) +
              (ddc3 * m + 2.0 * dc3 * dm + c_.c3 * ddm)};
}

}  // namespace tactus
