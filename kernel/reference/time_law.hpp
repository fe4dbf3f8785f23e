// TimeLaw: how fast a reference runs along its path. Path time s passes at the rate r = ds/dt, 0
// standing, 1 as planned. The rate changes with bounded slope and curvature, so that on the path
// p(s)
//
//   velocity      p' r
//   acceleration  p'' r^2 + p' dr/dt
//   jerk          p''' r^3 + 3 p'' r dr/dt + p' d2r/dt2
//
// stay within limits whenever path and bounds leave room for each other (path_use.hpp). Stop,
// pause, resume and override are targets of this one law; none of them leaves the path.
#pragma once

#include <array>

namespace tactus {

/// Largest change of the rate: |dr/dt| in 1/s, |d2r/dt2| in 1/s^2. Both are positive.
struct RateBounds {
  double slope = 1.0, curvature = 1.0;
};

class TimeLaw {
 public:
  /// Path time `s`, running at `rate` steadily. [cyclic]
  void start(double rate, double s = 0.0);
  /// From now on the rate goes to `target`, 0..1, as fast as the bounds allow, and stays there.
  /// [cyclic]
  void plan(double target, const RateBounds& bounds);
  /// Moves on by dt seconds. [cyclic]
  void advance(double dt_s);

  double s() const { return s_; }          ///< path time, s
  double rate() const { return rate_; }    ///< ds/dt
  double slope() const { return slope_; }  ///< dr/dt, 1/s
  bool standing() const { return rate_ == 0.0 && slope_ == 0.0; }

  /// Path time that passes until the rate is zero if a stop is planned now. [cyclic]
  double stopping_s(const RateBounds& bounds) const;

 private:
  /// A part of the plan with constant curvature.
  struct Phase {
    double duration_s = 0.0, curvature = 0.0;
  };
  void move(double dt_s, double curvature);
  void pass(double path_time_s);

  double carry_ = 0.0;  // what s_ has lost to rounding, of millions of periods added up
  double s_ = 0.0, rate_ = 0.0, slope_ = 0.0, target_ = 0.0;
  std::array<Phase, 3> phases_;
  std::size_t phase_ = 3;      // the one in progress; 3: the target is reached
  double phase_time_s_ = 0.0;  // since it began
};

}  // namespace tactus
