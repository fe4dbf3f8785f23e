// Checks of the [cia402] section that need the limits of the robot or compare one key with another.
// The loader checks the range of each key.
#pragma once

#include "hal/cia402/cia402_settings.hpp"
#include "hal/cia402/joint_units.hpp"
#include "kernel/core/joint_limits.hpp"

namespace tactus::cia402 {

/// Checks the keys of joint `j`, from 0, whose `units` were made from them. kMissingKey or
/// kBadValue for an impossible rated torque, direction, encoder, bit or homing method, and for a
/// torque limit of the joint that its drive cannot represent. `why` already begins with the joint
/// and gets key, value, limit and remedy. [init]
Status judge_drive(const Cia402Settings& settings, const JointLimits& limits,
                   const JointUnits& units, int j, Message& why);
/// Checks that arming cannot end during homing: kBadValue for a too short [executive] arming_ms.
/// [init]
Status judge_arming_time(const Cia402Settings& settings, int arming_ms, Message& why);

}  // namespace tactus::cia402
