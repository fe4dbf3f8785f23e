#include "kernel/math/axis_return.hpp"

namespace tactus {
namespace {

/// Share of the span of velocities that rounding may leave outside.
constexpr double kSpanRounding = 1e-14;

/// In the frame in which the velocity is above v_hi; `side` is -1 if that frame is mirrored.
class Return {
 public:
  Return(AxisPlan& plan, const AxisState& state, double side) : plan_(plan), side_(side) {
    state_ = side > 0.0 ? state : mirrored(state);
  }
  AxisState state() const { return side_ > 0.0 ? state_ : mirrored(state_); }

  void acceleration(double a_up, double j) {
    go((state_.a - a_up) / j, -j);
    state_.a = a_up;
  }

  void velocity(const AxisLimits& limits) {
    const double j = limits.j, hi = limits.v_hi, span = hi - limits.v_lo;
    const double highest = state_.a > 0.0 ? rest_velocity(state_.v, state_.a, j) : state_.v;
    if (!(highest - hi > kSpanRounding * span)) return;
    const double b = std::min(limits.a_dn, std::sqrt(kAlmostTwo * j * span));
    if (state_.a >= -b)
      brake(b, hi, j);
    else
      ease_off(b, hi, j);
  }

 private:
  void brake(double b, double hi, double j) {
    const double x = std::sqrt(std::max(0.0, 2.0 * j * (state_.v - hi) + state_.a * state_.a));
    const double y = std::min(x, b);
    go((state_.a + y) / j, -j);
    if (x > b) go((state_.v - hi) / b, 0.0);
    state_.v = hi;
    state_.a = -y;
  }

  void ease_off(double b, double hi, double j) {
    const double spare = state_.v - hi - 0.5 * (state_.a * state_.a - b * b) / j;
    if (!(spare >= 0.0)) return;  // it passes to the other side in any case
    go(spare / -state_.a, 0.0);
    go((-state_.a - b) / j, j);
    state_.v = hi;
    state_.a = -b;
  }

  void go(double t, double jerk) {
    if (!(t > 0.0)) return;
    plan_.append(t, side_ * jerk);
    state_ = moved(state_, t, jerk);
  }

  AxisPlan& plan_;
  AxisState state_;
  double side_;
};

/// Appends the return inside v_hi or, mirrored, inside v_lo.
AxisState append_velocity_return(AxisPlan& plan, const AxisState& state, double side,
                                 const AxisLimits& limits) {
  Return back(plan, state, side);
  back.velocity(limits);
  return back.state();
}

}  // namespace

AxisState append_acceleration_return(AxisPlan& plan, AxisState state, const AxisLimits& limits) {
  if (state.a <= limits.a_up && state.a >= -limits.a_dn) return state;
  const bool up = state.a > 0.0;
  Return back(plan, state, up ? 1.0 : -1.0);
  back.acceleration(up ? limits.a_up : limits.a_dn, limits.j);
  return back.state();
}

AxisState append_return(AxisPlan& plan, AxisState state, const AxisLimits& limits) {
  state = append_acceleration_return(plan, state, limits);
  state = append_velocity_return(plan, state, 1.0, limits);
  return append_velocity_return(plan, state, -1.0, mirrored(limits));
}

}  // namespace tactus
