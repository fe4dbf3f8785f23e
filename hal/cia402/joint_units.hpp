// JointUnits: converts between the numbers of a drive and SI units at the joint.
//
//   q   = direction * 2 pi * increments / (encoder * gear) + offset
//   dq  = direction * 2 pi * velocity / (speed * gear)
//   tau = direction * permille / 1000 * rated * gear
//
// Torque is a 16-bit number of thousandths of the rated torque, 6076h (CiA 402): the smaller the
// rated torque, the finer the step, and the smaller the largest torque, 32.767 times the rated one.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace tactus::cia402 {

struct JointUnits {
  double encoder = 16777216.0;  ///< increments per revolution of the motor
  double gear = 1.0;            ///< revolutions of the motor per revolution of the joint
  double rated_Nm = 1.0;        ///< rated torque of the motor, 6076h
  double direction = 1.0;       ///< +1 or -1
  double offset_rad = 0.0;      ///< q where the drive counts zero
  double speed = encoder;       ///< units of velocity per revolution of the motor per second

  /// Angle of an increment at the joint, rad. [any]
  double angle_step() const { return kTurn_rad / (encoder * gear); }
  /// Velocity of a unit at the joint, rad/s. [any]
  double speed_step() const { return kTurn_rad / (speed * gear); }
  /// Torque of a permille at the joint, N m. [any]
  double torque_step() const { return 1e-3 * rated_Nm * gear; }

  double q(std::int64_t increments) const {
    return direction * static_cast<double>(increments) * angle_step() + offset_rad;
  }
  double dq(std::int32_t units) const { return direction * units * speed_step(); }
  double tau(std::int16_t permille) const { return direction * permille * torque_step(); }

  /// The nearest number of the drive, kept within its range; 0 for NaN. A position beyond the range
  /// wraps, as the counter of the drive does. [cyclic]
  std::int32_t position(double q_rad) const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(
        nearest<std::int64_t>(direction * (q_rad - offset_rad) / angle_step())));
  }
  std::int32_t velocity(double dq_rad_s) const {
    return nearest<std::int32_t>(direction * dq_rad_s / speed_step());
  }
  std::int16_t torque(double tau_Nm) const {
    return nearest<std::int16_t>(direction * tau_Nm / torque_step());
  }

 private:
  static constexpr double kTurn_rad = 6.283185307179586;

  template <class Int>
  static Int nearest(double value) {
    // For 64-bit numbers, a double safely below the end of the range.
    constexpr double kMost =
        sizeof(Int) == 8 ? 9.2e18 : static_cast<double>(std::numeric_limits<Int>::max());
    if (!(value < kMost)) return value >= kMost ? static_cast<Int>(kMost) : Int{0};
    return value > -kMost ? static_cast<Int>(std::floor(value + 0.5)) : static_cast<Int>(-kMost);
  }
};

/// A drive's 32-bit position counter, followed beyond its end.
class PositionCounter {
 public:
  /// Begins at a count; `added` increments are added to it. `turn`: after as many increments the
  /// drive may count from the beginning again, as it does after 2^32. [init]
  void start(std::int32_t count, std::int64_t added = 0, std::int64_t turn = kNever) {
    last_ = count;
    total_ = count + added;
    turn_ = turn;
  }
  /// Takes a new count, less than half a turn, and half the counter's range, away from the last.
  /// [cyclic]
  std::int64_t follow(std::int32_t count) {
    const auto wrapped = static_cast<std::uint32_t>(count) - static_cast<std::uint32_t>(last_);
    const std::int64_t change = static_cast<std::int32_t>(wrapped);
    total_ += change;
    if (std::abs(change) > turn_ / 2) total_ += change > 0 ? -turn_ : turn_;
    last_ = count;
    return total_;
  }
  std::int64_t total() const { return total_; }
  /// Present correction added to the drive's count. [cyclic]
  std::int64_t added() const { return total_ - last_; }

 private:
  static constexpr std::int64_t kNever = std::int64_t{1} << 33;

  std::int32_t last_ = 0;
  std::int64_t total_ = 0, turn_ = kNever;
};

}  // namespace tactus::cia402
