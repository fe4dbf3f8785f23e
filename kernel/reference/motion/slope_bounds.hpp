// Bounds that the limits put on the slope u of the rate at one place of a path, channel by channel.
#pragma once

#include <cmath>

#include "kernel/core/types.hpp"
#include "kernel/reference/motion/interval.hpp"
#include "kernel/reference/space/judge_channels.hpp"

namespace tactus {

/// Largest slope, 1/s: no rate needs to change faster than in ten milliseconds.
inline constexpr double kSteepestSlope = 100.0;
inline constexpr Interval kAnySlope = {-kSteepestSlope, kSteepestSlope};
inline constexpr double kPlanned = 0.8;  ///< share of the jerk limit that plans use

/// Reduces x to the values for which a channel's |at_zero + gain x| is at most `limit`; if there is
/// none, to the one for which it is least.
template <int n>
void keep(Interval& x, const double* at_zero, const double* gain, double limit) {
  if constexpr (n == 1) {
    if (std::abs(*gain) < 1e-12) return;
    const double middle = -*at_zero / *gain, half = limit / std::abs(*gain);
    x.cut(middle - half, middle + half);
  } else {
    const Eigen::Map<const Vector3> o(at_zero), g(gain);
    const double gg = g.squaredNorm();
    if (gg < 1e-24) return;
    const double middle = -o.dot(g) / gg, across = (o + middle * g).squaredNorm();
    const double half = std::sqrt(std::max(0.0, (limit * limit - across) / gg));
    x.cut(middle - half, middle + half);
  }
}

/// Returns the time from full acceleration one way to full acceleration the other, s.
template <class Limits>
double ramp_s(const Limits& limits) {
  double ramp = 0.0;
  for (std::size_t c = 0; c < limits.a.size(); ++c)
    ramp = std::max(ramp, 2.0 * limits.a[c] / (kPlanned * limits.j[c]));
  return ramp;
}

/// Returns the limits that remain for the path while the reference closes an offset to it. [cyclic]
template <class Space>
typename Space::Peaks left_to_path(const typename Space::Limits& limits,
                                   const typename Space::Difference& offset) {
  constexpr double kPathJerk = 0.5;  // of the jerk, while an offset is closed
  constexpr int n = Space::kChannelSize;
  typename Space::Peaks left = Space::peaks(limits);
  const bool closes = !offset.zero();
  for (std::size_t c = 0; c < left.a.size(); ++c) {
    const double taken = length<n>(&offset.ddx[n * static_cast<int>(c)]);
    left.a[c] = std::max(left.a[c] - taken, 0.0);
    if (closes) left.j[c] *= kPathJerk;
  }
  return left;
}

/// Reduces `slopes` and the largest bend |du/dt| so that the jerk p''' r^3 + 3 p'' r u + p' du/dt
/// keeps its limit at a place.
template <class Space>
void narrow(const typename Space::Local& at, double rate, double slope,
            const typename Space::Peaks& limits, Interval& slopes, double& bend) {
  constexpr int n = Space::kChannelSize;
  const double zero[3] = {};
  for (std::size_t c = 0; c < limits.j.size(); ++c) {
    const Eigen::Index k = static_cast<Eigen::Index>(c) * n;
    const double j = limits.j[c];
    const double left = std::max(j - length<n>(&at.d3[k]) * rate * rate * rate, 0.1 * j);
    const double coupling = 3.0 * rate * length<n>(&at.d2[k]);
    keep<1>(slopes, zero, &coupling, kPlanned * left);
    const double rest = std::max(kPlanned * left - coupling * std::abs(slope), 0.2 * left);
    const double d1 = length<n>(&at.d1[k]);
    if (bend * d1 > rest) bend = rest / d1;
  }
}

}  // namespace tactus
