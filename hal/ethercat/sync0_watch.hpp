// Sync0Watch: how long before SYNC0 the frames of the cycles pass the first slave, by its clock,
// and how many pulses of SYNC0 have passed without a new frame: a drive then follows old outputs.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hal/ethercat/reference_clock.hpp"

namespace tactus::ethercat {

class Sync0Watch {
 public:
  /// SYNC0 comes `shift_ns` after moments that are whole periods from `phase_ns`, first, of the
  /// slave that was started last, at `first_ns`. [init]
  void start(std::int64_t period_ns, std::int64_t phase_ns, std::int64_t shift_ns,
             std::int64_t first_ns) {
    *this = {};
    period_ns_ = period_ns;
    phase_ns_ = phase_ns;
    shift_ns_ = shift_ns;
    first_ns_ = first_ns;
  }
  /// A frame was sent, whether it comes back or not. [cyclic]
  void count_frame() { ++frames_; }
  /// Takes the reference time at which the last frame passed. [cyclic]
  void take(std::int64_t reference_ns) {
    if (passed_between(first_ns_, reference_ns) < 0) return;
    const std::int64_t since = passed_between(phase_ns_, reference_ns) - shift_ns_;
    const std::int64_t rest = since % period_ns_;
    const std::int64_t passed_ns = rest < 0 ? rest + period_ns_ : rest;  // since the last pulse
    const std::int64_t pulse = (since - passed_ns) / period_ns_;
    least_ns_ = std::min(least_ns_, period_ns_ - passed_ns);
    most_ns_ = std::max(most_ns_, period_ns_ - passed_ns);
    if (known_) without_frame_ += std::max(pulse - pulse_ - frames_, std::int64_t{0});
    known_ = true;
    pulse_ = pulse;
    frames_ = 0;
  }
  /// True if the times below are known. [any]
  bool known() const { return known_; }
  /// Least and largest time from a frame to the next SYNC0, ns. [any]
  std::int64_t least_ns() const { return least_ns_; }
  std::int64_t most_ns() const { return most_ns_; }
  /// Pulses before which no new frame had passed since the one before. [any]
  std::int64_t without_frame() const { return without_frame_; }

 private:
  std::int64_t period_ns_ = 1, phase_ns_ = 0, shift_ns_ = 0, first_ns_ = 0;
  std::int64_t least_ns_ = INT64_MAX, most_ns_ = 0;
  std::int64_t pulse_ = 0, frames_ = 0;  // the last pulse before a frame, and frames since that one
  std::int64_t without_frame_ = 0;
  bool known_ = false;
};

}  // namespace tactus::ethercat
