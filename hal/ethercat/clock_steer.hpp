// ClockSteer: keeps the moments at which frames are sent in step with the reference clock of the
// segment: a phase-locked loop over the reference time that comes back with every frame.
//
//   e_k = (t_k - t_0) mod T, from -T/2 to T/2        t_k: reference time of frame k, T: the period,
//                                                    t_0: that of the first, or given
//   correction_k = -(kp e_k + ki sum e)              added to the period until the next frame
#pragma once

#include <cstdint>

#include "hal/ethercat/reference_clock.hpp"

namespace tactus::ethercat {

class ClockSteer {
 public:
  static constexpr double kProportional = 0.05, kIntegral = 0.0005;
  /// Largest correction of a period, as a share of it: more than any two quartz clocks differ by.
  static constexpr double kMostShare = 0.02;

  /// Begins; the next frame gives the phase. [init]
  void start(std::int64_t period_ns) {
    period_ns_ = period_ns;
    known_ = false;
    sum_ns_ = 0.0;
    correction_ns_ = error_ns_ = 0;
  }
  /// Begins with a phase: frames are to be sent whole periods from `phase_ns`, t_0. [init]
  void start(std::int64_t period_ns, std::int64_t phase_ns) {
    start(period_ns);
    begin_ns_ = phase_ns;
    known_ = true;
  }
  /// Phase error of a frame by its reference time, ns. [cyclic]
  std::int64_t error_of(std::int64_t reference_ns) const {
    std::int64_t error = passed_between(begin_ns_, reference_ns) % period_ns_;
    if (error > period_ns_ / 2) error -= period_ns_;
    if (error < -period_ns_ / 2) error += period_ns_;
    return error;
  }
  /// Takes the reference time of a frame. [cyclic]
  void take(std::int64_t reference_ns) {
    if (!known_) begin_ns_ = reference_ns;
    known_ = true;
    const std::int64_t error = error_ns_ = error_of(reference_ns);
    const double most_ns = kMostShare * static_cast<double>(period_ns_);
    sum_ns_ = within(sum_ns_ + kIntegral * static_cast<double>(error), most_ns);
    const double whole_ns = kProportional * static_cast<double>(error) + sum_ns_;
    correction_ns_ = static_cast<std::int64_t>(-within(whole_ns, most_ns));
  }
  /// What to add to the period until the next frame, ns. [cyclic]
  std::int64_t correction() const { return correction_ns_; }
  /// The last phase error, ns. [any]
  std::int64_t error() const { return error_ns_; }

 private:
  static double within(double value, double most) {
    return value > most ? most : value < -most ? -most : value;
  }

  std::int64_t period_ns_ = 1, begin_ns_ = 0, correction_ns_ = 0, error_ns_ = 0;
  double sum_ns_ = 0.0;
  bool known_ = false;
};

}  // namespace tactus::ethercat
