#include "gateway/verdict_text.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "kernel/core/types.hpp"
#include "kernel/reference/motion/admission.hpp"

namespace tactus {
namespace {

enum class Relation : std::uint8_t {
  kExceeds,    // a magnitude is above its limit
  kOutside,    // the limit is the end of a range that was left
  kNotFinite,  // the limit is not shown
  kNotZero,    // must be zero
  kTime,       // the limit is the earliest or the latest time
  kNotUpTo,    // the limit is the end of a range from 0 or, for a number of waypoints, 1
};

/// Value and limit of a verdict. The axis of `vector` statuses is the translation or the rotation
/// of the tip as a whole, of the others one direction.
struct Measured {
  Status status;
  Relation relation;
  bool vector;
  /// The unit of a translation is also that of a prismatic joint.
  const char *quantity, *joint_unit, *translation_unit, *rotation_unit;

  const char* unit(VerdictAxes axes, int axis) const {
    if (axes == VerdictAxes::kTip) return axis < 3 ? translation_unit : rotation_unit;
    return axis >= 0 && is_prismatic<Robot>(axis) ? translation_unit : joint_unit;
  }
};

/// A position that is this far beyond its range is one in degrees, or in millimetres.
constexpr double kFarBeyond = 6.28;

const char* remedy_of_position(const Verdict& verdict) {
  if (!(std::abs(verdict.value - verdict.limit) > kFarBeyond))
    return "; keep within the range of the joint";
  return verdict.axis >= 0 && is_prismatic<Robot>(verdict.axis)
             ? "; keep within the range of the joint: are these millimetres?"
             : "; keep within the range of the joint: are these degrees?";
}

constexpr Relation kExceeds = Relation::kExceeds, kOutside = Relation::kOutside;

// clang-format off
constexpr Measured kMeasured[] = {
    {Status::kReferenceSize, Relation::kNotUpTo, true, "number of waypoints", "", "", ""},
    {Status::kReferenceNotFinite, Relation::kNotFinite, false, "value", "", "", ""},
    {Status::kPositionLimit, kOutside, false, "position", " rad", " m", " rad"},
    {Status::kReferenceTime, Relation::kTime, true, "time", " s", " s", " s"},
    {Status::kVelocityLimit, kExceeds, true, "velocity", " rad/s", " m/s", " rad/s"},
    {Status::kAccelerationLimit, kExceeds, true, "acceleration", " rad/s^2", " m/s^2", " rad/s^2"},
    {Status::kEffortLimit, kExceeds, true, "effort", " N m", " N", " N m"},
    {Status::kNotAtRest, Relation::kNotZero, false, "velocity", " rad/s", " m/s", " rad/s"},
    {Status::kStartTolerance, kExceeds, true, "distance from the reference", " rad", " m", " rad"},
    {Status::kJerkLimit, kExceeds, true, "jerk", " rad/s^3", " m/s^3", " rad/s^3"},
    {Status::kVelocityStep, kExceeds, true, "velocity step", " rad/s", " m/s", " rad/s"},
    {Status::kQuaternion, kOutside, true, "length of the quaternion", "", "", ""},
    {Status::kWorkspace, kOutside, false, "position", " rad", " m", " rad"},
    {Status::kPathTolerance, kExceeds, true, "path error", " rad", " m", " rad"},
    {Status::kGoalTolerance, kExceeds, true, "position error", " rad", " m", " rad"},
    {Status::kGoalVelocity, kExceeds, true, "velocity", " rad/s", " m/s", " rad/s"},
    {Status::kBadOverride, Relation::kNotUpTo, true, "override", "", "", ""},
    {Status::kStateNotFinite, Relation::kNotFinite, false, "measured value", "", "", ""},
    {Status::kCommandNotFinite, Relation::kNotFinite, false, "command", "", "", ""},
    {Status::kMeasuredPositionLimit, kOutside, false, "measured position", " rad", " m", ""},
    {Status::kMeasuredVelocityLimit, kExceeds, false, "measured velocity", " rad/s", " m/s", ""},
    {Status::kFollowingError, kExceeds, false, "following error", " rad", " m", ""},
    {Status::kChunkLate, kExceeds, true, "delay behind the last target", " s", " s", " s"},
    {Status::kPointStep, kExceeds, true, "distance from the reference", " rad", " m", " rad"},
    {Status::kSaturated, kOutside, false, "position", " rad", " m", " rad"},
    {Status::kStampRange, kExceeds, true, "distance from the present time", " s", " s", " s"},
};
// clang-format on

constexpr std::array<const char*, 6> kDirections = {"x",          "y",          "z",
                                                    "rotation x", "rotation y", "rotation z"};

/// Null if the verdict has no value, or none that its status explains.
const Measured* find(const Verdict& verdict) {
  const bool valued = verdict.axis >= 0 || verdict.value != 0.0 || verdict.limit != 0.0;
  for (const Measured& entry : kMeasured) {
    if (valued && entry.status == verdict.status) return &entry;
  }
  return nullptr;
}

/// Value and limit, with more digits where seven do not tell them apart.
struct Numbers {
  std::array<char, 32> value, limit;

  explicit Numbers(const Verdict& verdict) {
    write(verdict, 7);
    if (std::string_view(value.data()) == limit.data()) write(verdict, 12);
  }
  void write(const Verdict& verdict, int digits) {
    std::snprintf(value.data(), value.size(), "%.*g", digits, verdict.value);
    std::snprintf(limit.data(), limit.size(), "%.*g", digits, verdict.limit);
    if (std::isnan(verdict.value)) std::snprintf(value.data(), value.size(), "nan");  // or "-nan"
  }
};

void add_waypoint(Message& text, int waypoint, double time_s) {
  std::array<char, 48> time{};
  if (std::isfinite(time_s)) std::snprintf(time.data(), time.size(), " (t = %.6g s)", time_s);
  text << "waypoint " << waypoint + 1 << time.data();
}

/// A quaternion that is not finite has axis 3, as all of a rotation.
void add_axis(Message& text, const Verdict& verdict, const Measured& measured, VerdictAxes axes) {
  const auto index = static_cast<std::size_t>(verdict.axis);
  const bool quaternion = verdict.status == Status::kReferenceNotFinite && index == 3;
  if (axes == VerdictAxes::kJoints)
    text << "joint " << verdict.axis + 1 << " (" << Robot::kJointNames[index] << ")";
  else if (measured.vector || quaternion)
    text << (index < 3 ? "translation" : "rotation");
  else
    text << kDirections[index];
}

void add_numbers(Message& text, const Verdict& verdict, const Measured& measured,
                 const char* unit) {
  const Numbers numbers(verdict);
  const char* const limit = numbers.limit.data();
  text << measured.quantity << " " << numbers.value.data() << unit;
  switch (measured.relation) {
    case Relation::kExceeds: text << " exceeds " << limit << unit; break;
    case Relation::kOutside:
      text << (verdict.value < verdict.limit ? " is below " : " exceeds ") << limit << unit;
      break;
    case Relation::kNotFinite: text << " is not finite"; break;
    case Relation::kNotZero: text << " is not zero"; break;
    case Relation::kTime:
      text << (verdict.value < verdict.limit ? " is earlier than " : " is later than ") << limit
           << unit;
      break;
    case Relation::kNotUpTo:
      text << " is not from " << (verdict.status == Status::kReferenceSize ? "1" : "0") << " to "
           << limit;
      break;
  }
}

/// Remedy for the times of waypoints or of chunk targets.
const char* remedy_of_time(const Verdict& verdict) {
  if (verdict.waypoint < 0) return "";
  if (verdict.limit == kLongestTrajectory_s)
    return "; subtract the first time from all: is it a date?";
  if (verdict.value > verdict.limit) return "; leave out what is farther ahead";
  if (verdict.waypoint == 0) return "; begin at t = 0 or later";
  return "; give each a later time than the one before: sort them, leave out what is double";
}

Message& add_code(Message& text, Status status) {
  return text << " (" << static_cast<int>(status) << ")";
}

}  // namespace

const char* remedy(const Verdict& verdict) {
  switch (verdict.status) {
    case Status::kPositionLimit: return remedy_of_position(verdict);
    case Status::kSaturated: return ": the reference stays there until points come back";
    case Status::kPointStep: return "; begin nearer to it, or raise max_step";
    case Status::kCannotLeave: return "; send it again a little later";
    case Status::kWorkspace: return "; keep within [task_limits]: are these millimetres?";
    case Status::kReferenceTime: return remedy_of_time(verdict);
    case Status::kVelocityLimit:
    case Status::kAccelerationLimit:
    case Status::kJerkLimit: return "; give this part more time";
    case Status::kVelocityStep:
      return "; give velocities, this part more time, or interpolation = monotone";
    case Status::kNotAtRest: return "; end with a velocity of zero";
    case Status::kStartTolerance: return "; begin there, or later than at t = 0";
    case Status::kEffortLimit: return "; ask for less";
    case Status::kQuaternion: return "; write qw, qx, qy, qz of length 1";
    case Status::kNotOwner: return "; ask for the lease first";
    case Status::kStampRange: return "; name times of the server's clock, State.server_ns";
    case Status::kChunkLate: return "; send sooner, or targets farther ahead";
    case Status::kPaused: return "; send Resume";
    case Status::kEpochVoid: return "; look at the robot, then begin a newer epoch";
    default: return "";
  }
}

Message describe(Status status) {
  Message text(meaning(status));
  return add_code(text, status);
}

Message goal_remedy(Status status, VerdictAxes axes, bool law) {
  const bool joints = axes == VerdictAxes::kJoints;
  Message text;
  switch (status) {
    case Status::kPathTolerance:
      text << "give the trajectory more time, "
           << (law ? "raise the gains of the law, or " : "or raise ");
      return text << (joints ? "path_tolerance"
                             : "path_position_tolerance and path_angle_tolerance");
    case Status::kGoalTolerance:
      text << "raise " << (law ? "the gains of the law, " : "")
           << (joints ? "goal_tolerance or"
                      : "goal_position_tolerance and goal_angle_tolerance, or")
           << " goal_time_s";
      if (law) text << "; an arm that sags has another tool or mounting than [robot] says";
      return text;
    case Status::kGoalVelocity:
      return text << "raise " << (law ? "the damping of the law, " : "")
                  << "stopped_velocity or goal_time_s";
    default: return text;
  }
}

Message describe(const Verdict& verdict, VerdictAxes axes, double time_s) {
  const Measured* const measured = find(verdict);
  Message text;
  if (verdict.waypoint >= 0) add_waypoint(text, verdict.waypoint, time_s);
  if (measured != nullptr && verdict.axis >= 0) {
    if (!text.empty()) text << ", ";
    add_axis(text, verdict, *measured, axes);
  }
  if (!text.empty()) text << ": ";
  if (measured == nullptr) {
    text << describe(verdict.status);
    return text;
  }
  add_numbers(text, verdict, *measured, measured->unit(axes, verdict.axis));
  return add_code(text, verdict.status);
}

}  // namespace tactus
