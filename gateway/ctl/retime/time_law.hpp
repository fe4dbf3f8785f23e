// TimeLaw: how far along a path a motion is at a time: as fast as the nodes say, or smoothed, so
// that the acceleration along the path does not step.
//
// Smoothing is a moving average of s(t) over a window of the form of a trapezoid: that of two boxes
// of widths T and T/4, one after the other. Where q' is constant, an acceleration that steps by 2 a
// then changes at 2 a / T. The path itself is not changed, and the motion takes 5/4 T longer.
#pragma once

#include <vector>

#include "gateway/ctl/retime/reachability.hpp"

namespace tactus::ctl {

struct Progress {
  double s = 0.0, ds = 0.0, dds = 0.0;
};

class TimeLaw {
 public:
  /// `smoothing_s`: T > 0. The nodes must outlive the law. [any]
  TimeLaw(const std::vector<PathNode>& nodes, double smoothing_s);

  /// Time from when a place is reached at the earliest to when it is at the latest. [any]
  double window_s() const { return 2.0 * reach_s_; }
  double duration_s() const { return nodes_.back().time_s + 2.0 * reach_s_; }
  /// Returns the progress at a time from 0 to the duration. [any]
  Progress at(double time_s) const;

 private:
  using Node = std::vector<PathNode>::const_iterator;

  /// Returns the first node that is passed later.
  Node after(double time_s) const;
  /// Returns the progress, not smoothed, at a time between the node before `next` and `next`.
  Progress fastest(Node next, double time_s) const;
  double weight(double lag_s) const;

  const std::vector<PathNode>& nodes_;
  double flat_s_, reach_s_;  // half of the window's top, and of the whole window
};

/// Returns the place of a path and its derivatives by time. [any]
TimedPoint moved(const std::vector<PathNode>& nodes, const Progress& progress, double time_s);

}  // namespace tactus::ctl
