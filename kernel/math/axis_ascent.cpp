// The motions to a target beyond the direct change: over a velocity, while braking, and stretched
// to a longer time.
#include "kernel/core/loop_bound.hpp"
#include "kernel/math/axis_law.hpp"
#include "kernel/math/sincos.hpp"  // bits_of, double_of

namespace tactus {

// The motion over a velocity w without acceleration. With alpha and beta the peaks of its rise and
// its fall (axis_law.hpp),
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

// The motion whose jerk changes sign before the acceleration is zero: jerk +j for t in [0, -a/j],
// then the fall to vf. With (v', a') the state at the turn, b the peak of the fall, t_on and t_hold
// its times,
//
//   D(t) = d_turn + d_fall,  dD/dt = 2 (v' + a' (t_on + t_hold) + (a'/b) (vf + b^2 / 2j))
//
// because the fall's distance F(v', a') decreases by v' per time on its first ramp, F_v a' - F_a j
// = -v', which gives dD/dt = v' + F_v a' + F_a j = 2 (v' + F_v a'); and because raising both its
// velocities by one adds its duration, F_v = T - dF/dw = T + vf/b - b/2j.
//
// D only grows or only shrinks, except for v > 0 > vf: there it may have a hump, grow beyond the
// target and shrink below it again, and, if v1 > 0, grow a second time towards the end. The target
// is met on the first rise.

namespace {

constexpr int kNewtonSteps = 20, kScanned = 8, kHumpSteps = 10;

struct Turn {
  AxisState state;
  VelocityChange fall;
  double beyond;  // distance beyond the target
  double slope;
};

Turn turn_at(double t, const Ascent& ascent) {
  const double j = ascent.limits.j, vf = ascent.vf;
  const AxisState s = moved({0.0, ascent.v, ascent.a}, t, j);
  const VelocityChange f = fall(s.v, s.a, vf, ascent.limits.a_dn, j);
  const double share = f.peak > 0.0 ? s.a / f.peak : 0.0;
  return {s, f, s.p + f.distance - ascent.distance,
          2.0 * (s.v + s.a * (f.on + f.hold) + share * (vf + 0.5 * f.peak * f.peak / j))};
}

/// Searches between two times for the maximum of D. Returns a time at which D is beyond the target;
/// negative if the maximum is short of it.
double on_top(double low, double high, const Ascent& ascent) {
  for (int i = 0; i < kHumpSteps; ++i) {
    const double t = 0.5 * (low + high);
    const Turn turn = turn_at(t, ascent);
    if (turn.beyond >= 0.0) return t;
    (turn.slope > 0.0 ? low : high) = t;
  }
  return -1.0;
}

/// Returns a time on the first rise at which D is beyond the target; negative if there is none.
double on_hump(double last, const Ascent& ascent) {
  double before = 0.0;
  for (int i = 1; i <= kScanned; ++i) {
    const double t = last * i / kScanned;
    const Turn turn = turn_at(t, ascent);
    if (turn.beyond >= 0.0) return t;
    if (turn.slope < 0.0) {
      const double top = on_top(before, t, ascent);
      if (top >= 0.0) return top;
    }
    before = t;
  }
  return -1.0;
}

/// Returns the time at which D meets the target, by Newton's method between 0, where D is short of
/// it, and `high`, where D is not.
double meeting_turn(double high, const Ascent& ascent) {
  double low = 0.0;
  double t = high * ascent.missing / (ascent.missing + turn_at(high, ascent).beyond);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Turn turn = turn_at(t, ascent);
    if (std::abs(turn.beyond) <= ascent.tolerance) break;
    (turn.beyond > 0.0 ? high : low) = t;
    const double next = turn.slope > 0.0 ? t - turn.beyond / turn.slope : low;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
}

}  // namespace

double late_turn(Ascent& ascent) {
  const double end = -ascent.a / ascent.limits.j;
  const double beyond_end = turn_at(end, ascent).beyond;
  double last = beyond_end >= 0.0 ? end : -1.0;
  if (ascent.v > 0.0 && ascent.vf < 0.0) last = on_hump(end, ascent);
  if (last < 0.0) ascent.missing = -beyond_end;
  return last;
}

void append_while_braking(AxisPlan& plan, const Ascent& ascent, double late) {
  const double j = ascent.limits.j, t = meeting_turn(late, ascent);
  plan.append(t, ascent.side * j);
  append(plan, turn_at(t, ascent).fall, -ascent.side * j);
}

// A motion to (vf, 0) at the distance D in a time T longer than the shortest: a direct change to a
// velocity w, a cruise at w that takes the rest of T, and a direct change to vf. Its distance
//
//   L(w) = d_1(w) + d_2(w) + w (T - T_1(w) - T_2(w)),  dL/dw = t_cruise + (alpha + beta) / 2j,
//
// with alpha and beta the peaks of the two changes (axis_law.hpp: the terms w dT_i/dw
// cancel), grows with w wherever the cruise is not negative. In the frame in which D >= L(vf), w is
// between vf and v_hi; below v1, the rest velocity of the start, the first change is a fall.
//
// d2L/dw2 is -(1/alpha + 1/beta), the derivative of t_cruise, plus a quarter of its part for each
// change without a hold (x' = j / 2x); the part of a first fall has the opposite sign. With holds
// it is constant, L is a parabola, and one step solves it.

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
  const AxisState s = plan.return_phases() > 0 ? plan.after_return() : from;
  const double rest = duration - plan.return_duration();
  const DirectChange direct = direct_change(s, vf, limits);
  const double cruise = rest - direct.change.duration();
  const double missing = p - s.p - direct.change.distance - vf * cruise;
  Stretched longer(ascent_of(s, p, vf, limits, missing), rest);
  if (!longer.find(cruise + 0.5 * direct.change.peak / limits.j)) return false;
  plan.cut_to_return();
  longer.append_to(plan);
  return true;
}

}  // namespace tactus
