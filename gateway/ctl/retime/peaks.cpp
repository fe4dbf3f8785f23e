#include "gateway/ctl/retime/peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::ctl {
namespace {

/// Velocity, acceleration and jerk of one joint over the time t in [0, T] of a segment.
struct Segment {
  double T;
  std::array<double, 6> c;

  double v(double t) const {
    return c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * 5.0 * c[5])));
  }
  double a(double t) const {
    return 2.0 * c[2] + t * (6.0 * c[3] + t * (12.0 * c[4] + t * 20.0 * c[5]));
  }
  double j(double t) const { return 6.0 * c[3] + t * (24.0 * c[4] + t * 60.0 * c[5]); }
};

Segment through(const TimedPoint& from, const TimedPoint& to, int k, bool quintic) {
  const double T = to.time_s - from.time_s;
  const double way = (to.q[k] - from.q[k]) / T, v0 = from.dq[k], v1 = to.dq[k];
  if (!quintic)
    return {T, {from.q[k], v0, (3.0 * way - 2.0 * v0 - v1) / T, (v0 + v1 - 2.0 * way) / (T * T)}};
  const double a0 = from.ddq[k], a1 = to.ddq[k];
  return {T,
          {from.q[k], v0, a0 / 2.0,
           (20.0 * way - 8.0 * v1 - 12.0 * v0 - (3.0 * a0 - a1) * T) / (2.0 * T * T),
           (-30.0 * way + 14.0 * v1 + 16.0 * v0 + (3.0 * a0 - 2.0 * a1) * T) / (2.0 * T * T * T),
           (12.0 * way - 6.0 * (v0 + v1) - (a0 - a1) * T) / (2.0 * T * T * T * T)}};
}

/// Returns the time at which the acceleration, monotone between two times, is zero; `from` if it is
/// not.
double zero_of_a(const Segment& segment, double from, double to) {
  const bool rising = segment.a(to) > 0.0;
  if ((segment.a(from) > 0.0) == rising) return from;
  for (int i = 0; i < 60; ++i) {
    const double middle = (from + to) / 2.0;
    ((segment.a(middle) > 0.0) == rising ? to : from) = middle;
  }
  return to;
}

/// The times between which the acceleration is monotone: where the jerk, a parabola, is zero.
std::array<double, 4> turns_of_a(const Segment& segment) {
  const auto inside = [&](double t) {
    return std::isfinite(t) ? std::clamp(t, 0.0, segment.T) : 0.0;
  };
  const double a = 60.0 * segment.c[5], b = 24.0 * segment.c[4], c = 6.0 * segment.c[3];
  const double root = std::sqrt(std::max(0.0, b * b - 4.0 * a * c));
  const double sum = -(b + (b < 0.0 ? -root : root)) / 2.0;
  std::array<double, 4> times = {0.0, inside(sum / a), inside(c / sum), segment.T};
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

double Peaks::stretch(double least) const {
  return std::max({least, v, std::sqrt(a), std::cbrt(j)});
}

Peaks peaks(const std::vector<TimedPoint>& points, const MotionBounds& bounds, bool quintic) {
  Peaks most;
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (int k = 0; k < bounds.v.size(); ++k) {
      const Segment segment = through(points[i - 1], points[i], k, quintic);
      const std::array<double, 4> times = turns_of_a(segment);
      for (std::size_t n = 0; n < times.size(); ++n) {
        const double t = times[n], rest = zero_of_a(segment, n > 0 ? times[n - 1] : t, t);
        most.v = std::max({most.v, std::abs(segment.v(t)) / bounds.v[k],
                           std::abs(segment.v(rest)) / bounds.v[k]});
        most.a = std::max(most.a, std::abs(segment.a(t)) / bounds.a[k]);
      }
      const double bend = std::clamp(-24.0 * segment.c[4] / (120.0 * segment.c[5]), 0.0, segment.T);
      for (const double t : {0.0, std::isfinite(bend) ? bend : 0.0, segment.T})
        if (quintic) most.j = std::max(most.j, std::abs(segment.j(t)) / bounds.j[k]);
    }
  }
  return most;
}

}  // namespace tactus::ctl
