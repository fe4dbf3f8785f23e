// Judgements of velocities that are the same in every space: channel by channel, by the length of
// each. The axis of channel c in a Verdict is c times the numbers of a channel.
#pragma once

#include "kernel/core/types.hpp"
#include "kernel/reference/space/limit_check.hpp"

namespace tactus {

/// Returns the length of a channel of n numbers. [any]
template <int n>
double length(const double* channel) {
  if constexpr (n == 1)
    return std::abs(*channel);
  else
    return Eigen::Map<const Vector3>(channel).norm();
}

/// Judges the length of every channel of a velocity against a limit of its own. [cyclic]
template <class Space>
Verdict judge_lengths(const typename Space::Rates& v, const typename Space::Levels& most,
                      Status status) {
  for (std::size_t c = 0; c < most.size(); ++c) {
    const int axis = Space::kChannelSize * static_cast<int>(c);
    const double speed = length<Space::kChannelSize>(&v[axis]);
    if (exceeds(speed, most[c])) return {status, -1, axis, speed, most[c]};
  }
  return {};
}

/// Judges a velocity: kVelocityLimit. [cyclic]
template <class Space>
Verdict judge_velocity(const typename Space::Rates& v, const typename Space::Limits& limits) {
  return judge_lengths<Space>(v, Space::peaks(limits).v, Status::kVelocityLimit);
}

/// Judges an online point: as a waypoint, and its velocity. [cyclic]
template <class Space>
Verdict judge_online(const typename Space::Point& point, const typename Space::Limits& limits) {
  const Verdict verdict = Space::judge_waypoint(point, limits);
  return verdict.ok() ? judge_velocity<Space>(Space::rates(point), limits) : verdict;
}

/// Judges whether the reference can be `to` one period after it was `from`: kVelocityLimit.
/// [cyclic]
template <class Space>
Verdict judge_reach(const typename Space::Point& from, const typename Space::Point& to,
                    const typename Space::Limits& limits, double dt_s) {
  return judge_velocity<Space>(Space::secant(from, to, dt_s), limits);
}

/// Judges the distance of a point from the reference, m or rad: kPointStep. [cyclic]
template <class Space>
Verdict judge_distance(const typename Space::Point& from, const typename Space::Point& to,
                       double most_apart) {
  typename Space::Levels most;
  most.fill(most_apart);
  return judge_lengths<Space>(Space::secant(from, to, 1.0), most, Status::kPointStep);
}

/// Judges the last waypoint, which must be at rest as nothing follows it: kNotAtRest. [any]
template <class Space>
Verdict judge_end(const typename Space::Point& end) {
  const typename Space::Rates& v = Space::rates(end);
  for (int i = 0; i < v.size(); ++i) {
    if (exceeds(std::abs(v[i]), kRestRounding)) return {Status::kNotAtRest, -1, i, v[i], 0.0};
  }
  return {};
}

/// Judges a measured velocity against one limit for all channels, in rad/s or m/s: kGoalVelocity.
/// A limit of 0 is not checked. [cyclic]
template <class Space>
Verdict judge_stopped(const typename Space::Point& measured, double limit) {
  if (!(limit > 0.0)) return {};
  typename Space::Levels most;
  most.fill(limit);
  return judge_lengths<Space>(Space::rates(measured), most, Status::kGoalVelocity);
}

}  // namespace tactus
