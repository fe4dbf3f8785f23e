// TimeOptimum: the least time in which one axis comes from a state of motion to rest at a distance,
// within velocity, acceleration and jerk limits, by search. An optimal motion changes its velocity
// to some w, keeps it if that is the limit, and changes it to zero; or, if it decelerates already,
// it first reduces the deceleration for some time. All w, and all such times, are searched for
// those that end at the distance, and the shortest is taken.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus {

struct SymmetricLimits {
  double v, a, j;
};

class TimeOptimum {
 public:
  explicit TimeOptimum(const SymmetricLimits& limits) : limits_(limits) {}

  /// Returns the seconds from velocity v and acceleration a to rest at `distance` from here.
  double time_s(double v, double a, double distance) const {
    double best = std::numeric_limits<double>::infinity();
    const double run_out = v + a * std::abs(a) / (2.0 * limits_.j);
    const double corners[] = {-limits_.v, std::clamp(run_out, -limits_.v, limits_.v), 0.0,
                              limits_.v};
    const auto through = [&](double w) { return changed(changed({v, a, 0.0, 0.0}, w), 0.0); };
    for (int i = 0; i < 3; ++i) look(through, corners[i], corners[i + 1], distance, best);
    for (const double w : {-limits_.v, limits_.v}) {
      const State end = through(w);
      const double cruise_s = (distance - end.p) / w;
      if (cruise_s >= 0.0) best = std::min(best, end.t + cruise_s);
    }
    const double relief = a > 0.0 ? -limits_.j : limits_.j;
    const auto relieved = [&](double t) {
      return changed(moved({v, a, 0.0, 0.0}, relief, t), 0.0);
    };
    look(relieved, 0.0, std::abs(a) / limits_.j, distance, best);
    return best;
  }
  /// Return the distance (m or rad) and the time (s) of a full stop from velocity v and
  /// acceleration 0.
  double stopping_way(double v) const { return std::abs(changed({v, 0.0, 0.0, 0.0}, 0.0).p); }
  double stopping_time_s(double v) const { return changed({v, 0.0, 0.0, 0.0}, 0.0).t; }

 private:
  struct State {
    double v, a, p, t;
  };

  static State moved(const State& from, double jerk, double t) {
    return {from.v + t * (from.a + t * jerk / 2.0), from.a + t * jerk,
            from.p + t * (from.v + t * (from.a / 2.0 + t * jerk / 6.0)), from.t + t};
  }
  /// Returns the state at the end of the fastest change to velocity w, acceleration 0.
  State changed(const State& from, double w) const {
    const double run_out = from.v + from.a * std::abs(from.a) / (2.0 * limits_.j);
    const double up = w >= run_out ? 1.0 : -1.0;
    const double gain = up * (w - from.v), a = up * from.a;
    const double peak =
        std::min(std::sqrt(std::max(limits_.j * gain + a * a / 2.0, 0.0)), limits_.a);
    const double hold_s = (gain - (2.0 * peak * peak - a * a) / (2.0 * limits_.j)) / peak;
    State state = moved(from, up * limits_.j, std::max((peak - a) / limits_.j, 0.0));
    if (peak >= limits_.a) state = moved(state, 0.0, std::max(hold_s, 0.0));
    return moved(state, -up * limits_.j, peak / limits_.j);
  }
  /// Searches [from, to] for all x at which the motion covers `distance`, and lowers `best` to the
  /// least time. Samples are closer at both ends, where the distance may vary like a root of x.
  template <class Motion>
  void look(Motion motion, double from, double to, double distance, double& best) const {
    constexpr int kTried = 200;
    const auto at = [&](int i) {
      const double s = static_cast<double>(i) / kTried;
      return from + (to - from) * s * s * s * (s * (6.0 * s - 15.0) + 10.0);
    };
    if (!(to > from)) return;
    double short_of = motion(from).p - distance;
    for (int i = 1; i <= kTried; ++i) {
      const double next = motion(at(i)).p - distance;
      if ((short_of <= 0.0) != (next <= 0.0)) {
        double lo = at(i - 1), hi = at(i);
        for (int k = 0; k < 60; ++k) {
          const double middle = 0.5 * (lo + hi);
          ((motion(middle).p - distance <= 0.0) == (short_of <= 0.0) ? lo : hi) = middle;
        }
        best = std::min(best, motion(hi).t);
      }
      short_of = next;
    }
  }

  SymmetricLimits limits_;
};

}  // namespace tactus
