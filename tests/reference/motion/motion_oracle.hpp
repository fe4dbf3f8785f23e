// MotionOracle: checks from one reference to the next that limits are kept, and that velocity and
// acceleration are the derivatives of the position. It uses only successive outputs and the limits.
//
// If the jerk is at most j within a period h and otherwise arbitrary, then by Peano's theorem
//   |v1 - v0 - h (a0 + a1) / 2|                              <= j h^2 / 4
//   |p1 - p0 - h (v0 + v1) / 2 + h^2 (a1 - a0) / 12|         <= j h^3 / (18 sqrt(3))
// with the kernels (h - 2u) / 2 and h^2 B2(u/h) / 2, integrated in magnitude. If only the
// acceleration is bounded by a, then |p1 - p0 - h (v0 + v1) / 2| <= a h^2 / 4.
#pragma once

#include <cstdio>

#include "tests/reference/motion/motion_tracks.hpp"

namespace tactus {

inline constexpr double kOverLimit = 1e-9;  ///< excess by rounding, as a fraction of the limit
/// Excess of jerk where the rate on a path changes, as a fraction.
inline constexpr double kRateJerk = 1e-3;
/// Largest number of corners of a path of lines within a period.
inline constexpr int kCorners = 2;
/// Absolute rounding of a velocity and an angle.
inline constexpr double kRounding = 1e-12;

/// The highest derivative that is continuous, as on paths of quintics, cubics and lines.
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

  /// `share_j`: allowed excess over the jerk limits, as a fraction.
  void begin(const typename Space::Limits& limits, double period_s, Smoothness smoothness,
             double share_j) {
    limits_ = limits;
    h_ = period_s;
    smoothness_ = smoothness;
    share_j_ = 1.0 + share_j + kOverLimit;
    any_ = false;
  }
  /// Forgets the reference so far, before a start or a forwarded point, which may step.
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
      const double range = limits.p_max[k] - limits.p_min[k];
      const double slack = kOverLimit * std::max(range, 1.0) + Tracks<Space>::kStopBeyond;
      if (limits.turns || limits.p_max[k] == kInfinity) continue;
      expect("position above its limit", now.p[k], limits.p_max[k] + slack);
      expect("position below its limit (negated)", -now.p[k], slack - limits.p_min[k]);
    }
    expect("velocity", now.v.norm(), limits.v * (1.0 + kOverLimit));
    expect("acceleration", now.a.norm(), limits.a * (1.0 + kOverLimit));
  }
  void check_step(const Track& before, const Track& now, const TrackLimits& limits) {
    const Vector3 way = limits.turns ? now.p : Vector3(now.p - before.p);
    const Vector3 dv = now.v - before.v, da = now.a - before.a, mean = 0.5 * (before.v + now.v);
    const double a = limits.a * (1.0 + kOverLimit), j = limits.j * share_j_;
    // The rotation vector phi of a turn is the integral of w + w x phi / 2 + ..., which differs
    // from the integral of w by h^3 |w x alpha| / 12 to the order that matters here.
    const double turning =
        limits.turns ? 0.1 * h_ * h_ * h_ * limits.v * (limits.a + limits.v * limits.v) : 0.0;
    // On lines, a larger velocity can occur between two samples.
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
  double h_ = 0.0, share_j_ = 1.0;
  Smoothness smoothness_ = Smoothness::kAcceleration;
  Point before_;
  bool any_ = false;
  int track_ = 0;
  Excess found_;
};

}  // namespace tactus
