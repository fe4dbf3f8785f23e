#include "sim_plant/ur/motion/calibration.hpp"

#include <Eigen/LU>
#include <cmath>

#include "sim_plant/arm/normal_noise.hpp"

namespace tactus::ur {
namespace {

constexpr double kOffset_m = 3e-4, kTilt_rad = 6e-4, kTiltOfParallels_rad = 3e-3, kZero_rad = 5e-5;

Matrix3 turn_x(double angle) {
  return rotation_matrix({angle, 0.0, 0.0});
}
Matrix3 turn_z(double angle) {
  return rotation_matrix({0.0, 0.0, angle});
}

/// Returns the axis of joint i + 1 in the frame of joint i, with its errors.
Frame drawn_link(std::size_t i, std::mt19937_64& random) {
  const NormalPair xy = draw_normal(random), zt = draw_normal(random), tilt = draw_normal(random);
  const double size = i == 1 || i == 2 ? kTiltOfParallels_rad : kTilt_rad;
  const Vector3 lean(size * tilt.first, size * tilt.second, kZero_rad * zt.second);
  const Frame nominal{{kDh.a[i], 0.0, kDh.d[i]}, turn_x(kDh.alpha[i])};
  return nominal * Frame{kOffset_m * Vector3(xy.first, xy.second, zt.first), rotation_matrix(lean)};
}

/// Writes row i of the table: the common normal of two axes. Returns the frame of the second in the
/// one of the table, a turn about and a shift along their common z.
Frame take_row(std::size_t i, const Frame& link, DhTable& dh) {
  const Vector3 z = Vector3::UnitZ(), next = link.r.col(2);
  Vector3 normal = z.cross(next).normalized();
  if (normal.x() < 0.0) normal = -normal;
  dh.alpha[i] = std::atan2(z.cross(next).dot(normal), next.z());
  dh.theta[i] = std::atan2(normal.y(), normal.x());
  Matrix3 ways;
  ways << z, normal, next;
  const Vector3 way = ways.partialPivLu().solve(link.p);
  dh.d[i] = way[0];
  dh.a[i] = way[1];
  return {{0.0, 0.0, way[2]}, (turn_z(dh.theta[i]) * turn_x(dh.alpha[i])).transpose() * link.r};
}

}  // namespace

DhTable draw_calibration(unsigned seed) {
  std::mt19937_64 random(seed);
  DhTable dh;
  dh.calibrated = true;
  Frame left;
  for (std::size_t i = 0; i < 5; ++i) left = take_row(i, left * drawn_link(i, random), dh);
  // The flange is on the last axis.
  const NormalPair last = draw_normal(random);
  dh.theta[5] = std::atan2(left.r(1, 0), left.r(0, 0)) + kZero_rad * last.first;
  dh.d[5] += left.p.z() + kOffset_m * last.second;
  return dh;
}

}  // namespace tactus::ur
