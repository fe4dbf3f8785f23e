// A motion to (vf, 0) at the distance D in a time T longer than the shortest: a direct change to a
// velocity w, a cruise at w that takes the rest of T, and a direct change to vf. Its distance
//
//   L(w) = d_1(w) + d_2(w) + w (T - T_1(w) - T_2(w)),  dL/dw = t_cruise + (alpha + beta) / 2j,
//
// with alpha and beta the peaks of the two changes (velocity_change.hpp: the terms w dT_i/dw
// cancel), grows with w wherever the cruise is not negative. In the frame in which D >= L(vf), w is
// between vf and v_hi; below v1, the rest velocity of the start, the first change is a fall.
//
// d2L/dw2 is -(1/alpha + 1/beta), the derivative of t_cruise, plus a quarter of its part for each
// change without a hold (x' = j / 2x); the part of a first fall has the opposite sign. With holds
// it is constant, L is a parabola, and one step solves it.
#include "kernel/core/loop_bound.hpp"
#include "kernel/math/axis_ascent.hpp"
#include "kernel/math/axis_direct.hpp"

namespace tactus {
namespace {

constexpr int kParabolaSteps = 20;
/// Relative to the distance plus a thousandth of (v_hi - v_lo) T.
constexpr double kStretchTolerance = 1e-12;

class Stretched {
 public:
  Stretched(const Ascent& ascent, double duration) : ascent_(ascent), duration_(duration) {
    const AxisLimits& limits = ascent.limits;
    tolerance_ = ascent.tolerance +
                 kStretchTolerance *
                     (std::abs(ascent.distance) + 1e-3 * (limits.v_hi - limits.v_lo) * duration);
  }

  /// Finds w; `slope` is dL/dw at vf. False if there is no such motion.
  bool find(double slope) {
    const double vf = ascent_.vf, v1 = ascent_.v1, v_hi = ascent_.limits.v_hi;
    if (vf >= v1 || ascent_.missing <= tolerance_)
      return meet(vf, v_hi, false, begin_at(vf, v_hi, -ascent_.missing, slope));
    const double top = std::min(v1, v_hi);
    evaluate(top);
    if (cruise_ >= 0.0 && beyond_ <= tolerance_)
      return meet(top, v_hi, false, begin_at(top, v_hi, beyond_, slope_));
    return find_below(vf, top);
  }

  void append_to(AxisPlan& plan) const {
    const double jerk = ascent_.side * ascent_.limits.j;
    append(plan, first_, w_ >= ascent_.v1 ? jerk : -jerk);
    plan.append(cruise_, 0.0);
    append(plan, second_, -jerk);
  }

 private:
  /// Finds w between vf and v1, where the two changes may take longer than T. They take longest
  /// around the middle of the range of a first fall without a hold, and there L grows least.
  bool find_below(double vf, double top) {
    const double reach = 0.5 * ascent_.a * ascent_.a / ascent_.limits.j;
    const double middle = std::min(top, 0.5 * (ascent_.v1 + vf + reach));
    evaluate(middle);
    if (slope_ > 0.0)  // then it is everywhere
      return beyond_ > 0.0 ? meet(vf, middle, false, middle) : meet(middle, top, true, middle);
    return meet(vf, middle, false, 0.5 * (vf + middle)) ||
           meet(middle, top, true, 0.5 * (middle + top));
  }

  void evaluate(double w) {
    const AxisLimits& limits = ascent_.limits;
    const double j = limits.j, vf = ascent_.vf;
    const bool rises = w >= ascent_.v1;
    w_ = w;
    first_ = rises ? rise(ascent_.v, ascent_.a, w, limits.a_up, j)
                   : fall(ascent_.v, ascent_.a, w, limits.a_dn, j);
    second_ = change_from_rest(std::max(0.0, j * (w - vf)), w, vf, limits.a_dn, j);
    cruise_ = duration_ - first_.duration() - second_.duration();
    beyond_ = first_.distance + second_.distance + w * cruise_ - ascent_.distance;
    slope_ = cruise_ + 0.5 * (first_.peak + second_.peak) / j;
    curvature_ = (rises ? -bend(first_) : bend(first_)) - bend(second_);
  }

  /// Returns the first w, from the lower end of the bracket on the parabola of changes with holds.
  double begin_at(double low, double high, double beyond, double slope) {
    if (beyond >= -tolerance_) return low;
    const AxisLimits& limits = ascent_.limits;
    beyond_ = beyond;
    slope_ = slope;
    curvature_ = -1.0 / limits.a_up - 1.0 / limits.a_dn;
    return next(low, low, high, false);
  }

  static double bend(const VelocityChange& change) {
    return (change.hold > 0.0 ? 1.0 : 0.75) / change.peak;
  }

  /// Finds the root within [low, high] if there is one that leaves time for a cruise. Where there
  /// is no time, the search continues above if `time_above`, else below.
  bool meet(double low, double high, bool time_above, double first) {
    double w = first;
    LoopBound<kParabolaSteps> steps;
    for (int i = 0; i < kParabolaSteps; ++i) {
      steps.tick();
      evaluate(w);
      if (cruise_ >= 0.0 && std::abs(beyond_) <= tolerance_) return true;
      const bool down = cruise_ < 0.0 ? !time_above : beyond_ > 0.0;
      (down ? high : low) = w;
      w = i % 4 == 3 ? 0.5 * (low + high) : next(w, low, high, down);
    }
    constexpr double kRounding = 1e3;  // tolerances: rounding may keep the bracket open
    return cruise_ >= 0.0 && std::abs(beyond_) <= kRounding * tolerance_;
  }

  /// Returns the root of the parabola through L on its rising branch, or of the tangent if it has
  /// none; if that is outside the bracket, a point close to the end it would pass.
  double next(double w, double low, double high, bool down) const {
    constexpr double kClose = 1.0 / 32.0;
    const double square = slope_ * slope_ - 2.0 * beyond_ * curvature_;
    const double root = std::sqrt(std::max(0.0, square));
    double to = w - beyond_ / slope_;
    if (slope_ <= 0.0)
      to = w + (root - slope_) / curvature_;
    else if (square >= 0.0)
      to = w - 2.0 * beyond_ / (slope_ + root);
    if (to > low && to < high) return to;
    return down ? low + kClose * (w - low) : high - kClose * (high - w);
  }

  Ascent ascent_;
  double duration_, tolerance_;
  // At the w evaluated last.
  double w_ = 0.0, cruise_ = 0.0, beyond_ = 0.0, slope_ = 0.0, curvature_ = 0.0;
  VelocityChange first_{}, second_{};
};

}  // namespace

bool stretch(AxisPlan& plan, const AxisState& from, double p, double v, const AxisLimits& limits,
             double duration) {
  if (duration <= plan.duration()) return true;
  const double more = duration - plan.duration();
  if (!(more - more == 0.0)) return false;  // something is not finite
  const double vf = std::clamp(v, limits.v_lo, limits.v_hi);
  const AxisState s = plan.lead() > 0 ? plan.after_lead() : from;
  const double rest = duration - plan.lead_duration();
  const DirectChange direct = direct_change(s, vf, limits);
  const double cruise = rest - direct.change.duration();
  const double missing = p - s.p - direct.change.distance - vf * cruise;
  Stretched longer(ascent_of(s, p, vf, limits, missing), rest);
  if (!longer.find(cruise + 0.5 * direct.change.peak / limits.j)) return false;
  plan.cut_to_lead();
  longer.append_to(plan);
  return true;
}

}  // namespace tactus
