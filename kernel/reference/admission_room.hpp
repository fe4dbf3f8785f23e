// The room of waypoints: the largest square w of the rate r there with which the rest of a path can
// be met. Where a segment passed at rate 1 takes more than a limit, w is bounded by
//
//   |p'| r <= v,  |p''| r^2 <= a,  |p'''| r^3 <= j
//
// and at an open end w is 0. Before either the path is slowed down in time: along a segment of
// length T w falls linearly from k to k + 1 with the slope u = dr/dt = -D, dw/ds = -2 D, and D is
// such that it keeps acceleration at every w up to w_k. With V the largest |p'| and Q the largest
// deceleration of the path itself, D = min (a - Q w_k) / V over the channels, so
//
//   w_k = min (V w_{k+1} + 2 T a) / (V + 2 T Q).
//
// When an open path grows the values only rise; they are written from the end backwards, so that
// any mixture of old and new ones that is read meanwhile can be met as well.
#pragma once

#include "kernel/reference/messages.hpp"
#include "kernel/reference/peaks.hpp"

namespace tactus {

/// Room on a segment of its own, 1 if it keeps `limits` at rate 1, and what it breaks most if not.
struct OwnRoom {
  double most = 1.0;
  Verdict worst;
};

/// [any]
template <int n>
OwnRoom own_room(const MotionPeaks<n>& peaks, const MotionPeaks<n>& limits, int channel_size);

/// Sets the rooms of the waypoints behind `first` up to `last`, which gets at most `end`; the room
/// at `first` is returned. Of those below `fresh` they may only rise: it stops at the first that
/// does not, and returns 0. [any, not cyclic: proportional to its length]
template <class Space>
float set_rooms(const Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
                int first, int fresh, int last, double end);

/// How much longer the way from `first` to `last` takes within the rooms, begun with `begin`, as a
/// fraction: infinite if it cannot be passed. Takes acceleration for granted, jerk not at all.
/// [any, not cyclic: proportional to its length]
template <class Space>
double stretch(const Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
               int first, int last, float begin);

}  // namespace tactus
