// FeedbackWatch: whether what the drive of one joint measures can be true: a position does not
// jump, and a velocity is the rate of the positions. It compares what the velocity adds up to with
// what the positions do, both forgotten with a time constant of 50 ms, so that neither a sign nor a
// unit nor an encoder that stands still can be wrong while the joint moves. An encoder that stands
// still together with its velocity cannot be distinguished from a joint that does.
#pragma once

#include <cmath>

namespace tactus::cia402 {

class FeedbackWatch {
 public:
  /// A position may change by this many times what the joint can move at most: a sample may be a
  /// cycle late and the next one early.
  static constexpr double kJump = 2.0;
  static constexpr double kMemory_s = 0.05;
  static constexpr double kLeast_rad = 0.01;  ///< of a contradiction: a filter's delay, noise
  static constexpr double kShare = 0.25;      ///< of the way, in addition

  /// Restarts, at rest. [init, cyclic]
  void start() { change_ = most_ = by_dq_ = by_q_ = way_ = 0.0; }
  /// Takes a sample: the change of position since the last, rad, the time between them, s, and the
  /// largest velocity of the joint, rad/s. [cyclic]
  void moved(double change, double elapsed_s, double period_s, double dq_max) {
    change_ = change;
    most_ = kJump * dq_max * (elapsed_s + period_s);
  }
  /// Takes the velocity of the sample in addition, where the drive measures it. [cyclic]
  void measured(double dq, double elapsed_s) {
    const double kept = kMemory_s / (kMemory_s + elapsed_s);
    by_dq_ = kept * (by_dq_ + dq * elapsed_s);
    by_q_ = kept * (by_q_ + change_);
    way_ = kept * (way_ + std::abs(dq) * elapsed_s + std::abs(change_));
  }

  bool jumps() const { return !(std::abs(change_) <= most_); }
  bool contradicts() const { return !(std::abs(by_dq_ - by_q_) <= kLeast_rad + kShare * way_); }
  double change() const { return change_; }  ///< of the last sample, rad
  double most() const { return most_; }      ///< of a change, rad
  double by_velocity() const { return by_dq_; }
  double by_positions() const { return by_q_; }

 private:
  double change_ = 0.0, most_ = 0.0;
  double by_dq_ = 0.0, by_q_ = 0.0, way_ = 0.0;  // rad
};

}  // namespace tactus::cia402
