#include "sim_plant/ur/motion/blend.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

/// Below the first angle there is no circle; above the second it shrinks to a point.
constexpr double kStraight = 1e-4, kSharp = 2.6;  // rad

}  // namespace

void Blend::start(const Segment& a, double left, const Segment& b, double gone) {
  a_ = &a;
  b_ = &b;
  left_ = left;
  gone_ = gone;
  k_ = 0.0;
  circle_ = false;
  if (a.move().kind == Move::Kind::kP && b.move().kind == Move::Kind::kP) fit_circle();
}

void Blend::fit_circle() {
  const Vector3 corner = b_->tip(0.0).p;
  touch_ = a_->tip(a_->length() - left_).p;
  const double e = (corner - touch_).norm();
  along_ = (corner - touch_) / e;
  const Vector3 out = (b_->tip(gone_).p - corner).normalized();
  theta_ = std::atan2(along_.cross(out).norm(), along_.dot(out));
  if (!(theta_ > kStraight && theta_ < kSharp)) return;
  across_ = (out - along_.dot(out) * along_).normalized();
  rho_ = e / std::tan(0.5 * theta_);
  k_ = 2.0 - rho_ * theta_ / e;
  circle_ = true;
}

Blend::Share Blend::share(double u) const {
  const double w = 1.0 - u;
  return {a_->length() - left_ * w * w * (1.0 + k_ * u),
          left_ * w * (2.0 * (1.0 + k_ * u) - k_ * w), gone_ * u * u * (1.0 + k_ * w),
          gone_ * u * (2.0 * (1.0 + k_ * w) - k_ * u)};
}

bool Blend::at(double u, const Joints& near, Joints& q, Joints& slope) const {
  if (a_->in_joints() || b_->in_joints()) return at_joints(u, q, slope);
  Vector6 twist;
  const Frame frame = tip(u, twist);
  Joints found;
  if (!inverse(frame, a_->tool(), near, found)) return false;
  q = found;
  return joint_speeds(q, a_->tool(), twist, slope);
}

bool Blend::at_joints(double u, Joints& q, Joints& slope) const {
  const Share s = share(u);
  const Joints& corner = b_->begin();
  Joints q_a, q_b, slope_a, slope_b;
  if (!a_->at(s.x_a, corner, q_a, slope_a) || !b_->at(s.x_b, corner, q_b, slope_b)) return false;
  q = q_a + q_b - corner;
  slope = slope_a * s.dx_a + slope_b * s.dx_b;
  return true;
}

Frame Blend::tip(double u, Vector6& twist) const {
  const Share s = share(u);
  const Frame a = a_->tip(s.x_a), b = b_->tip(s.x_b), corner = b_->tip(0.0);
  const Vector6 twist_a = a_->twist(s.x_a) * s.dx_a, twist_b = b_->twist(s.x_b) * s.dx_b;
  const Matrix3 to_b = a.r * corner.r.transpose();
  Frame frame{a.p + b.p - corner.p, to_b * b.r};
  twist << twist_a.head<3>() + twist_b.head<3>(), twist_a.tail<3>() + to_b * twist_b.tail<3>();
  if (!circle_) return frame;
  const double c = std::cos(theta_ * u), sine = std::sin(theta_ * u);
  frame.p = touch_ + rho_ * (sine * along_ + (1.0 - c) * across_);
  twist.head<3>() = rho_ * theta_ * (c * along_ + sine * across_);
  return frame;
}

double Blend::rate(double a_first, double a_next) const {
  const double a = 2.0 * left_, b = 2.0 * gone_;
  if (a_->in_joints() != b_->in_joints()) return std::sqrt(std::min(a_first / a, a_next / b));
  Joints q = b_->begin(), slope_a, slope_b;
  if (a_->in_joints() && a_->at(a_->length(), q, q, slope_a) && b_->at(0.0, q, q, slope_b))
    return std::sqrt(a_first / (b * slope_b - a * slope_a).cwiseAbs().maxCoeff());
  const Vector6 change = b * b_->twist(0.0) - a * a_->twist(a_->length());
  return std::sqrt(a_first / std::max(change.head<3>().norm(), change.tail<3>().norm()));
}

}  // namespace tactus::ur
