#include "kernel/reference/motion/path_law.hpp"

#include <cassert>
#include <cmath>

#include "kernel/reference/motion/slope_bounds.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

constexpr double kFastest = 100.0;  // 1/s; no need to change a rate faster than in ten milliseconds
constexpr int kAhead = 4;           // places whose limits are used, from the next sample on
constexpr int kRooms = 8;           // intervals between places whose room is used
constexpr double kUnsure = 0.005;   // uncertainty of the next sample, as a fraction of a period
constexpr int kCorrections = 4;
constexpr double kAccelerationRounding = 1e-11;  // as a fraction of a limit
constexpr double kThere = 1e-10;                 // distance of a rate from its target
constexpr Interval kAnySlope = {-kFastest, kFastest};

/// Returns the slope one period ahead from which the bend takes the rate `way` farther without
/// passing it: on the parabola that ends there, or, if that is less than a period away, the slope
/// that reaches it in the period after.
double onto(double way, double bend, double dt_s) {
  if (way <= bend * dt_s * dt_s) return way / dt_s;
  return bend * (std::sqrt(0.25 * dt_s * dt_s + 2.0 * way / bend) - 0.5 * dt_s);
}

/// Returns the time in which the slope can change at the jerk limit, s.
template <class Limits>
double delay(const Limits& limits, double dt_s) {
  return 0.5 * ramp_s(limits) + 2.0 * dt_s;
}

}  // namespace

template <class Space>
void PathLaw<Space>::start(const Path<Space>& path, double s, double rate, const Limits& limits,
                           double dt_s) {
  stop();
  s_ = s;
  rate_ = rate;
  rate_ = std::min(rate, std::sqrt(least_room(path, limits, dt_s)));
}

/// Returns the path time after `time_s` at this slope, which ends where it would turn back.
template <class Space>
double PathLaw<Space>::later_s(double time_s) const {
  const double t = slope_ < 0.0 ? std::min(time_s, -rate_ / slope_) : time_s;
  return s_ + t * (rate_ + 0.5 * slope_ * t);
}

/// Returns the least room of the places that are reached, at this slope, in the time in which the
/// slope can change at the jerk limit, so that the rate is low enough after the change. An open
/// end counts half a period earlier, for the last change of slope.
template <class Space>
double PathLaw<Space>::least_room(const Path<Space>& path, const Limits& limits,
                                  double dt_s) const {
  if (path.free()) return 1.0;
  const double delay_s = delay(limits, dt_s);
  double least = 1.0, before_s = s_;
  Room before;
  for (int i = 0; i <= kRooms; ++i) {
    const double s = later_s(delay_s * i / kRooms);
    if (path.open() && s >= path.end_s() - 0.5 * dt_s) return 0.0;
    const Room room = path.room(s);
    least = std::min({least, room.most, lowest_between(before, room, s - before_s)});
    before = room;
    before_s = s;
  }
  return std::max(least, 0.0);
}

template <class Space>
typename PathLaw<Space>::Next PathLaw<Space>::next(double slope, double dt_s) const {
  const double rate = std::max(0.0, rate_ + 0.5 * dt_s * (slope_ + slope));
  const double way = 0.5 * dt_s * (rate_ + rate) - (slope - slope_) * dt_s * dt_s / 12.0;
  return {s_ + std::max(0.0, way), rate, slope};
}

/// Returns the slopes for which limits hold at the next sample. Acceleration is taken as linear in
/// the slope about `guess`; jerk is its change from the present rate and slope, without that of p.
template <class Space>
typename PathLaw<Space>::Slopes PathLaw<Space>::about(const Local& at, const Next& guess,
                                                      const Limits& limits, double dt_s) const {
  constexpr int n = Space::kChannelSize;
  const double r = guess.rate, w = r * r, u = guess.slope;
  const typename Space::Rates gain =
      at.d1 + at.d2 * (r * dt_s) + (at.d3 * w + at.d2 * u) * (dt_s * dt_s / 6.0);
  const typename Space::Rates offset = at.d2 * w + at.d1 * u - gain * u;
  const typename Space::Rates change = offset - at.d2 * (rate_ * rate_) - at.d1 * slope_ +
                                       (at.d3 * (rate_ * rate_) + at.d2 * slope_) * (rate_ * dt_s);
  Slopes slopes = {kAnySlope, kAnySlope};
  for (std::size_t c = 0; c < limits.a.size(); ++c) {
    const Eigen::Index k = static_cast<Eigen::Index>(c) * n;
    keep<n>(slopes.hard, &offset[k], &gain[k], limits.a[c]);
    keep<n>(slopes.soft, &change[k], &gain[k], limits.j[c] * dt_s);
  }
  return slopes;
}

/// Returns the slopes allowed on both sides of the next sample, which may be a little off and on
/// another segment. The acceleration of a cubic may step before the slope can change again, so the
/// place one period later counts too.
template <class Space>
typename PathLaw<Space>::Slopes PathLaw<Space>::slopes(const Path<Space>& path,
                                                       const Limits& limits, double dt_s,
                                                       Ahead& ahead) const {
  const Next same = next(slope_, dt_s);
  Slopes both = {kAnySlope, kAnySlope};
  for (const double side : {-kUnsure * dt_s, kUnsure * dt_s}) {
    const Local at = path.local(std::max(s_, same.s + side), ahead.far, ahead.near);
    const Slopes one = about(at, same, limits, dt_s);
    both.hard.cut(one.hard.lo, one.hard.hi);
    both.soft.cut(one.soft.lo, one.soft.hi);
  }
  if (path.smooth()) return both;
  const Local at = path.local(same.s + dt_s, ahead.near, ahead.far);
  const Interval later = about(at, same, limits, dt_s).hard;
  both.hard.cut(later.lo, later.hi);
  return both;
}

/// Returns the slopes from which jerk can reach the slopes that the path ahead allows: advice,
/// which must not break a limit at the next sample. Sets the largest bend.
template <class Space>
Interval PathLaw<Space>::advice(const Path<Space>& path, const Limits& limits, double dt_s,
                                Ahead& ahead) {
  constexpr int n = Space::kChannelSize;
  const double spacing_s = std::max(dt_s, ramp_s(limits) / (kAhead - 1));
  Interval slopes = kAnySlope;
  bend_ = kFastest * kFastest;
  for (int i = 0; i < kAhead; ++i) {
    // The slope may have to change from one period after the previous place on.
    const double time_s = dt_s + i * spacing_s, away_s = i > 0 ? (i - 1) * spacing_s + dt_s : 0.0;
    const Local at = path.local(later_s(time_s), ahead.near, ahead.far);
    const double rate = std::clamp(rate_ + slope_ * time_s, 0.0, 1.0);
    const typename Space::Rates offset = at.d2 * (rate * rate);
    Interval there = kAnySlope;
    for (std::size_t c = 0; c < limits.a.size(); ++c) {
      const Eigen::Index k = static_cast<Eigen::Index>(c) * n;
      keep<n>(there, &offset[k], &at.d1[k], limits.a[c]);
    }
    narrow<Space>(at, rate, slope_, limits, there, bend_);
    there.include(0.0);
    slopes.cut(there.lo - bend_ * away_s, there.hi + bend_ * away_s);
  }
  return slopes;
}

/// Returns the slope at the next sample: the one from which the bend takes the rate onto the target
/// without passing it, limited first by the path ahead, then by jerk, last by acceleration.
///
/// u = 0 is always allowed, and where the room falls with the slope -2 D, so is u = -D and, the
/// bounds being convex in u, everything between: with |p''| r^2 <= a for every r below the room,
/// -D was found so that |p'' r^2 - p' D| <= a for them all (admission_room.hpp).
template <class Space>
double PathLaw<Space>::choose(const Path<Space>& path, double target, const Limits& limits,
                              double dt_s) {
  Ahead ahead;
  Slopes next_sample = slopes(path, limits, dt_s, ahead);
  Interval& hard = next_sample.hard;
  const Room room = path.room(next(slope_, dt_s).s);
  const double falling = std::min(0.0, 0.5 * room.slope);
  hard.include(0.0);
  hard.include(falling);
  const double highest = 2.0 * (std::sqrt(std::max(room.most, 0.0)) - rate_) / dt_s - slope_;
  // A rate that falls, and kept would have no room, does not rise again on the way.
  const double coast_s = rate_ * delay(limits, dt_s);
  const Room later = path.room(s_ + coast_s);
  const double least = std::min(later.most, lowest_between(room, later, coast_s));
  const bool rises = slope_ >= 0.0 || path.free() || rate_ * rate_ <= least;
  hard.hi = std::max(hard.lo, std::min({hard.hi, highest, rises ? kFastest : 0.0}));

  const Interval reach = advice(path, limits, dt_s, ahead);
  const double way = target - rate_ - 0.5 * slope_ * dt_s;
  const double wanted = reach.nearest(std::copysign(onto(std::abs(way), bend_, dt_s), way));
  const double slope = hard.nearest(next_sample.soft.nearest(wanted));
  return corrected(path, slope, limits, dt_s, ahead);
}

/// Corrects the slope until the acceleration is within limits at the place it leads to:
/// acceleration is not linear in the slope, and that place may be on another segment than assumed.
/// If it is on a third segment, which is too near to occur, the slope that is always allowed holds.
template <class Space>
double PathLaw<Space>::corrected(const Path<Space>& path, double slope, const Limits& limits,
                                 double dt_s, Ahead& ahead) const {
  constexpr int n = Space::kChannelSize;
  double falling = 0.0;
  bool built = false;
  for (int i = 0; i < kCorrections; ++i) {
    const Next there = next(slope, dt_s);
    const int target = path.target_at(there.s);
    falling = std::min(0.0, 0.5 * path.room(there.s, target).slope);
    if (slope <= 0.0 && slope >= falling) return slope;
    const bool builds = !path.built(target, ahead.near, ahead.far);
    if (builds && built) return falling;
    built = built || builds;
    const Local at = path.local(there.s, target, ahead.near, ahead.far);
    const typename Space::Rates own = at.d2 * (there.rate * there.rate);
    const typename Space::Rates all = own + at.d1 * slope;
    bool within = true;
    for (std::size_t c = 0; c < limits.a.size(); ++c) {
      const Eigen::Index k = static_cast<Eigen::Index>(c) * n;
      const double most = std::max(limits.a[c], length<n>(&own[k]));
      within = within && length<n>(&all[k]) <= most * (1.0 + kAccelerationRounding);
    }
    if (within) return slope;
    Interval hard = about(at, there, limits, dt_s).hard;
    hard.include(0.0);
    hard.include(falling);
    slope = hard.nearest(slope);
  }
  return falling;
}

/// Applies the slope. Path time is summed up with compensation (Kahan 1965).
template <class Space>
void PathLaw<Space>::settle(const Path<Space>& path, double target, double slope, double dt_s) {
  Next now = next(slope, dt_s);
  const bool there = std::abs(now.rate - target) <= kThere && std::abs(slope) * dt_s <= kThere;
  if (there) now = {now.s, target, 0.0};
  if (now.rate <= 0.0) now.slope = 0.0;
  if (now.rate >= 1.0) now = {now.s, 1.0, 0.0};
  const double way = 0.5 * dt_s * (rate_ + now.rate) - (now.slope - slope_) * dt_s * dt_s / 12.0;
  const double term = std::max(0.0, way) - carry_, sum = s_ + term;
  carry_ = (sum - s_) - term;
  s_ = sum;
  rate_ = now.rate;
  slope_ = now.slope;
  if (s_ < path.end_s()) return;
  s_ = path.end_s();
  carry_ = 0.0;
  if (path.open()) rate_ = slope_ = 0.0;
}

template <class Space>
void PathLaw<Space>::step(const Path<Space>& path, double target, const Limits& limits,
                          double dt_s) {
  const double reached = std::min(target, std::sqrt(least_room(path, limits, dt_s)));
  const bool steady = slope_ == 0.0 && rate_ == reached;
  settle(path, reached, steady ? 0.0 : choose(path, reached, limits, dt_s), dt_s);
  assert(rate_ >= 0.0 && rate_ <= 1.0 && s_ >= 0.0 && s_ <= path.end_s());
}

template class PathLaw<JointSpace>;
template class PathLaw<TaskSpace>;

}  // namespace tactus
