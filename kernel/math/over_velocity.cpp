// The motion over a velocity w without acceleration. With alpha and beta the peaks of its rise and
// its fall (velocity_change.hpp),
//
//   D(w) = d_rise + d_fall,  dD/dw = (1/alpha + 1/beta) (w + alpha beta / 2j).
//
// The last factor grows with w: D first falls (if w may be negative), then grows, and as it begins
// below the target it meets it once. If D(v_hi) is still short of the target, the rest is a cruise
// at v_hi.
//
// Just above w_least, D grows like the square root of w - w_least, so the unknown is x,
//
//   w = w_least + x^2,
//
// and the radicands are j x^2 plus constants, which are not computed from differences of w.
#include "kernel/core/loop_bound.hpp"
#include "kernel/math/axis_ascent.hpp"
#include "kernel/math/sincos.hpp"  // bits_of, double_of
#include "kernel/math/velocity_change.hpp"

namespace tactus {
namespace {

constexpr int kVelocitySteps = 16;
constexpr double kDistanceRounding = 1e-15;  // of w times the duration

/// Returns the cube root within 6 percent, for a trial: a third of the exponent, the rest on a
/// line. The constant is two thirds of the bits of one, less 0.03 of a unit of the exponent, which
/// levels the error.
double about_cube_root(double x) {
  return double_of(bits_of(x) / 3 + 0x2A9F84FE36D22425u);
}

class OverVelocity {
 public:
  explicit OverVelocity(const Ascent& ascent) : ascent_(ascent), j_(ascent.limits.j) {
    const double v = ascent.v, a = ascent.a, v1 = ascent.v1, vf = ascent.vf;
    if (ascent.rises_to_end()) {
      least_ = vf;
      rise_constant_ = rise_radicand(v, a, vf, j_);
      fall_constant_ = 0.0;
    } else {
      least_ = v1;
      rise_constant_ = a > 0.0 ? a * a : 0.0;
      fall_constant_ = j_ * (v1 - vf);
    }
    x_most_ = std::sqrt(std::max(0.0, ascent.limits.v_hi - least_));
  }

  void append_to(AxisPlan& plan) {
    evaluate(x_most_);
    double cruise = 0.0;
    if (beyond_ > 0.0)
      find();
    else if (w_ > 0.0)
      cruise = -beyond_ / w_;
    append(plan, rise_, ascent_.side * j_);
    plan.append(cruise, 0.0);
    append(plan, fall_, -ascent_.side * j_);
  }

 private:
  void evaluate(double x) {
    const AxisLimits& limits = ascent_.limits;
    const double square = x * x;
    w_ = least_ + square;
    rise_ =
        rise_of_radicand(j_ * square + rise_constant_, ascent_.v, ascent_.a, w_, limits.a_up, j_);
    fall_ = change_from_rest(j_ * square + fall_constant_, w_, ascent_.vf, limits.a_dn, j_);
    beyond_ = rise_.distance + fall_.distance - ascent_.distance;
    close_ = ascent_.tolerance +
             kDistanceRounding * std::abs(w_) * (rise_.duration() + fall_.duration());
  }

  /// Finds x by Newton's method within a bracket whose upper end is beyond the target.
  void find() {
    low_ = 0.0;
    high_ = x_most_;
    double x = x_most_;
    const double trial = trial_x();
    if (trial < x_most_) evaluate(x = trial);
    LoopBound<kVelocitySteps> steps;
    for (int i = 0; i < kVelocitySteps; ++i) {
      steps.tick();
      (beyond_ > 0.0 ? high_ : low_) = x;
      if (std::abs(beyond_) <= close_) return;
      x = next(x, i);
      evaluate(x);
    }
  }

  /// Returns a trial x, exact from rest to rest. Without holds D = 2 w sqrt(w / j) there; with
  /// alpha and beta always at the limits A and B
  ///   dD/dw = (1/A + 1/B) (w + c), c = A B / 2j
  ///   (w + c)^2 = (w_least + c)^2 + 2 D A B / (A + B)
  /// The trial velocity is never negative, where D may still fall.
  double trial_x() const {
    const double a = ascent_.limits.a_up, b = ascent_.limits.a_dn, missing = ascent_.missing;
    const double to_zero = std::max(0.0, -least_);
    const double root = about_cube_root(0.5 * missing * std::sqrt(j_)), least_a = std::min(a, b);
    if (j_ * root * root <= least_a * least_a) return std::sqrt(root * root + to_zero);
    const double from = least_ + 0.5 * a * b / j_;
    const double square = 2.0 * missing * a * b / (a + b);
    const double to = std::sqrt(from * from + square);
    return std::sqrt(std::max(to_zero, from > 0.0 ? square / (to + from) : to - from));
  }

  double next(double x, int step) const {
    const double alpha = rise_.peak, beta = fall_.peak;
    const double slope =
        2.0 * x * (alpha + beta) * (w_ + 0.5 * alpha * beta / j_);  // dD/dx, times alpha beta
    const double newton = slope > 0.0 ? x - beyond_ * alpha * beta / slope : low_;
    if (newton > low_ && newton < high_) return newton;
    if (step < 2 || low_ * 16.0 > high_) return 0.5 * (low_ + high_);
    return low_ > 0.0 ? std::sqrt(low_ * high_) : high_ / 16.0;
  }

  const Ascent& ascent_;
  double j_;
  double least_, x_most_;
  double rise_constant_, fall_constant_;
  // At the x evaluated last. beyond_: distance beyond the target; close_: its tolerance.
  double w_ = 0.0, beyond_ = 0.0, close_ = 0.0;
  VelocityChange rise_{}, fall_{};
  double low_ = 0.0, high_ = 0.0;
};

}  // namespace

void append_over_velocity(AxisPlan& plan, const Ascent& ascent) {
  OverVelocity(ascent).append_to(plan);
}

}  // namespace tactus
