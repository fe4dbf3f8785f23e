// Drives: their settings, and which of them cannot be.
#include "hal/cia402/drives.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::cia402 {
namespace {

constexpr int kFirstFreeBit = 7;  // of a statusword, beyond those of the state
// Bits of a statusword that are the manufacturer's (IEC 61800-7-201): the others say something
// else.
constexpr int kOwnBit = 8, kFirstOwnBit = 14;
constexpr auto kMostPermille = std::numeric_limits<std::int16_t>::max();

}  // namespace

Status Drives::configure(const Cia402Settings& settings, const Tool& tool, int period_us,
                         int arming_ms, Message& why) {
  settings_ = &settings;
  period_s_ = 1e-6 * period_us;
  most_rise_ = static_cast<int>((std::int64_t{1000} * arming_ms + period_us - 1) / period_us);
  hold_.configure(settings, tool, period_s_);
  const DriveTimes times = {settings.step_ms * kMillisecond_ns, settings.reset_ms * kMillisecond_ns,
                            settings.stop_ms * kMillisecond_ns};
  for (int j = 0; j < kDof; ++j) {
    Joint& joint = joints_[static_cast<std::size_t>(j)];
    joint.units = {settings.increments[j], settings.gear_ratio[j], settings.rated_torque[j],
                   settings.direction[j], settings.position_offset[j]};
    joint.machine.configure(times);
    why = joint_text(j);
    why << ": [cia402] ";
    TRY(judge_torque(j, why));
    TRY(judge_position(j, why));
    TRY(judge_homing(j, why));
  }
  TRY(judge_arming_time(arming_ms, why));
  why = Message("[robot] period_us is ");
  if (period_object(period_us).value == 0) {
    why << period_us << ", which a drive cannot be told: 60C2h takes a whole number up to 255 of "
        << "1 ms, 100 us, 10 us or 1 us";
    return Status::kBadValue;
  }
  why = {};
  return Status::kOk;
}

void Drives::set_velocity_units(const JointVector& units) {
  for (int j = 0; j < kDof; ++j)
    if (units[j] > 0.0) joints_[static_cast<std::size_t>(j)].units.speed = units[j];
}

Status Drives::judge_torque(int j, Message& why) const {
  const JointUnits& units = joints_[static_cast<std::size_t>(j)].units;
  if (!(units.rated_Nm > 0.0)) {
    why << "rated_torque is missing; it is 6076h of its drive, in N m";
    return Status::kMissingKey;
  }
  const int bit = settings_->referenced_bit;
  if (bit >= 0 && bit < kFirstFreeBit) {
    why << "referenced_bit is " << bit << ", which is of the state; 7 to 15 or -1";
    return Status::kBadValue;
  }
  const double most_Nm = kMostPermille * units.torque_step();
  if (limits_.tau_max[j] <= most_Nm) return Status::kOk;
  why << "rated_torque is " << units.rated_Nm << " N m, of which 32767 permille are " << most_Nm
      << " N m, less than the joint's torque limit of " << limits_.tau_max[j]
      << " N m; the drive needs a larger one";
  return Status::kBadValue;
}

Status Drives::judge_position(int j, Message& why) const {
  const JointUnits& units = joints_[static_cast<std::size_t>(j)].units;
  if (std::abs(units.direction) != 1.0) {
    why << "direction is " << units.direction << "; it must be 1 or -1";
    return Status::kBadValue;
  }
  if (settings_->encoder == Encoder::kSingleTurn && std::floor(units.encoder) != units.encoder) {
    why << "increments is " << units.encoder << "; a single turn has a whole number of them";
    return Status::kBadValue;
  }
  const double turn_rad = units.encoder * units.angle_step();
  const double range_rad = limits_.q_max[j] - limits_.q_min[j];
  if (settings_->encoder != Encoder::kSingleTurn || range_rad < turn_rad) return Status::kOk;
  why << "encoder = single_turn knows its place within a turn, " << turn_rad
      << " rad with gear_ratio " << units.gear << ", less than the range of the joint, "
      << range_rad << " rad; use multi_turn, or an encoder at the joint (gear_ratio 1)";
  return Status::kBadValue;
}

/// Without a bit that says whether a drive is homed, every arming would move the arm.
Status Drives::judge_homing(int j, Message& why) const {
  const double method = settings_->homing_method[j];
  const int bit = settings_->referenced_bit;
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

/// The time of an arming must not end in the midst of homing.
Status Drives::judge_arming_time(int arming_ms, Message& why) const {
  constexpr int kStates = 4;  // that a drive may stay in on the way up, beside a fault
  const auto homed = static_cast<int>((settings_->homing_method.array() != 0.0).count());
  const std::int64_t each_ms = std::int64_t{settings_->homing_ms} + settings_->step_ms;
  const std::int64_t least_ms =
      homed * each_ms + settings_->reset_ms + kStates * settings_->step_ms + settings_->held_ms();
  if (homed == 0 || arming_ms >= least_ms) return Status::kOk;
  why = Message("[executive] arming_ms is ");
  why << arming_ms << ", less than the " << static_cast<std::size_t>(least_ms)
      << " ms that arming may take: [cia402] homing_ms, " << settings_->homing_ms
      << ", and step_ms for " << homed << (homed == 1 ? " joint" : " joints")
      << " with a homing_method, and reset_ms, 4 step_ms, brake_ms and 100 ms of watching the hold";
  return Status::kBadValue;
}

}  // namespace tactus::cia402
