// What must hold from one reference to the next, whatever was asked for: limits, and that velocity
// and acceleration are the derivatives of the position. It sees successive outputs and the limits,
// nothing of what makes them.
//
// Let the jerk be at most j within a period h, changing as it likes there. By Peano's theorem
//   |v1 - v0 - h (a0 + a1) / 2|                              <= j h^2 / 4
//   |p1 - p0 - h (v0 + v1) / 2 + h^2 (a1 - a0) / 12|         <= j h^3 / (18 sqrt(3))
// with the kernels (h - 2u) / 2 and h^2 B2(u/h) / 2, integrated in magnitude. Let only the
// acceleration be at most a: |p1 - p0 - h (v0 + v1) / 2| <= a h^2 / 4.
#pragma once

#include <cstdio>

#include "tests/motion_tracks.hpp"

namespace tactus {

inline constexpr double kOverLimit = 1e-9;  ///< over a limit, of the limit: rounding
/// Over the limits where the rate on a path changes: what comes of linearising within a period.
inline constexpr double kRateAcceleration = 2.5e-3, kRateJerk = 0.05;
/// Of a path of lines: so many lines may meet within a period.
inline constexpr int kCorners = 2;
/// Rounding of a velocity and an angle beside the limits.
inline constexpr double kRounding = 1e-12;

/// What is continuous: up to the acceleration, up to the velocity, or up to the position with steps
/// of velocity, as paths of quintics, cubics and lines are.
enum class Smoothness { kAcceleration, kVelocity, kPosition };

struct Excess {
  const char* what = nullptr;  ///< null: nothing is wrong
  int track = 0;
  double value = 0.0, limit = 0.0;
};

template <class Space>
class MotionOracle {
 public:
  using Point = typename Space::Point;

  /// `share_a` and `share_j`: by how much the acceleration and jerk limits may be exceeded.
  void begin(const typename Space::Limits& limits, double period_s, Smoothness smoothness,
             double share_a, double share_j) {
    limits_ = limits;
    h_ = period_s;
    smoothness_ = smoothness;
    share_a_ = 1.0 + share_a + kOverLimit;
    share_j_ = 1.0 + share_j + kOverLimit;
    any_ = false;
  }
  /// What was before says nothing of what comes: a start, a point that was forwarded.
  void forget() { any_ = false; }

  Excess check(const Point& now) {
    found_ = {};
    if (!now.finite()) found_ = {"finite", -1, 0.0, 0.0};
    for (int i = 0; i < Tracks<Space>::kCount && found_.what == nullptr; ++i) {
      track_ = i;
      const TrackLimits limits = Tracks<Space>::limits(limits_, i);
      const Track track = Tracks<Space>::of(now, any_ ? before_ : now, i);
      check_instant(track, limits);
      if (any_) check_step(Tracks<Space>::of(before_, before_, i), track, limits);
    }
    before_ = now;
    any_ = true;
    return found_;
  }

 private:
  void check_instant(const Track& now, const TrackLimits& limits) {
    for (int k = 0; k < 3; ++k) {
      const double slack = kOverLimit * std::max(limits.p_max[k] - limits.p_min[k], 1.0);
      if (limits.turns || limits.p_max[k] == kInfinity) continue;
      expect("position above its limit", now.p[k], limits.p_max[k] + slack);
      expect("position below its limit (negated)", -now.p[k], slack - limits.p_min[k]);
    }
    expect("velocity", now.v.norm(), limits.v * (1.0 + kOverLimit));
    expect("acceleration", now.a.norm(), limits.a * share_a_);
  }
  void check_step(const Track& before, const Track& now, const TrackLimits& limits) {
    const Vector3 way = limits.turns ? now.p : Vector3(now.p - before.p);
    const Vector3 dv = now.v - before.v, da = now.a - before.a, mean = 0.5 * (before.v + now.v);
    const double a = limits.a * share_a_, j = limits.j * share_j_;
    // A turn's rotation vector is the integral of w + w x phi / 2 + ..., phi its own beginning:
    // h^3 |w x alpha| / 12 to the order that counts here.
    const double turning =
        limits.turns ? 0.1 * h_ * h_ * h_ * limits.v * (limits.a + limits.v * limits.v) : 0.0;
    // Where only velocities are told, one of lines may lie between those of two samples.
    const double between = smoothness_ == Smoothness::kPosition ? a * h_ * h_ / 12.0 : 0.0;
    expect("way in a period", way.norm(), limits.v * h_ * (1.0 + kOverLimit) + between + kRounding);
    const double corners = smoothness_ == Smoothness::kPosition ? kCorners * limits.v_step : 0.0;
    expect("change of velocity in a period", dv.norm(), corners + a * h_ + kRounding);
    if (smoothness_ == Smoothness::kPosition) return;
    expect("way against velocity", (way - h_ * mean).norm(),
           0.25 * a * h_ * h_ + turning + kRounding);
    if (smoothness_ == Smoothness::kVelocity) return;
    expect("change of acceleration in a period", da.norm(), j * h_ + kRounding);
    expect("velocity against acceleration", (dv - 0.5 * h_ * (before.a + now.a)).norm(),
           0.25 * j * h_ * h_ + kRounding);
    const Vector3 rest = way - h_ * mean + (h_ * h_ / 12.0) * da;
    expect("way against velocity and acceleration", rest.norm(),
           j * h_ * h_ * h_ / (18.0 * std::sqrt(3.0)) + turning + kRounding);
  }
  void expect(const char* what, double value, double limit) {
    if (value <= limit || found_.what != nullptr) return;  // NaN is an excess
    found_ = {what, track_, value, limit};
  }

  typename Space::Limits limits_;
  double h_ = 0.0, share_a_ = 1.0, share_j_ = 1.0;
  Smoothness smoothness_ = Smoothness::kAcceleration;
  Point before_;
  bool any_ = false;
  int track_ = 0;
  Excess found_;
};

}  // namespace tactus
