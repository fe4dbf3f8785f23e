// The room of a waypoint: the largest square w of the rate r there from which the rest of the path
// can be passed within limits. Where a segment exceeds a limit at rate 1, w is bounded by
//
//   |p'| r <= v,  |p''| r^2 <= a,  |p'''| r^3 <= j
//
// and at an open end w is 0. The path is slowed down in time for both: along a segment of duration
// T w falls linearly from k to k + 1 with the slope u = dr/dt = -D, dw/ds = -2 D, and D is such
// that the acceleration limit is kept at every w up to w_k. With V the largest |p'| and Q the
// largest deceleration of the path itself, D = min (a - Q w_k) / V over the channels, so
//
//   w_k = min (V w_{k+1} + 2 T a) / (V + 2 T Q).
//
// When an open path grows, the values only rise. They are written from the end backwards, so that a
// cycle that reads a mixture of old and new values can keep them too.
#pragma once

#include "kernel/core/verdict.hpp"
#include "kernel/reference/motion/admission_settings.hpp"
#include "kernel/reference/motion/trajectory.hpp"
#include "kernel/reference/space/peaks.hpp"

namespace tactus {

/// Room of a segment by itself, 1 if it keeps the limits at rate 1; else `worst` is the limit it
/// exceeds most.
struct OwnRoom {
  double most = 1.0;
  Verdict worst;
};

/// Returns the room of a segment with these peaks. [any]
template <int n>
OwnRoom own_room(const MotionPeaks<n>& peaks, const MotionPeaks<n>& limits, int channel_size);

/// Sets the rooms of the waypoints after `first` up to `last`, which gets at most `end`, and
/// returns the room at `first`. Rooms before `fresh` may only rise: stops at the first that does
/// not, and returns 0. [any, not cyclic: proportional to its length]
template <class Space>
float set_rooms(const Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
                int first, int fresh, int last, double end);

/// Returns how much longer the path from `first` to `last` takes within its rooms, beginning with
/// the room `begin`, as a fraction: infinite if it cannot be passed. Counts the acceleration
/// limits, not the jerk limits. [any, not cyclic: proportional to its length]
template <class Space>
double stretch(const Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
               int first, int last, float begin);

}  // namespace tactus
