#include "hal/cia402/drive_facts.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "hal/cia402/hex.hpp"
#include "kernel/core/joint_limits.hpp"

namespace tactus::cia402 {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kEqual = 1e-9;  // of what is compared, relatively

// Units of 60A8h and 60A9h (CiA 303-2): exponent of ten, numerator, denominator, from the highest
// byte on. The table of angles is that of Nanotec's PD4-C, "User-defined units".
constexpr std::uint8_t kNoUnit = 0x00, kIncrement = 0xB5;
constexpr std::uint8_t kSecond = 0x03, kMinute = 0x47;

struct Angle {
  std::uint8_t code;
  double per_turn;
};
constexpr Angle kAngles[] = {{0x10, 6.283185307179586}, {0x40, 400.0},     {0x41, 360.0},
                             {0x42, 21600.0},           {0x43, 1296000.0}, {0xB4, 1.0}};

std::uint8_t byte_of(std::uint32_t unit, int place) {
  return static_cast<std::uint8_t>(unit >> 8 * place);
}

/// Units of the exponent in one without it; NaN for an exponent that no drive counts in.
double per_unit(std::uint32_t unit) {
  constexpr int kMost = 12;
  const int byte = byte_of(unit, 3), exponent = byte < 128 ? byte : byte - 256;
  if (std::abs(exponent) > kMost) return kNotKnown;
  double power = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 10.0;
  return exponent > 0 ? 1.0 / power : power;
}

/// NaN is not near.
bool near(double value, double expected) {
  return std::abs(value - expected) <= kEqual * std::abs(expected);
}

}  // namespace

/// The quotient of two facts that the drive has, or NaN; 1 where it has neither.
double DriveFacts::ratio(const Object& above, const Object& below) const {
  if (!has(above) && !has(below)) return 1.0;
  const double denominator = has(below) ? get(below) : 1.0;
  return has(above) && denominator > 0.0 ? get(above) / denominator : kNotKnown;
}

/// Units of a numerator in a revolution of the motor; NaN for what is no angle. `increments` are
/// those of the file, for a drive that does not say its own.
double DriveFacts::of_turn(std::uint32_t unit, double increments) const {
  const double shaft = 1.0 / ratio(kGearMotorTurns, kGearShaftTurns);
  const std::uint8_t code = byte_of(unit, 2);
  if (has(kEncoderIncrements)) increments = ratio(kEncoderIncrements, kEncoderRevolutions);
  if (code == kIncrement) return per_unit(unit) * increments;
  if (code == kNoUnit)
    return has(kFeedConstant) ? per_unit(unit) * shaft * ratio(kFeedConstant, kFeedTurns)
                              : per_unit(unit) * increments;
  for (const Angle& angle : kAngles)
    if (angle.code == code) return per_unit(unit) * shaft * angle.per_turn;
  return kNotKnown;
}

double DriveFacts::position_units(double increments) const {
  return of_turn(has(kPositionUnit) ? get(kPositionUnit) : 0, increments);
}

/// Units of velocity per motor revolution per second as 60A9h has them; NaN: it does not say.
double DriveFacts::reported_velocity_units(double increments) const {
  if (!has(kVelocityUnit)) return kNotKnown;
  const std::uint32_t unit = get(kVelocityUnit);
  const bool positions = byte_of(unit, 2) == kNoUnit && has(kPositionUnit);
  const double numerator =
      positions ? per_unit(unit) * position_units(increments) : of_turn(unit, increments);
  switch (byte_of(unit, 1)) {
    case kSecond: return numerator;
    case kMinute: return 60.0 * numerator;
    default: return kNotKnown;
  }
}

Message unstated(const Cia402Settings& drive, const StartupFindings& findings) {
  Message line;
  const bool reported = (findings.serials.array() > 0.0).all();
  if (!reported || (drive.serial.array() > 0.0).all()) return line;
  line << "[cia402] serial =";
  for (const double serial : findings.serials) line << " " << static_cast<std::size_t>(serial);
  return line;
}

Status DriveFacts::judge(const Cia402Settings& drive, int joint, bool velocities,
                         StartupFindings& findings, Message& why) const {
  TRY(judge_torque(drive, joint, why));
  TRY(judge_positions(drive, joint, why));
  const double stated = drive.velocity_units[joint];
  const double reported = reported_velocity_units(drive.increments[joint]);
  findings.velocity_units[joint] = stated > 0.0 ? stated : reported;
  return velocities ? judge_velocities(stated, reported, why) : Status::kOk;
}

/// `stated`: by the file, or 0; `reported`: by the drive, or NaN.
Status DriveFacts::judge_velocities(double stated, double reported, Message& why) const {
  const bool scaled = !near(ratio(kVelocityFactor, kVelocityDivisor), 1.0);
  if (stated == 0.0 && !scaled && !std::isnan(reported)) return Status::kOk;
  if (stated > 0.0 && (std::isnan(reported) || near(reported, stated))) return Status::kOk;
  if (stated > 0.0) {
    why << "its velocities have " << reported << " units per motor revolution per second (60A9h is "
        << hex(get(kVelocityUnit)) << "), [cia402] velocity_units is " << stated
        << "; correct the file, or the drive";
    return Status::kRefusedByRobot;
  }
  why << "the unit of its velocities is not known: ";
  if (has(kVelocityUnit))
    why << "60A9h is " << hex(get(kVelocityUnit));
  else
    why << "it has no 60A9h";
  if (scaled) why << ", and its velocity factor, 6096h, is not 1";
  why << "; see 606Ch in its manual and add to [cia402]: velocity_units, in a motor revolution per "
         "second: 60 for rev/min, the increments for increments/s";
  return Status::kRefusedByRobot;
}

/// Drives of one kind differ in nothing else, and a joint must not move for another.
Status DriveFacts::judge_identity(const Cia402Settings& drive, int joint, StartupFindings& findings,
                                  Message& why) const {
  findings.serials[joint] = get(kSerialNumber);
  const double stated = drive.serial[joint];
  if (stated == 0.0 || (has(kSerialNumber) && get(kSerialNumber) == stated)) return Status::kOk;
  why << "its serial number (1018h:4) is ";
  if (has(kSerialNumber))
    why << std::size_t{get(kSerialNumber)};
  else
    why << "not told";
  why << ", [cia402] serial is ";
  why << stated
      << "; it is the drive of another joint, or a new one: look at the cabling, then correct the "
         "file";
  return Status::kRefusedByRobot;
}

/// Only an exact match runs: a factor of a thousand in the torque must not be found by the arm.
Status DriveFacts::judge_torque(const Cia402Settings& drive, int joint, Message& why) const {
  const auto rated_mNm = static_cast<std::uint32_t>(drive.rated_torque[joint] * 1000.0 + 0.5);
  if (has(kRatedTorque) && get(kRatedTorque) != rated_mNm) {
    why << "rated torque in mN m (6076h:0) is " << std::size_t{get(kRatedTorque)} << ", expected "
        << std::size_t{rated_mNm} << "; correct [cia402] rated_torque, or the drive";
    return Status::kRefusedByRobot;
  }
  const double step_Nm = 1e-3 * drive.rated_torque[joint] * drive.gear_ratio[joint];
  const double stated_Nm = drive.torque_limit[joint];
  const double needed_Nm = stated_Nm > 0.0 ? stated_Nm : JointLimits{}.tau_max[joint];
  const double most_Nm = get(kMaxTorque) * step_Nm;
  // To the drive's nearest step.
  if (!has(kMaxTorque) || most_Nm + 0.5 * step_Nm >= needed_Nm) return Status::kOk;
  why << "its own torque limit (6072h:0) is " << std::size_t{get(kMaxTorque)}
      << " permille of the rated torque, " << most_Nm << " N m at the joint, less than "
      << needed_Nm << " N m, "
      << (stated_Nm > 0.0 ? "[cia402] torque_limit; correct the file, or the drive"
                          : "the limit of the joint; raise it in the drive");
  if (stated_Nm == 0.0 && most_Nm > 0.0)
    why << ", or say in [cia402] torque_limit what the drive may give";
  return Status::kRefusedByRobot;
}

Status DriveFacts::judge_positions(const Cia402Settings& drive, int joint, Message& why) const {
  const double expected = drive.increments[joint], reported = position_units(expected);
  if (near(reported, expected)) return Status::kOk;
  why << "its positions have ";
  if (std::isnan(reported))
    why << "units that are not known";
  else
    why << reported << " units per motor revolution";
  const char* between = " (";
  for (const auto& [above, below] :
       {std::pair(kEncoderIncrements, kEncoderRevolutions),
        std::pair(kGearMotorTurns, kGearShaftTurns), std::pair(kFeedConstant, kFeedTurns)}) {
    if (!has(above)) continue;
    why << between << hex(above.index) << " is " << std::size_t{get(above)} << ":"
        << std::size_t{get(below)};
    between = ", ";
  }
  if (has(kPositionUnit)) why << between << "60A8h is " << hex(get(kPositionUnit));
  why << "), [cia402] increments is " << expected << "; correct the file, or the drive";
  return Status::kRefusedByRobot;
}

}  // namespace tactus::cia402
