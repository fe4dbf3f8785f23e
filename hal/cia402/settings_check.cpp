#include "hal/cia402/settings_check.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace tactus::cia402 {
namespace {

constexpr int kFirstFreeBit = 7;  // of a statusword; the lower bits are the state
// Manufacturer-specific bits of a statusword (IEC 61800-7-201).
constexpr int kOwnBit = 8, kFirstOwnBit = 14;
constexpr auto kMostPermille = std::numeric_limits<std::int16_t>::max();

Status judge_torque(const Cia402Settings& settings, const JointLimits& limits,
                    const JointUnits& units, int j, Message& why) {
  if (!(units.rated_Nm > 0.0)) {
    why << "rated_torque is missing; it is 6076h of its drive, in N m";
    return Status::kMissingKey;
  }
  const int bit = settings.referenced_bit;
  if (bit >= 0 && bit < kFirstFreeBit) {
    why << "referenced_bit is " << bit << ", which is of the state; 7 to 15 or -1";
    return Status::kBadValue;
  }
  const double most_Nm = kMostPermille * units.torque_step();
  if (limits.tau_max[j] <= most_Nm) return Status::kOk;
  why << "rated_torque is " << units.rated_Nm << " N m, of which 32767 permille are " << most_Nm
      << " N m, less than the joint's torque limit of " << limits.tau_max[j]
      << " N m; the drive needs a larger one";
  return Status::kBadValue;
}

Status judge_position(const Cia402Settings& settings, const JointLimits& limits,
                      const JointUnits& units, int j, Message& why) {
  if (std::abs(units.direction) != 1.0) {
    why << "direction is " << units.direction << "; it must be 1 or -1";
    return Status::kBadValue;
  }
  if (settings.encoder == Encoder::kSingleTurn && std::floor(units.encoder) != units.encoder) {
    why << "increments is " << units.encoder << "; a single turn has a whole number of them";
    return Status::kBadValue;
  }
  const double turn_rad = units.encoder * units.angle_step();
  const double range_rad = limits.q_max[j] - limits.q_min[j];
  if (settings.encoder != Encoder::kSingleTurn || range_rad < turn_rad) return Status::kOk;
  why << "encoder = single_turn knows its place within a turn, " << turn_rad
      << " rad with gear_ratio " << units.gear << ", less than the range of the joint, "
      << range_rad << " rad; use multi_turn, or an encoder at the joint (gear_ratio 1)";
  return Status::kBadValue;
}

/// Without a bit that shows whether a drive is homed, every arming would move the arm.
Status judge_homing(const Cia402Settings& settings, int j, Message& why) {
  const double method = settings.homing_method[j];
  const int bit = settings.referenced_bit;
  if (method == 0.0) return Status::kOk;
  if (std::floor(method) != method) {
    why << "homing_method is " << method << "; methods (6098h) are whole numbers";
    return Status::kBadValue;
  }
  if (bit == kOwnBit || bit >= kFirstOwnBit) return Status::kOk;
  why << "homing_method is " << method << " with referenced_bit " << bit
      << "; a drive is homed only where a bit of its own, 8, 14 or 15, says whether it is";
  return Status::kBadValue;
}

}  // namespace

Status judge_drive(const Cia402Settings& settings, const JointLimits& limits,
                   const JointUnits& units, int j, Message& why) {
  TRY(judge_torque(settings, limits, units, j, why));
  TRY(judge_position(settings, limits, units, j, why));
  return judge_homing(settings, j, why);
}

Status judge_arming_time(const Cia402Settings& settings, int arming_ms, Message& why) {
  constexpr int kStates = 4;  // in which a drive may stay on the way up, besides fault
  const auto homed = static_cast<int>((settings.homing_method.array() != 0.0).count());
  const std::int64_t each_ms = std::int64_t{settings.homing_ms} + settings.step_ms;
  const std::int64_t least_ms =
      homed * each_ms + settings.reset_ms + kStates * settings.step_ms + settings.held_ms();
  if (homed == 0 || arming_ms >= least_ms) return Status::kOk;
  why = Message("[executive] arming_ms is ");
  why << arming_ms << ", less than the " << static_cast<std::size_t>(least_ms)
      << " ms that arming may take: [cia402] homing_ms, " << settings.homing_ms
      << ", and step_ms for " << homed << (homed == 1 ? " joint" : " joints")
      << " with a homing_method, and reset_ms, 4 step_ms, brake_ms and 100 ms of watching the hold";
  return Status::kBadValue;
}

}  // namespace tactus::cia402
