// PathLaw: how fast a reference runs along its path. Path time s passes at the rate r = ds/dt, 0
// standing, 1 as planned, which changes with the slope u = dr/dt. On the path p(s)
//
//   velocity      p' r
//   acceleration  p'' r^2 + p' u
//   jerk          p''' r^3 + 3 p'' r u + p' du/dt
//
// A path that is within limits at rate 1 can be kept at any rate, so u = 0 is always a way out: a
// stop needs no plan, only the bounds that limits put on u where the path is and a short way ahead,
// over which jerk lets u change. Nothing is planned, so nothing becomes stale: stop, pause, resume
// and override are targets of one step, told anew in every period. Braking as hard as the present
// place allows is the shortest way to a stop, since d(r^2)/ds = 2 u; that u = 0 need not be left
// free is what makes it simpler than time-optimal motion along a path (Bobrow, Dubowsky and Gibson
// 1985; Dahl and Nielsen 1990; Pham and Pham 2018).
//
// Where the rate must be below 1, before the open end of a path or where planned times are too
// short, its square is bounded by Path::room(), linear between waypoints, which falls no faster
// than 2 D with -D a slope that limits allow for every rate below it.
#pragma once

#include "kernel/reference/interval.hpp"
#include "kernel/reference/path.hpp"

namespace tactus {

template <class Space>
class PathLaw {
 public:
  using Limits = typename Space::Peaks;

  /// Path time `s`, steadily at `rate`, or as fast below it as there is room ahead. [cyclic]
  void start(const Path<Space>& path, double s, double rate, const Limits& limits, double dt_s);
  /// One period further, the rate towards `target`. `limits` are what is left to the path in this
  /// period; keeping the rate is allowed whatever they are. Afterwards r is in [0, 1], s not past
  /// the end, and the acceleration within limits; jerk is where acceleration leaves the choice.
  /// [cyclic]
  void step(const Path<Space>& path, double target, const Limits& limits, double dt_s);
  /// The path is followed no more. [cyclic]
  void stop() { *this = PathLaw(); }

  double s() const { return s_; }          ///< path time, s
  double rate() const { return rate_; }    ///< ds/dt
  double slope() const { return slope_; }  ///< dr/dt, 1/s
  bool standing() const { return rate_ == 0.0 && slope_ == 0.0; }

 private:
  using Local = typename Space::Local;
  using Piece = typename Path<Space>::Piece;

  /// The next sample if it has the slope u.
  struct Next {
    double s, rate, slope;
  };
  /// Slopes at the next sample that acceleration allows, and those that jerk does.
  struct Slopes {
    Interval hard, soft;
  };

  double later_s(double time_s) const;
  double least_room(const Path<Space>& path, const Limits& limits, double dt_s) const;
  Next next(double slope, double dt_s) const;
  Slopes about(const Local& at, const Next& guess, const Limits& limits, double dt_s) const;
  Slopes slopes(const Path<Space>& path, const Limits& limits, double dt_s, Piece& ahead) const;
  Interval advice(const Path<Space>& path, const Limits& limits, double dt_s, Piece& ahead);
  double choose(const Path<Space>& path, double target, const Limits& limits, double dt_s);
  double corrected(const Path<Space>& path, double slope, const Limits& limits, double dt_s,
                   Piece& ahead) const;
  void settle(const Path<Space>& path, double target, double slope, double dt_s);

  double carry_ = 0.0;  // what s_ has lost to rounding, of millions of periods added up
  double s_ = 0.0, rate_ = 0.0, slope_ = 0.0;
  double bend_ = 0.0;  // largest |du/dt| that all that lies ahead allows, 1/s^2
};

}  // namespace tactus
