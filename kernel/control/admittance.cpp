#include "kernel/control/admittance.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"
#include "kernel/math/so3.hpp"

namespace tactus {
namespace {

/// Share of the robot's limits of the tip, so that three axes together stay within them.
constexpr double kAxisShare = 0.5;

}  // namespace

Admittance::Axis Admittance::axis_of(int i) const {
  const bool linear = i < 3;
  const int k = i % 3;
  const int set = static_cast<int>(linear ? params.translation : params.rotation);
  Axis axis;
  axis.compliant = ((set >> k) & 1) != 0;
  axis.mass = linear ? params.mass[k] : params.inertia[k];
  axis.damping = linear ? params.damping[k] : params.rotational_damping[k];
  axis.stiffness = linear ? params.stiffness[k] : params.rotational_stiffness[k];
  axis.max_displacement = linear ? params.max_displacement : params.max_rotation;
  axis.max_velocity = linear ? params.max_velocity : params.max_angular_velocity;
  axis.deceleration = kAxisShare * (linear ? Robot::kTaskLimit.a_max : Robot::kTaskLimit.alpha_max);
  axis.max_force = linear ? params.max_force : params.max_moment;
  if (params.damping_given == DampingGiven::kAsRatio)
    axis.damping *= 2.0 * std::sqrt(axis.mass * axis.stiffness);
  return axis;
}

Status Admittance::judge() const {
  for (int i = 0; i < 6; ++i) {
    const Axis axis = axis_of(i);
    if (axis.compliant && axis.stiffness == 0.0 && params.damping_given == DampingGiven::kAsRatio)
      return Status::kBadValue;
  }
  return Status::kOk;
}

Status Admittance::start() {
  TRY(judge());
  for (int i = 0; i < 6; ++i) axes_[static_cast<std::size_t>(i)] = axis_of(i);
  transfer_.clear();
  period_s_ = 0.0;
  braked_ = false;
  limited.value = false;
  return inputs_finite() ? command() : Status::kCommandNotFinite;
}

Status Admittance::step(double dt_s) {
  if (!inputs_finite()) return Status::kCommandNotFinite;
  if (dt_s != period_s_) {
    for (Axis& axis : axes_) axis.law = {axis.mass, axis.damping, axis.stiffness, dt_s};
    period_s_ = dt_s;
  }
  const Matrix3 to_axes = frame().transpose();
  const Vector6 wrench = *h - *h_d;
  const Vector6 force = stacked(to_axes * wrench.head<3>(), to_axes * wrench.tail<3>());
  transfer_.step(dt_s);
  const Vector6 fading = transfer_.value();
  limited.value = false;
  LoopBound<6> axes;
  for (int i = 0; i < 6; ++i) {
    axes.tick();
    Axis& axis = axes_[static_cast<std::size_t>(i)];
    if (braked_)
      axis.brake(dt_s);
    else if (axis.move(force[i], fading[i], dt_s))
      limited.value = true;
  }
  return command();
}

bool Admittance::at_rest() const {
  bool rests = true;
  for (const Axis& axis : axes_) rests = rests && axis.state.v == 0.0;
  return rests;
}

bool Admittance::Axis::move(double force, double fading, double dt_s) {
  if (!compliant) return false;
  const double f = std::clamp(force, -max_force, max_force);
  const MassSpringDamper::State free = law.step(state, f + fading), next = bounded(free, dt_s);
  state = next;
  return f != force || next.x != free.x || next.v != free.v;
}

void Admittance::Axis::brake(double dt_s) {
  const double change = std::clamp(state.v, -deceleration * dt_s, deceleration * dt_s);
  const double v = state.v - change;
  state = bounded({state.x + 0.5 * dt_s * (state.v + v), v}, dt_s);
}

MassSpringDamper::State Admittance::Axis::bounded(const MassSpringDamper::State& wanted,
                                                  double dt_s) const {
  const double reach = max_velocity * dt_s;
  MassSpringDamper::State next;
  next.x = std::clamp(wanted.x, state.x - reach, state.x + reach);
  next.v = std::clamp(wanted.v, -max_velocity, max_velocity);
  if (std::abs(next.x) >= max_displacement) {
    next.x = std::clamp(next.x, -max_displacement, max_displacement);
    if (next.v * next.x > 0.0) next.v = 0.0;
  }
  return next;
}

void Admittance::retune(const Params& next, const JointLimits& /*limits*/) {
  params = next;
  Vector6 difference = transfer_.value();
  for (int i = 0; i < 6; ++i) {
    Axis& axis = axes_[static_cast<std::size_t>(i)];
    const Axis before = axis;
    axis = axis_of(i);
    axis.state = before.state;
    difference[i] += (axis.stiffness - before.stiffness) * axis.state.x +
                     (axis.damping - before.damping) * axis.state.v;
  }
  transfer_.start(difference, kTransfer_s);
  period_s_ = 0.0;  // the next step computes the coefficients
}

Matrix3 Admittance::frame() const {
  return params.frame == CompliantFrame::kDesired ? x_d->r.toRotationMatrix()
                                                  : Matrix3(Matrix3::Identity());
}

bool Admittance::inputs_finite() const {
  return x_d->p.allFinite() && x_d->r.coeffs().allFinite() && v_d->allFinite() && h->allFinite() &&
         h_d->allFinite();
}

Status Admittance::command() {
  Vector6 e, de;
  for (int i = 0; i < 6; ++i) {
    const MassSpringDamper::State& state = axes_[static_cast<std::size_t>(i)].state;
    e[i] = state.x;
    de[i] = state.v;
  }
  const Vector3 w_d = v_d->tail<3>();
  const Matrix3 axes = frame();
  const Vector3 omega =
      params.frame == CompliantFrame::kDesired ? w_d : Vector3(Vector3::Zero());  // of the axes
  const Vector3 d = axes * e.head<3>(), phi = axes * e.tail<3>();
  const Vector3 dphi = axes * de.tail<3>() + omega.cross(phi);
  const Eigen::Quaterniond turn = exp_so3(phi);

  x_c.value.p = x_d->p + d;
  x_c.value.r = turn * x_d->r;
  v_c.value.head<3>() = v_d->head<3>() + axes * de.head<3>() + omega.cross(d);
  v_c.value.tail<3>() = RightJacobian(-phi).times(dphi) + turn * w_d;  // J_l(phi) = J_r(-phi)
  const bool finite =
      x_c.value.p.allFinite() && x_c.value.r.coeffs().allFinite() && v_c.value.allFinite();
  return finite ? Status::kOk : Status::kCommandNotFinite;
}

}  // namespace tactus
