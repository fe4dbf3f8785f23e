#include "sim_plant/ur/motion/kinematics.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSteps = 60;            // of Newton's method
constexpr double kLongestStep = 0.4;  // rad
constexpr double kPosition_m = 1e-9, kAngle_rad = 1e-9;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Frame link(int i, double theta, const DhTable& dh = kDh) {
  const auto k = static_cast<std::size_t>(i);
  const double c = std::cos(dh.theta[k] + theta), s = std::sin(dh.theta[k] + theta);
  const double ca = std::cos(dh.alpha[k]), sa = std::sin(dh.alpha[k]);
  Frame frame;
  frame.r << c, -s * ca, s * sa, s, c * ca, -c * sa, 0.0, sa, ca;
  frame.p << dh.a[k] * c, dh.a[k] * s, dh.d[k];
  return frame;
}

/// Returns the translation and the rotation vector from the tip to the target, base frame.
Vector6 error_between(const Frame& at, const Frame& target) {
  Vector6 error;
  error.head<3>() = target.p - at.p;
  error.tail<3>() = rotation_vector(target.r * at.r.transpose());
  return error;
}

/// Damped least squares: (J J' + d I) y = x, dq = J' y.
Joints damped(const Matrix6& j, const Vector6& x, double damping) {
  Matrix6 a = j * j.transpose();
  a.diagonal().array() += damping;
  return j.transpose() * a.llt().solve(x);
}

bool newton(const Frame& target, const Frame& tool, Joints& q) {
  double damping = 1e-4;
  Vector6 error = error_between(forward(q) * tool, target);
  for (int step = 0; step < kSteps; ++step) {
    if (error.head<3>().norm() < kPosition_m && error.tail<3>().norm() < kAngle_rad) return true;
    Joints dq = damped(jacobian(q, tool), error, damping);
    const double longest = dq.cwiseAbs().maxCoeff();
    if (longest > kLongestStep) dq *= kLongestStep / longest;
    const Joints tried = q + dq;
    const Vector6 left = error_between(forward(tried) * tool, target);
    if (left.norm() < error.norm()) {
      q = tried;
      error = left;
      damping = std::max(damping * 0.1, 1e-14);
    } else {
      damping = std::min(damping * 20.0, 1.0);
    }
  }
  return false;
}

/// Adds whole turns to every joint so that it is nearest to `near`.
Joints unwound(Joints q, const Joints& near) {
  for (int i = 0; i < 6; ++i) {
    q[i] -= 2.0 * kPi * std::round((q[i] - near[i]) / (2.0 * kPi));
    if (std::abs(q[i]) > 2.0 * kPi) q[i] -= std::copysign(2.0 * kPi, q[i]);
  }
  return q;
}

}  // namespace

Vector3 rotation_vector(const Matrix3& r) {
  Eigen::Quaterniond q(r);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double s = q.vec().norm();
  if (s < 1e-12) return 2.0 * q.vec();
  return q.vec() * (2.0 * std::atan2(s, q.w()) / s);
}

Matrix3 rotation_matrix(const Vector3& v) {
  const double angle = v.norm();
  if (angle < 1e-12) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

Frame Frame::of(const Vector6& pose) {
  return {pose.head<3>(), rotation_matrix(pose.tail<3>())};
}

Vector6 Frame::pose() const {
  Vector6 pose;
  pose << p, rotation_vector(r);
  return pose;
}

Frame forward(const Joints& q, const DhTable& dh) {
  Frame frame;
  for (int i = 0; i < 6; ++i) frame = frame * link(i, q[i], dh);
  return frame;
}

Vector3 elbow(const Joints& q) {
  return (link(0, q[0]) * link(1, q[1])).p;
}

Matrix6 jacobian(const Joints& q, const Frame& tool) {
  Matrix6 j;
  const Vector3 tip = (forward(q) * tool).p;
  Frame frame;
  for (int i = 0; i < 6; ++i) {
    const Vector3 axis = frame.r.col(2);
    j.col(i).head<3>() = axis.cross(tip - frame.p);
    j.col(i).tail<3>() = axis;
    frame = frame * link(i, q[i]);
  }
  return j;
}

bool inverse(const Frame& target, const Frame& tool, const Joints& near, Joints& q) {
  // First from the arm's posture, then from other postures of base, elbow and wrist.
  constexpr double kElbow[] = {0.0, 1.5, -1.5}, kWrist[] = {0.0, 1.2, -1.2}, kBase[] = {0.0, 2.0};
  bool found = false;
  double best = 0.0;
  if (!near.allFinite()) return false;
  for (const double base : kBase)
    for (const double bend : kElbow)
      for (const double wrist : kWrist) {
        Joints tried = near;
        tried[0] += base;
        if (bend != 0.0) tried[2] = bend;
        if (wrist != 0.0) tried[4] = wrist;
        if (!newton(target, tool, tried)) continue;
        tried = unwound(tried, near);
        const double far = (tried - near).cwiseAbs().maxCoeff();
        if (!found || far < best) {
          q = tried;
          best = far;
        }
        found = true;
        if (best < 0.5) return true;  // near enough to be the same posture
      }
  return found;
}

bool joint_speeds(const Joints& q, const Frame& tool, const Vector6& twist, Joints& dq) {
  const Matrix6 j = jacobian(q, tool);
  dq = damped(j, twist, 1e-6);
  return twist.norm() < 1e-9 || (j * dq - twist).norm() < 0.5 * twist.norm();
}

}  // namespace tactus::ur
