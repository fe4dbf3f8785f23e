// Cia402Settings: the [cia402] section of a pipeline file, the drives of the joints in CiA 402
// terms.
#pragma once

#include "hal/cia402/object_lines.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/types.hpp"

namespace tactus::cia402 {

/// Source of the gravity torque when torques are commanded.
enum class Gravity : std::uint8_t {
  kCommand,  ///< the commanded torque is all the torque of the joint
  kDrive,    ///< the drives add what holds the arm
};

constexpr const char* name(Gravity gravity) {
  switch (gravity) {
    case Gravity::kCommand: return "command";
    case Gravity::kDrive: return "drive";
  }
  return nullptr;
}

/// Position range that the drives' encoders report after power-on.
enum class Encoder : std::uint8_t {
  kMultiTurn,   ///< the position
  kSingleTurn,  ///< the position within a turn of the encoder; the joint's range decides which
};

constexpr const char* name(Encoder encoder) {
  switch (encoder) {
    case Encoder::kMultiTurn: return "multi_turn";
    case Encoder::kSingleTurn: return "single_turn";
  }
  return nullptr;
}

struct Cia402Settings {
  JointVector serial = JointVector::Zero();  ///< 1018h:4; 0: any
  ObjectLines sdo;                           ///< objects that the file sets
  int store = 0;        ///< 1: what these lines have changed is stored in the drive, 1010h:1
  int store_ms = 5000;  ///< longest time for that
  JointVector rated_torque = JointVector::Constant(kRequired);  ///< 6076h, N m
  JointVector torque_limit = JointVector::Zero();  ///< N m, that 6072h allows; 0: the joint's limit
  JointVector increments =
      JointVector::Constant(16777216.0);  ///< of positions per motor revolution
  /// Units of velocity per motor revolution per second: 60 for rev/min; 0: as the drive reports.
  JointVector velocity_units = JointVector::Zero();
  JointVector gear_ratio = JointVector::Ones();
  JointVector direction = JointVector::Ones();        ///< +1 or -1
  JointVector position_offset = JointVector::Zero();  ///< rad
  Encoder encoder = Encoder::kMultiTurn;
  int referenced_bit =
      -1;  ///< of the statusword, if the drive has one; -1: it is always referenced
  /// 6098h for a drive without a position reference after power-on; 0: arming homes none.
  JointVector homing_method = JointVector::Zero();
  int homing_ms = 30000;  ///< longest homing of a joint
  Gravity gravity = Gravity::kCommand;
  /// The hold between enabling and the first command, in effort mode.
  JointVector hold_stiffness = JointVector::Constant(200.0);  ///< N m/rad
  JointVector hold_damping = JointVector::Constant(10.0);     ///< N m s/rad
  double hold_tolerance = 0.05;                               ///< rad: farther, and the drives stop
  int step_ms = 500;    ///< longest time in a state on the way up
  int reset_ms = 1000;  ///< longest time until a fault is reset
  int stop_ms = 2000;   ///< longest quick stop, before the voltage is cut
  int brake_ms = 200;   ///< after enabling, until the brakes are open
  int limited_ms = 50;  ///< longest time that a drive may limit commands; 0: any time
  int max_missed = 3;   ///< cycles in a row without feedback of a joint that are bridged

  /// Time from enabling until the first command, ms. Even after the latest opening of a brake it
  /// leaves time to detect that a drive does not hold.
  int held_ms() const { return brake_ms + 100; }

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("serial", serial, Range{0.0, 4294967295.0}, "1");
    visit.lines("sdo", sdo, "[jointN] object type value, as 0x2003:1 u16 5");
    visit.param("store", store, Range{0.0, 1.0}, "1");
    visit.param("store_ms", store_ms, Range{1.0, 60000.0}, "ms");
    visit.param("rated_torque", rated_torque, Range{1e-3, 1e4}, "N m");
    visit.param("torque_limit", torque_limit, Range{0.0, 1e5}, "N m");
    visit.param("increments", increments, Range{1.0, 4294967295.0}, "1");
    visit.param("velocity_units", velocity_units, Range{0.0, 4294967295.0}, "1");
    visit.param("gear_ratio", gear_ratio, Range{1e-3, 1e4}, "1");
    visit.param("direction", direction, Range{-1.0, 1.0}, "1");
    visit.param("position_offset", position_offset, Range{-1e3, 1e3}, "rad");
    visit.choice("encoder", encoder);
    visit.param("referenced_bit", referenced_bit, Range{-1.0, 15.0}, "1");
    visit.param("homing_method", homing_method, Range{-128.0, 37.0}, "1");
    visit.param("homing_ms", homing_ms, Range{1.0, 600000.0}, "ms");
    visit.choice("gravity", gravity);
    visit.param("hold_stiffness", hold_stiffness, Range{0.0, 1e5}, "N m/rad");
    visit.param("hold_damping", hold_damping, Range{0.0, 1e4}, "N m s/rad");
    visit.param("hold_tolerance", hold_tolerance, Range{1e-4, 1.0}, "rad");
    visit.param("step_ms", step_ms, Range{1.0, 60000.0}, "ms");
    visit.param("reset_ms", reset_ms, Range{1.0, 60000.0}, "ms");
    visit.param("stop_ms", stop_ms, Range{1.0, 60000.0}, "ms");
    visit.param("brake_ms", brake_ms, Range{0.0, 5000.0}, "ms");
    visit.param("limited_ms", limited_ms, Range{0.0, 60000.0}, "ms");
    visit.param("max_missed", max_missed, Range{0.0, 100.0}, "cycles");
  }
};

}  // namespace tactus::cia402
