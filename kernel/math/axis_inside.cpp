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
#include "kernel/math/axis_direct.hpp"

namespace tactus {
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
