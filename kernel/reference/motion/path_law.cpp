#include "kernel/reference/motion/path_law.hpp"

#include <cassert>
#include <cmath>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/slope_bounds.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

constexpr int kAhead = 4;         // places whose limits are used, from the next sample on
constexpr int kRooms = 8;         // intervals between places whose room is used
constexpr int kTries = 4;         // slopes tried in a period
constexpr double kThere = 1e-10;  // distance of a rate from its target

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

/// Returns the slope with which the room falls at s. Slopes from it to zero are always allowed: if
/// |p''| r^2 <= a for every r below the room, it was found so that |p'' r^2 + p' u| <= a for them
/// all (admission_room.hpp), and the bounds are convex in u.
template <class Space>
double falling(const Path<Space>& path, double s) {
  return std::min(0.0, 0.5 * path.room(s).slope);
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

/// Returns the slopes from which jerk can reach the slopes that the path ahead allows: advice,
/// which must not break a limit at the next sample. Sets the largest bend.
template <class Space>
Interval PathLaw<Space>::advice(const Path<Space>& path, const Limits& limits, double dt_s,
                                Ahead& ahead) {
  constexpr int n = Space::kChannelSize;
  const double spacing_s = std::max(dt_s, ramp_s(limits) / (kAhead - 1));
  Interval slopes = kAnySlope;
  bend_ = kSteepestSlope * kSteepestSlope;
  for (int i = 0; i < kAhead; ++i) {
    // The slope may have to change from one period after the previous place on.
    const double time_s = dt_s + i * spacing_s, away_s = i > 0 ? (i - 1) * spacing_s + dt_s : 0.0;
    const double s = later_s(time_s);  // the next sample's segment is kept for fitted()
    const Local at =
        i == 0 ? path.local(s, ahead.far, ahead.near) : path.local(s, ahead.near, ahead.far);
    const double rate = std::clamp(rate_ + slope_ * time_s, 0.0, 1.0);
    const typename Space::Rates at_zero = at.d2 * (rate * rate);
    Interval there = kAnySlope;
    for (std::size_t c = 0; c < limits.a.size(); ++c) {
      const Eigen::Index k = static_cast<Eigen::Index>(c) * n;
      keep<n>(there, &at_zero[k], &at.d1[k], limits.a[c]);
    }
    narrow<Space>(at, rate, slope_, limits, there, bend_);
    there.include(0.0);
    slopes.cut(there.lo - bend_ * away_s, there.hi + bend_ * away_s);
  }
  return slopes;
}

/// Returns the slope at the next sample: the one from which the bend takes the rate onto the target
/// without passing it, limited first by the path ahead, then by jerk, last by acceleration.
template <class Space>
double PathLaw<Space>::choose(const Path<Space>& path, double target, const Limits& limits,
                              double dt_s) {
  const Room room = path.room(now().later(slope_, dt_s).s);
  const double highest = 2.0 * (std::sqrt(std::max(room.most, 0.0)) - rate_) / dt_s - slope_;
  // A rate that falls, and kept would have no room, does not rise again on the way.
  const double coast_s = rate_ * delay(limits, dt_s);
  const Room later = path.room(s_ + coast_s);
  const double least = std::min(later.most, lowest_between(room, later, coast_s));
  const bool rises = slope_ >= 0.0 || path.free() || rate_ * rate_ <= least;

  Ahead ahead;
  const Interval reach = advice(path, limits, dt_s, ahead);
  const double way = target - rate_ - 0.5 * slope_ * dt_s;
  const double wanted = reach.nearest(std::copysign(onto(std::abs(way), bend_, dt_s), way));
  return fitted(path, wanted, std::min(highest, rises ? kSteepestSlope : 0.0), limits, dt_s, ahead);
}

/// Returns the slope nearest to `wanted`, and not above `highest`, that keeps acceleration, and
/// jerk where acceleration leaves the choice: by Newton's method, as neither is quite linear in the
/// slope, and the places it leads to may be on other segments. If no slope tried is found to keep
/// acceleration, one that is always allowed holds.
template <class Space>
double PathLaw<Space>::fitted(const Path<Space>& path, double wanted, double highest,
                              const Limits& limits, double dt_s, Ahead& ahead) const {
  PathSample<Space> to, after;
  const PathSample<Space> from{now(), path.local(s_, ahead.far, ahead.near)};
  double slope = std::min(wanted, highest), lowest = 0.0;
  LoopBound<kTries> tries;
  for (int i = 0; i < kTries; ++i) {
    tries.tick();
    to.at = now().later(slope, dt_s);
    to.path = path.local(to.at.s, ahead.far, ahead.near);
    lowest = falling(path, to.at.s);
    const double onward = falling(path, to.at.s + to.at.rate * dt_s);
    after.at = to.at.later(std::clamp(slope, onward, 0.0), dt_s);
    after.path = path.local(after.at.s, ahead.near, ahead.far);
    const PathPeriod<Space> period(from, to, after, path.order(), dt_s);
    if (period.keeps_acceleration(limits) && (i + 1 == kTries || period.keeps_jerk(limits)))
      return slope;
    Interval slopes = kAnySlope, gentle = kAnySlope;
    period.cut_to_acceleration(slopes, limits);
    period.cut_to_jerk(gentle, limits);
    // Where rooms of two segments meet, a slope allowed on each may exceed the mean over both.
    if (path.free() || slope > 0.0 || slope < lowest) {
      slopes.include(0.0);
      slopes.include(lowest);
    }
    slopes.hi = std::max(slopes.lo, std::min(slopes.hi, highest));
    slope = slopes.nearest(gentle.nearest(wanted));
  }
  return std::clamp(std::min(wanted, highest), lowest, 0.0);
}

/// Applies the slope. Path time is summed up with compensation (Kahan 1965).
template <class Space>
void PathLaw<Space>::settle(const Path<Space>& path, double target, double slope, double dt_s) {
  PathRate next = now().later(slope, dt_s);
  const bool there = std::abs(next.rate - target) <= kThere && std::abs(slope) * dt_s <= kThere;
  if (there) next = {next.s, target, 0.0};
  if (next.rate <= 0.0) next.slope = 0.0;
  if (next.rate >= 1.0) next = {next.s, 1.0, 0.0};
  const double term = now().way_s(next.rate, next.slope, dt_s) - carry_, sum = s_ + term;
  carry_ = (sum - s_) - term;
  s_ = sum;
  rate_ = next.rate;
  slope_ = next.slope;
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
