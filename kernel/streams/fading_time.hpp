// The time in which a difference may fade (fade.hpp) within limits.
#pragma once

#include <algorithm>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/fade.hpp"
#include "kernel/reference/space/space.hpp"

namespace tactus {

/// Share of each limit that a fade may take. Its time grows in steps of this ratio, up to this many
/// times.
inline constexpr double kFadeShare = 0.5, kFadeStep = 1.25, kLongestFading = 30.0;
inline constexpr int kFadeSteps = 16;
/// Largest derivatives of the fading quintic of a difference of one: of its position x, of its
/// velocity dx, of its acceleration ddx.
inline constexpr double kVelocityOfX = 1.875, kAccelerationOfX = 5.7736, kJerkOfX = 60.0;
inline constexpr double kAccelerationOfDx = 4.0, kJerkOfDx = 36.0, kJerkOfDdx = 9.0;

/// Returns the time, at least `least_s`, in which a difference fades with at most half of every
/// limit. [cyclic]
template <class Space>
double fading_time_s(const typename Space::Difference& difference,
                     const typename Space::Limits& limits, double least_s) {
  constexpr int kSize = Space::kChannelSize;
  const typename Space::Peaks most = Space::peaks(limits);
  double T = least_s;
  for (int c = 0; c < Space::kChannels; ++c) {
    const auto i = static_cast<std::size_t>(c);
    const double x = difference.x.template segment<kSize>(c * kSize).norm();
    const double dx = difference.dx.template segment<kSize>(c * kSize).norm();
    const double ddx = difference.ddx.template segment<kSize>(c * kSize).norm();
    LoopBound<kFadeSteps> steps;
    for (int k = 0; k < kFadeSteps; ++k) {
      steps.tick();
      const double f = 1.0 / T;
      const double v = kVelocityOfX * x * f;
      const double a = (kAccelerationOfX * x * f + kAccelerationOfDx * dx) * f;
      const double j = ((kJerkOfX * x * f + kJerkOfDx * dx) * f + kJerkOfDdx * ddx) * f;
      if (v <= kFadeShare * most.v[i] && a <= kFadeShare * most.a[i] && j <= kFadeShare * most.j[i])
        break;
      T *= kFadeStep;
    }
  }
  return std::min(T, least_s * kLongestFading);
}

}  // namespace tactus
