#include "kernel/reference/path_law.hpp"

#include <cassert>
#include <cmath>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/slope_bounds.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

constexpr double kFastest = 100.0;  // 1/s; a rate need not change faster than in ten milliseconds
constexpr int kAhead = 8;           // places looked at; the first is the next sample
constexpr double kUnsure = 0.005;   // of a period: how far off the next sample may turn out to be
constexpr int kCorrections = 4;
constexpr double kRounding = 1e-11;  // of a limit
constexpr double kThere = 1e-10;     // of a rate, from the target

constexpr Interval kAnySlope = {-kFastest, kFastest};

/// The slope one period on from which a bend takes the rate `way` farther without passing: on the
/// parabola that ends there, or, nearer than that can be told in whole periods, so that it is there
/// in the one after, with none left.
double onto(double way, double bend, double dt_s) {
  if (way <= bend * dt_s * dt_s) return way / dt_s;
  return bend * (std::sqrt(0.25 * dt_s * dt_s + 2.0 * way / bend) - 0.5 * dt_s);
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

/// Path time in so long, if the slope stays; it stands where that would turn it back.
template <class Space>
double PathLaw<Space>::later_s(double time_s) const {
  const double t = slope_ < 0.0 ? std::min(time_s, -rate_ / slope_) : time_s;
  return s_ + t * (rate_ + 0.5 * slope_ * t);
}

/// Of the places that are reached while the slope changes as jerk lets it, so that the rate is
/// where it must be when it has. An open end counts as half a period earlier: the last change of
/// slope.
template <class Space>
double PathLaw<Space>::least_room(const Path<Space>& path, const Limits& limits,
                                  double dt_s) const {
  if (path.free()) return 1.0;
  const double delay_s = 0.5 * ramp_s(limits) + 2.0 * dt_s;
  double least = 1.0;
  for (int i = 0; i <= kAhead; ++i) {
    const double s = later_s(delay_s * i / kAhead);
    if (path.open() && s >= path.end_s() - 0.5 * dt_s) return 0.0;
    least = std::min(least, path.room(s).most);
  }
  return std::max(least, 0.0);
}

template <class Space>
typename PathLaw<Space>::Next PathLaw<Space>::next(double slope, double dt_s) const {
  const double rate = std::max(0.0, rate_ + 0.5 * dt_s * (slope_ + slope));
  const double way = 0.5 * dt_s * (rate_ + rate) - (slope - slope_) * dt_s * dt_s / 12.0;
  return {s_ + std::max(0.0, way), rate, slope};
}

/// The acceleration at the next sample, linear in its slope about `guess`, and how far it is from
/// that at the same rate and slope as now: what steps there by nature of the path is not counted.
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

/// On both sides of the next sample, which may turn out to lie a little off and on another segment.
template <class Space>
typename PathLaw<Space>::Slopes PathLaw<Space>::slopes(const Path<Space>& path,
                                                       const Limits& limits, double dt_s,
                                                       Piece& ahead) const {
  const Next same = next(slope_, dt_s);
  Slopes both = {kAnySlope, kAnySlope};
  for (const double side : {-kUnsure * dt_s, kUnsure * dt_s}) {
    const Slopes one = about(path.local(std::max(s_, same.s + side), ahead), same, limits, dt_s);
    both.hard.cut(one.hard.lo, one.hard.hi);
    both.soft.cut(one.soft.lo, one.soft.hi);
  }
  return both;
}

/// What lies ahead must be within reach of what jerk allows until then. A bound, not a demand: it
/// may break no limit at the next sample. Notes the largest bend.
template <class Space>
Interval PathLaw<Space>::advice(const Path<Space>& path, const Limits& limits, double dt_s,
                                Piece& ahead) {
  constexpr int n = Space::kChannelSize;
  const double spacing_s = std::max(dt_s, ramp_s(limits) / (kAhead - 1));
  Interval slopes = kAnySlope;
  bend_ = kFastest * kFastest;
  for (int i = 0; i < kAhead; ++i) {
    // Something may have changed since one period behind the place before.
    const double time_s = dt_s + i * spacing_s, away_s = i > 0 ? (i - 1) * spacing_s + dt_s : 0.0;
    const Local at = path.local(later_s(time_s), ahead);
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

/// The slope at the next sample: from which the bend takes the rate onto the target without passing
/// it, as far as first what lies ahead, then jerk and last acceleration allow.
///
/// u = 0 is always allowed, and where the room falls with the slope -2 D, so is u = -D and, the
/// bounds being convex in u, everything between: with |p''| r^2 <= a for every r below the room,
/// -D was found so that |p'' r^2 - p' D| <= a for them all (admission_room.hpp).
template <class Space>
double PathLaw<Space>::choose(const Path<Space>& path, double target, const Limits& limits,
                              double dt_s) {
  Piece ahead;
  Slopes next_sample = slopes(path, limits, dt_s, ahead);
  Interval& hard = next_sample.hard;
  const Room room = path.room(next(slope_, dt_s).s);
  const double falling = std::min(0.0, 0.5 * room.slope);
  hard.include(0.0);
  hard.include(falling);
  const double highest = 2.0 * (std::sqrt(std::max(room.most, 0.0)) - rate_) / dt_s - slope_;
  hard.hi = std::max(hard.lo, std::min(hard.hi, highest));

  const Interval reach = advice(path, limits, dt_s, ahead);
  const double way = target - rate_ - 0.5 * slope_ * dt_s;
  const double wanted = reach.nearest(std::copysign(onto(std::abs(way), bend_, dt_s), way));
  const double slope = hard.nearest(next_sample.soft.nearest(wanted));
  return corrected(path, slope, limits, dt_s, ahead);
}

/// Acceleration is not linear in the slope, and the next sample may lie on another segment than
/// thought: the slope is put right until it is within limits where it takes the path.
template <class Space>
double PathLaw<Space>::corrected(const Path<Space>& path, double slope, const Limits& limits,
                                 double dt_s, Piece& ahead) const {
  constexpr int n = Space::kChannelSize;
  double falling = 0.0;
  for (int i = 0; i < kCorrections; ++i) {
    const Next there = next(slope, dt_s);
    falling = std::min(0.0, 0.5 * path.room(there.s).slope);
    if (slope <= 0.0 && slope >= falling) return slope;
    const Local at = path.local(there.s, ahead);
    const typename Space::Rates own = at.d2 * (there.rate * there.rate);
    const typename Space::Rates all = own + at.d1 * slope;
    bool within = true;
    for (std::size_t c = 0; c < limits.a.size(); ++c) {
      const Eigen::Index k = static_cast<Eigen::Index>(c) * n;
      const double most = std::max(limits.a[c], length<n>(&own[k]));
      within = within && length<n>(&all[k]) <= most * (1.0 + kRounding);
    }
    if (within) return slope;
    Interval hard = about(at, there, limits, dt_s).hard;
    hard.include(0.0);
    hard.include(falling);
    slope = hard.nearest(slope);
  }
  return falling;
}

/// Takes the slope; at the target within what one period bends, where that does not move, it is
/// there. The path time is summed up with compensation (Kahan 1965).
template <class Space>
void PathLaw<Space>::settle(const Path<Space>& path, double target, double slope, double dt_s) {
  Next now = next(slope, dt_s);
  const bool there = std::abs(now.rate - target) <= kThere && std::abs(slope) * dt_s <= kThere;
  if (there) now = {now.s, target, 0.0};
  if (now.rate <= 0.0) now.slope = 0.0;
  if (now.rate >= 1.0) now = {now.s, 1.0, 0.0};
  const double way = 0.5 * dt_s * (rate_ + now.rate) - (now.slope - slope_) * dt_s * dt_s / 12.0;
  const double corrected_way = std::max(0.0, way) - carry_;
  const double sum = s_ + corrected_way;
  carry_ = (sum - s_) - corrected_way;
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
