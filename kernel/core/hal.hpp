// Hal: the only interface to the robot, in SI units: a statement of what the robot offers, a wire
// that is opened and closed, and one exchange per cycle. The exchange continues in every rung:
// drives are armed, stopped and watched by it, and many need it while they are disabled.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/core/clock.hpp"
#include "kernel/core/digital_outputs.hpp"
#include "kernel/core/drive.hpp"
#include "kernel/core/streams.hpp"
#include "kernel/core/text.hpp"
#include "kernel/core/types.hpp"

namespace tactus {

/// Quantity in which the drives are commanded. A pipeline commands exactly one of these.
enum class CommandMode : std::uint8_t { kPosition, kVelocity, kEffort };

using Drives = std::array<Drive, kDof>;

/// Newest state of the robot at the start of a cycle.
struct RobotState {
  JointVector q = JointVector::Zero();    ///< rad
  JointVector dq = JointVector::Zero();   ///< rad/s
  JointVector tau = JointVector::Zero();  ///< N m, exerted by the actuators
  Vector6 ft = Vector6::Zero();  ///< N, N m: exerted by environment and tool on a sensor at the
                                 ///< flange, at its origin and in its axes; zero without a sensor
  double speed_scaling = 1.0;    ///< share of the commanded speed that the robot executes: 0
                                 ///< stopped, 1 unchanged
  std::int64_t stamp_ns = 0;     ///< when it was sampled, by the clock of the cycles
  Drives drives;

  /// True if q, dq and tau are; blocks judge what their sensors measure. [any]
  bool finite() const { return q.allFinite() && dq.allFinite() && tau.allFinite(); }
};

/// Command sent at the end of a cycle. The value, in rad, rad/s or N m by the mode, is for
/// drives that are enabled and requested to follow.
struct RobotCommand {
  CommandMode mode = CommandMode::kEffort;
  JointVector value = JointVector::Zero();
  DriveRequest request = DriveRequest::kDisable;
  /// In force whatever is requested of the drives: braking, faults and disabled drives leave the
  /// outputs as they are, so that a gripper keeps its load.
  OnlyWithStreams<DigitalOutputs> outputs = {};
  /// Feed-forward beside the value, zero where the pipeline gives none: the velocity of a position,
  /// rad/s, and the torque that the motion is expected to take, N m. In CiA 402 the velocity offset
  /// (60B1h) and the torque offset (60B2h) of the cyclic synchronous modes.
  JointVector dq_ff = JointVector::Zero(), tau_ff = JointVector::Zero();
};

/// Abilities of a robot and its wire; compared with the pipeline file before anything starts.
struct Capabilities {
  bool position = false, velocity = false, effort = false;  ///< supported command modes
  std::int64_t min_period_us = 0, max_period_us = 0;        ///< supported cycle periods
  bool wrench = false;  ///< it has a force/torque sensor at the flange
  /// It takes a velocity beside positions; a torque beside positions and velocities.
  bool velocity_feed_forward = false, effort_feed_forward = false;
  std::uint32_t outputs = 0;  ///< bit i: it has digital output i
};

class Hal {
 public:
  /// Returns what this robot and wire can do. [any]
  virtual Capabilities capabilities() const = 0;
  /// Opens the wire for commands of `mode`. Enables no drive and moves nothing. May block, in all
  /// no longer than the board's settings say. [init]
  virtual Status connect(CommandMode mode) = 0;
  /// Reads the newest state. If none arrived since the last cycle, repeats the last with its stamp
  /// and kOk; the guard judges its age. Any other Status means that the wire does not work any
  /// more. Bounded; never blocks. [cyclic]
  virtual Status read(const CycleTime& now, RobotState& state) = 0;
  /// Sends a command, and takes every drive one step towards what is requested. From the next
  /// read() on, a drive that is requested to arm is kFault only if arming has failed; while an old
  /// fault is being cleared it is kArming. Bounded; never blocks. [cyclic]
  virtual Status write(const RobotCommand& command) = 0;
  /// Disables the drives and closes the wire; waits for them no longer than the board's settings
  /// say, if at all. kOk, or why the drives are not known to be disabled; trouble() has details.
  /// May be called in any state, more than once. [any]
  virtual Status disconnect() = 0;

  /// Returns the wire's clock if it begins the cycles; null: the host's does. [init]
  virtual Clock* clock() { return nullptr; }
  /// Returns the name of a digital output in the robot's own words; null: it has none. [init]
  virtual const char* output_name(int /*output*/) const { return nullptr; }
  /// Returns the line of the pipeline file that would have more of the robot's reported properties
  /// compared, with their present values; empty: there is none. After connect(). [init]
  virtual Message unstated() { return {}; }
  /// Explains the last Status that was not kOk in the robot's own words. [between two cycles]
  virtual Message trouble() { return {}; }
  /// Explains a drive's own fault number; empty if there is no explanation. [any]
  virtual Message code_text(std::uint32_t /*code*/) const { return {}; }

 protected:
  ~Hal() = default;  // owned by the board as a static object, never deleted through the interface
};

}  // namespace tactus
