// What the limits of one place of a path say of the slope u of the rate, channel by channel.
#pragma once

#include <cmath>

#include "kernel/reference/interval.hpp"
#include "kernel/types.hpp"

namespace tactus {

inline constexpr double kPlanned = 0.8;  ///< share of the jerk that is counted on

/// The x for which a channel's |offset + gain x| is at most `limit`; if there is none, the x for
/// which it is least.
template <int n>
void keep(Interval& x, const double* offset, const double* gain, double limit) {
  if constexpr (n == 1) {
    if (std::abs(*gain) < 1e-12) return;
    const double middle = -*offset / *gain, half = limit / std::abs(*gain);
    x.cut(middle - half, middle + half);
  } else {
    const Eigen::Map<const Vector3> o(offset), g(gain);
    const double gg = g.squaredNorm();
    if (gg < 1e-24) return;
    const double middle = -o.dot(g) / gg, across = (o + middle * g).squaredNorm();
    const double half = std::sqrt(std::max(0.0, (limit * limit - across) / gg));
    x.cut(middle - half, middle + half);
  }
}

template <int n>
double length(const double* channel) {
  if constexpr (n == 1)
    return std::abs(*channel);
  else
    return Eigen::Map<const Vector3>(channel).norm();
}

/// From full acceleration one way to full acceleration the other.
template <class Limits>
double ramp_s(const Limits& limits) {
  double ramp = 0.0;
  for (std::size_t c = 0; c < limits.a.size(); ++c)
    ramp = std::max(ramp, 2.0 * limits.a[c] / (kPlanned * limits.j[c]));
  return ramp;
}

/// What jerk says of u and its derivative at a place:  p''' r^3 + 3 p'' r u + p' du/dt.
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
