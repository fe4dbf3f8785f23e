// PathLaw: the law of the rate at which a reference passes its path. Path time s passes at the rate
// r = ds/dt, 0 at rest and 1 as planned, which changes with the slope u = dr/dt. On the path p(s)
//
//   velocity      p' r
//   acceleration  p'' r^2 + p' u
//   jerk          p''' r^3 + 3 p'' r u + p' du/dt
//
// A path that keeps its limits at rate 1 keeps them at any constant rate, so u = 0 is always
// possible. A stop therefore needs no plan, only the bounds that limits put on u at the present
// place and a short way ahead, over which jerk lets u change. With no plan nothing becomes stale:
// stop, pause, resume and override are targets of a single step, given again in every period.
// Braking as hard as the present place allows is the shortest way to a stop, since d(r^2)/ds = 2 u.
// That u = 0 is always possible makes this simpler than time-optimal motion along a path (Bobrow,
// Dubowsky and Gibson 1985; Dahl and Nielsen 1990; Pham and Pham 2018).
//
// Where the rate must be below 1, before the open end of a path or where planned times are too
// short, its square is bounded by Path::room(). The room is piecewise linear and falls no faster
// than 2 D, where the limits allow the slope -D at every rate below it.
#pragma once

#include "kernel/reference/motion/interval.hpp"
#include "kernel/reference/motion/path.hpp"
#include "kernel/reference/motion/path_period.hpp"

namespace tactus {

template <class Space>
class PathLaw {
 public:
  using Limits = typename Space::Peaks;

  /// Starts at path time `s` with the constant `rate`, or the lower one that the room ahead allows.
  /// [cyclic]
  void start(const Path<Space>& path, double s, double rate, const Limits& limits, double dt_s);
  /// Moves one period ahead and the rate towards `target`. `limits` are those left to the path in
  /// this period; keeping the rate is allowed whatever they are. Afterwards r is in [0, 1], s not
  /// past the end, and the acceleration within limits, there and in the mean of the period; the
  /// jerk too where acceleration leaves a choice. [cyclic]
  void step(const Path<Space>& path, double target, const Limits& limits, double dt_s);
  /// Ends following the path. [cyclic]
  void stop() { *this = PathLaw(); }

  double s() const { return s_; }          ///< path time, s
  double rate() const { return rate_; }    ///< ds/dt
  double slope() const { return slope_; }  ///< dr/dt, 1/s
  bool standing() const { return rate_ == 0.0 && slope_ == 0.0; }

 private:
  using Local = typename Space::Local;
  /// Segments that were built for places of this period: about the next sample, and farther on.
  struct Ahead {
    typename Path<Space>::Piece near, far;
  };

  PathRate now() const { return {s_, rate_, slope_}; }
  double later_s(double time_s) const;
  double least_room(const Path<Space>& path, const Limits& limits, double dt_s) const;
  Interval advice(const Path<Space>& path, const Limits& limits, double dt_s, Ahead& ahead);
  double choose(const Path<Space>& path, double target, const Limits& limits, double dt_s);
  double fitted(const Path<Space>& path, double wanted, double highest, const Limits& limits,
                double dt_s, Ahead& ahead) const;
  void settle(const Path<Space>& path, double target, double slope, double dt_s);

  double carry_ = 0.0;  // rounding error of s_, which sums up millions of periods
  double s_ = 0.0, rate_ = 0.0, slope_ = 0.0;
  double bend_ = 0.0;  // largest |du/dt| that the path ahead allows, 1/s^2
};

}  // namespace tactus
