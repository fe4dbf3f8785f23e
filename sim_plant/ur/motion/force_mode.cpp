#include "sim_plant/ur/motion/force_mode.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ur {
namespace {

constexpr double kSlow = 1e-3;  // m or m/s: a shorter vector has no usable direction

double towards_zero(double value, double most) {
  return std::abs(value) <= most ? 0.0 : value - std::copysign(most, value);
}

}  // namespace

bool ForceMode::valid() const {
  return task_frame.allFinite() && selection.allFinite() && wrench.allFinite() &&
         limits.allFinite() && type >= 1 && type <= 3;
}

/// Turns the axes of the task frame; without a usable direction they stay unchanged.
void ForceLaw::turn_axes(const ForceMode& mode, const Frame& tip, const Vector3& speed) {
  const Frame frame = Frame::of(mode.task_frame);
  if (mode.type == 2) axes_ = frame.r;
  const Vector3 to_origin = frame.p - tip.p;
  const Vector3 z = frame.r.col(2), along = speed - z.dot(speed) * z;
  if (mode.type == 1 && to_origin.norm() > kSlow) {
    const Vector3 y = to_origin.normalized();
    // x is made from a given axis that is not nearly parallel to y.
    const Vector3 given = std::abs(y.dot(frame.r.col(0))) < 0.9 ? frame.r.col(0) : frame.r.col(2);
    const Vector3 x = (given - y.dot(given) * y).normalized();
    axes_ << x, y, x.cross(y);
  }
  if (mode.type == 3 && along.norm() > kSlow) {
    const Vector3 x = along.normalized();
    axes_ << x, z.cross(x), z;
  }
}

void ForceLaw::step(const ForceMode& mode, double damping, const Frame& tip, const Vector3& speed,
                    const Vector6& force, double h_s) {
  if (mode.active) turn_axes(mode, tip, speed);
  const double d =
      settings_.damping + std::min(1.0, std::max(0.0, damping)) * settings_.full_damping;
  Vector6 v, f;
  v << axes_.transpose() * twist_.head<3>(), axes_.transpose() * twist_.tail<3>();
  f << axes_.transpose() * force.head<3>(), axes_.transpose() * force.tail<3>();
  for (int i = 0; i < 6; ++i) {
    const double arm = i < 3 ? 1.0 : settings_.arm_m;
    if (!mode.compliant(i)) {
      v[i] = towards_zero(v[i], settings_.fade / arm * h_s);
      continue;
    }
    const double m = settings_.mass_kg * arm * arm;
    v[i] = (v[i] + h_s / m * (mode.wrench[i] + f[i])) / (1.0 + h_s / m * d * arm * arm);
    const double most = std::max(0.0, mode.limits[i]);
    v[i] = std::clamp(v[i], -most, most);
  }
  twist_ << axes_ * v.head<3>(), axes_ * v.tail<3>();
  displacement_.p += twist_.head<3>() * h_s;
  displacement_.r = rotation_matrix(twist_.tail<3>() * h_s) * displacement_.r;
}

}  // namespace tactus::ur
