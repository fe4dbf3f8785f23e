#include "kernel/math/axis_motion.hpp"

#include "kernel/math/axis_law.hpp"

namespace tactus {

AxisState moved(const AxisState& from, double t, double jerk) {
  return {from.p + t * (from.v + t * (0.5 * from.a + t * jerk / 6.0)),
          from.v + t * (from.a + 0.5 * t * jerk), from.a + t * jerk};
}

AxisState AxisPlan::at(double t) const {
  if (t >= duration_) return {p_ + v_ * (t - duration_), v_, 0.0};
  AxisState state = from_;
  for (int i = 0; i < kMostPhases; ++i) {
    if (i >= phases_) break;
    const JerkPhase& now = phase(i);
    if (t <= now.duration) return moved(state, t, now.jerk);
    state = moved(state, now.duration, now.jerk);
    t -= now.duration;
  }
  return {p_, v_, 0.0};  // t is within the rounding of duration_
}

AxisState AxisPlan::after_return() const {
  AxisState state = from_;
  for (int i = 0; i < kMostPhases; ++i) {
    if (i >= return_phases_) break;
    state = moved(state, phase(i).duration, phase(i).jerk);
  }
  return state;
}

double AxisPlan::return_duration() const {
  double sum = 0.0;
  for (int i = 0; i < kMostPhases; ++i) {
    if (i >= return_phases_) break;
    sum += phase(i).duration;
  }
  return sum;
}

void AxisPlan::cut_to_return() {
  duration_ = return_duration();
  phases_ = return_phases_;
}

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

namespace {

void include(AxisRange& range, double p) {
  range.lowest = std::min(range.lowest, p);
  range.highest = std::max(range.highest, p);
}

/// Includes the turning point, v + a t + jerk t^2 / 2 = 0, if it is within `duration`. Only a phase
/// whose jerk opposes its acceleration has one; otherwise the velocity keeps its sign.
void include_turn(AxisRange& range, const AxisState& s, double jerk, double duration) {
  const double square = s.a * s.a - 2.0 * jerk * s.v;
  if (!(s.v * s.a < 0.0 && jerk * s.a < 0.0 && square >= 0.0)) return;
  const double t = 2.0 * std::abs(s.v) / (std::abs(s.a) + std::sqrt(square));
  if (t <= duration) include(range, moved(s, t, jerk).p);
}

}  // namespace

AxisPlan plan_stop(const AxisState& from, const AxisLimits& limits) {
  AxisPlan plan;
  if (!usable(from, 0.0, 0.0, limits)) return plan;
  plan.start(from, from.p, 0.0);
  const AxisState s = append_acceleration_return(plan, from, limits);
  plan.end_return();
  const DirectChange direct = direct_change(s, 0.0, limits);
  append(plan, direct.change, direct.jerk);
  plan.end_at(s.p + direct.change.distance, 0.0);
  make_finite(plan);
  return plan;
}

AxisRange stop_range(const AxisState& from, const AxisLimits& limits) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (!usable(from, 0.0, 0.0, limits)) return {kNaN, kNaN};
  const double j = limits.j;
  AxisRange range{from.p, from.p};
  AxisState s = from;
  const double excess = s.a > limits.a_up    ? s.a - limits.a_up
                        : s.a < -limits.a_dn ? s.a + limits.a_dn
                                             : 0.0;
  if (excess != 0.0) {
    const double t = std::abs(excess) / j, jerk = excess > 0.0 ? -j : j;
    include_turn(range, s, jerk, t);
    s = moved(s, t, jerk);
    s.a = from.a - excess;
    include(range, s.p);
  }
  const DirectChange direct = direct_change(s, 0.0, limits);
  include_turn(range, s, direct.jerk, direct.change.on);
  include(range, s.p + direct.change.distance);
  return range;
}

namespace {

/// Relative to the distances added: two units of rounding for each of about fifty operations.
constexpr double kMotionTolerance = 2e-14;

}  // namespace

Ascent ascent_of(const AxisState& s, double p, double v, const AxisLimits& limits, double missing) {
  const bool up = !(missing < 0.0);
  const double side = up ? 1.0 : -1.0;
  Ascent ascent;
  ascent.limits = up ? limits : mirrored(limits);
  ascent.side = side;
  ascent.v = side * s.v;
  ascent.a = side * s.a;
  ascent.v1 = rest_velocity(ascent.v, ascent.a, limits.j);
  ascent.vf = side * v;
  ascent.distance = side * (p - s.p);
  ascent.missing = side * missing;
  ascent.tolerance = rounding_of_way(s.p, p);
  return ascent;
}

void append_motion(AxisPlan& plan, const AxisState& from, double p, double v,
                   const AxisLimits& limits) {
  const AxisState inside = is_inside(from, limits) ? from : append_return(plan, from, limits);
  plan.end_return();
  const double distance = p - inside.p;
  const DirectChange direct = direct_change(inside, v, limits);
  const double tolerance =
      kMotionTolerance * (std::abs(distance) + std::abs(direct.change.distance)) +
      rounding_of_way(inside.p, p);
  const double missing = distance - direct.change.distance;
  if (std::abs(missing) <= tolerance) {
    append(plan, direct.change, direct.jerk);
    return;
  }
  Ascent ascent = ascent_of(inside, p, v, limits, missing);
  ascent.tolerance = tolerance;
  const bool brakes = ascent.a < 0.0 && !ascent.rises_to_end();
  const double late = brakes ? late_turn(ascent) : -1.0;
  if (late >= 0.0)
    append_while_braking(plan, ascent, late);
  else
    append_over_velocity(plan, ascent);
}

AxisPlan plan_to(const AxisState& from, double p, double v, const AxisLimits& limits) {
  AxisPlan plan;
  if (!usable(from, p, v, limits)) return plan;
  const double vf = std::clamp(v, limits.v_lo, limits.v_hi);
  plan.start(from, p, vf);
  append_motion(plan, from, p, vf, limits);
  make_finite(plan);
  return plan;
}

// Motion to rest within position limits. If the direct stop from the state stays inside, so does
// the shortest motion to a target inside, at every instant: on the way up it first brakes at least
// as hard as the stop, and from then on the velocity is not negative until the target. So only a
// state whose direct stop leaves the range needs more: it brakes as hard as it can,
//
//   jerk -j to the deceleration b, held until v = 0,
//
// just long enough that the direct stop fits, but not so long that the stop passes the other limit,
// in a short range. b is the acceleration limit, or less where that could not be run out above
// v_lo.

namespace {

constexpr int kHalvings = 24;             // of the braking time
constexpr double kRangeRounding = 1e-14;  // of the range

/// The hardest braking of an ascent.
class Brake {
 public:
  Brake(const AxisState& from, const AxisLimits& limits) : from_(from), j_(limits.j) {
    const double v = from.v, a = from.a;
    const double hardest = std::min(limits.a_dn, std::sqrt(-kAlmostTwo * j_ * limits.v_lo));
    const double b = std::max(-a, hardest);
    ramp_ = (a + b) / j_;
    const double left = moved(from, ramp_, -j_).v;  // after the ramp
    if (left <= 0.0) {
      ramp_ = std::max(0.0, (a + std::sqrt(std::max(0.0, a * a + 2.0 * j_ * v))) / j_);
      longest_ = ramp_;
      return;
    }
    const double still_to_lose = left - std::max(0.0, limits.v_lo + 0.5 * b * b / j_);
    longest_ = ramp_ + (b > 0.0 ? std::max(0.0, still_to_lose / b) : 0.0);
  }

  double longest() const { return longest_; }
  AxisState after(double t) const {
    if (t <= ramp_) return moved(from_, t, -j_);
    return moved(moved(from_, ramp_, -j_), t - ramp_, 0.0);
  }
  void append_to(AxisPlan& plan, double t, double side) const {
    plan.append(std::min(t, ramp_), -side * j_);
    plan.append(t - ramp_, 0.0);
  }

 private:
  AxisState from_;
  double j_, ramp_, longest_;
};

/// Returns the shortest time of braking after which the direct stop stays below `hi`, or the
/// longest time if there is none; less if the stop would pass `lo`.
double braking_time(const Brake& brake, const AxisLimits& limits, double lo, double hi) {
  double enough = brake.longest();
  if (brake.after(enough).p < hi) {
    double too_short = 0.0;
    for (int i = 0; i < kHalvings; ++i) {
      const double t = 0.5 * (too_short + enough);
      (stop_range(brake.after(t), limits).highest > hi ? too_short : enough) = t;
    }
  }
  if (!(stop_range(brake.after(enough), limits).lowest < lo)) return enough;
  double safe = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double t = 0.5 * (safe + enough);
    (stop_range(brake.after(t), limits).lowest < lo ? enough : safe) = t;
  }
  return safe;
}

}  // namespace

AxisPlan plan_inside(const AxisState& from, double p, const AxisLimits& limits, double p_lo,
                     double p_hi) {
  AxisPlan plan;
  if (!usable(from, p + p_lo + p_hi, 0.0, limits)) return plan;
  const double end = std::max(p_lo, std::min(p_hi, p));
  plan.start(from, end, 0.0);
  const AxisRange stop = stop_range(from, limits);
  // A stop that was planned to end on a limit misses it by rounding.
  const double rounding = kRangeRounding * (p_hi - p_lo) + rounding_of_way(p_lo, p_hi);
  const bool over = stop.highest > p_hi + rounding, under = stop.lowest < p_lo - rounding;
  AxisState state = from;
  if (over || under) {
    const bool up = over && (!under || from.v >= 0.0);
    const double side = up ? 1.0 : -1.0;
    const AxisLimits seen = up ? limits : mirrored(limits);
    const Brake brake(up ? from : mirrored(from), seen);
    const double t = braking_time(brake, seen, up ? p_lo : -p_hi, up ? p_hi : -p_lo);
    brake.append_to(plan, t, side);
    state = up ? brake.after(t) : mirrored(brake.after(t));
  }
  append_motion(plan, state, end, 0.0, limits);
  make_finite(plan);
  return plan;
}

}  // namespace tactus
