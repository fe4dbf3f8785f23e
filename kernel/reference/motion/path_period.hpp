// PathPeriod: what one period on a path does to the reference, for one slope of the rate at its
// end.
#pragma once

#include <algorithm>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/slope_bounds.hpp"

namespace tactus {

/// A place on a path: path time [s], its rate [1], and the slope of the rate [1/s].
struct PathRate {
  double s, rate, slope;

  /// Returns the path time that passes in one period, at whose end rate and slope are these; the
  /// slope changes linearly. [any]
  double way_s(double rate_then, double slope_then, double dt_s) const {
    const double mean = 0.5 * (rate + rate_then), bend = (slope_then - slope) / 12.0;
    return std::max(0.0, dt_s * (mean - bend * dt_s));
  }
  /// Returns the place one period later. [any]
  PathRate later(double slope_then, double dt_s) const {
    const double rate_then = std::max(0.0, rate + 0.5 * dt_s * (slope + slope_then));
    return {s + way_s(rate_then, slope_then, dt_s), rate_then, slope_then};
  }
};

/// A place with the derivatives of the path there.
template <class Space>
struct PathSample {
  PathRate at;
  typename Space::Local path;
};

/// A period of dt between two samples, and the next one to `after`. The bounded quantities are
/// nearly linear in the slope at `to`; gains are their derivatives:
///
///   acceleration at `to`, its change in the period, and the mean acceleration of both periods
///
/// A mean is the change of velocity, whatever the path does between samples. That of the next
/// period counts with the slope that is always allowed there, so that every period ends where the
/// next can keep its limits. At samples a little less is used, so that second differences of
/// positions, which a guard or a drive sees, keep the limit as well where the acceleration is
/// smooth.
template <class Space>
class PathPeriod {
 public:
  using Sample = PathSample<Space>;
  using Rates = typename Space::Rates;
  using Limits = typename Space::Peaks;
  using Levels = typename Space::Levels;

  /// Where lines meet, the step of the velocity is no acceleration, and where cubics meet, that of
  /// the acceleration is no jerk. [cyclic]
  PathPeriod(const Sample& from, const Sample& to, const Sample& after, Interpolation order,
             double dt_s)
      : slope_(to.at.slope), dt_s_(dt_s) {
    const double before = from.at.rate, r = to.at.rate, w = r * r, then = after.at.rate;
    const Rates v = to.path.d1 * r;
    own_ = to.path.d2 * w;
    own_after_ = after.path.d2 * (then * then);
    a_.value = own_ + to.path.d1 * slope_;
    a_.gain = to.path.d1 + to.path.d2 * (r * dt_s) +
              (to.path.d3 * w + to.path.d2 * slope_) * (dt_s * dt_s / 6.0);
    const bool smooth = order == Interpolation::kQuintic;
    if (order == Interpolation::kLinear) {
      mean_ = next_mean_ = a_;
    } else {
      mean_.value = (v - from.path.d1 * before) / dt_s;
      mean_.gain = 0.5 * to.path.d1 + to.path.d2 * (r * dt_s / 6.0);
      next_mean_.value = (after.path.d1 * then - v) / dt_s;
      next_mean_.gain = after.path.d1 + after.path.d2 * (then * dt_s) - mean_.gain;
    }
    // Where it steps, the acceleration of the path at `to` is followed back.
    const typename Space::Local& path = smooth ? from.path : to.path;
    change_ = a_.value - path.d2 * (before * before) - path.d1 * from.at.slope;
    own_change_ = (to.path.d2 - from.path.d2) * (before * before);
    if (!smooth) {
      own_change_ = path.d3 * (before * before * before * dt_s);
      change_ += own_change_ + path.d2 * (from.at.slope * before * dt_s);
    }
  }

  /// True if no acceleration is beyond its limit, nor beyond what the path takes at a constant
  /// rate.
  bool keeps_acceleration(const Limits& limits) const {
    LoopBound<kDof> channels;
    for (std::size_t c = 0; c < limits.a.size(); ++c) {
      channels.tick();
      const double own = size(own_, c), here = std::max(kAtSamples * limits.a[c], own);
      const double between = std::max({limits.a[c], own, size(own_after_, c)});
      if (!(size(a_.value, c) <= here * (1.0 + kRounding) &&
            size(mean_.value, c) <= between * (1.0 + kRounding) &&
            size(next_mean_.value, c) <= between * (1.0 + kRounding)))
        return false;
    }
    return true;
  }
  /// The same of jerk.
  bool keeps_jerk(const Limits& limits) const {
    const Levels most = changes(limits);
    LoopBound<kDof> channels;
    for (std::size_t c = 0; c < most.size(); ++c) {
      channels.tick();
      if (!(size(change_, c) <= most[c] * (1.0 + kJerkRounding))) return false;
    }
    return true;
  }
  /// Reduces `slopes` to those that keep acceleration.
  void cut_to_acceleration(Interval& slopes, const Limits& limits) const {
    cut(slopes, a_, limits.a, kAtSamples);
    cut(slopes, mean_, limits.a, 1.0);
    cut(slopes, next_mean_, limits.a, 1.0);
  }
  /// Reduces `slopes` to those that keep jerk.
  void cut_to_jerk(Interval& slopes, const Limits& limits) const {
    cut(slopes, {change_, a_.gain}, changes(limits), 1.0);
  }

 private:
  static constexpr int n = Space::kChannelSize;
  static constexpr double kRounding = 1e-11, kJerkRounding = 1e-5;  // as fractions of a limit
  static constexpr double kAtSamples = 0.996;                       // of the acceleration limit
  struct Linear {
    Rates value, gain;
  };

  static double size(const Rates& rates, std::size_t channel) {
    return length<n>(&rates[n * static_cast<Eigen::Index>(channel)]);
  }
  /// Returns the largest changes of acceleration in the period.
  Levels changes(const Limits& limits) const {
    Levels most;
    LoopBound<kDof> channels;
    for (std::size_t c = 0; c < most.size(); ++c) {
      channels.tick();
      most[c] = std::max(limits.j[c] * dt_s_, size(own_change_, c));
    }
    return most;
  }
  void cut(Interval& slopes, const Linear& what, const Levels& limits, double scale) const {
    const Rates at_zero = what.value - what.gain * slope_;
    for (std::size_t c = 0; c < limits.size(); ++c) {
      const Eigen::Index k = n * static_cast<Eigen::Index>(c);
      keep<n>(slopes, &at_zero[k], &what.gain[k], limits[c] * scale);
    }
  }

  double slope_, dt_s_;
  Linear a_, mean_, next_mean_;
  Rates own_, own_after_, own_change_, change_;
};

}  // namespace tactus
