// The sections of a pipeline file that are not blocks: [robot], [executive], [recorder]. ([guard]
// is Guard::Params.)
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/load_error.hpp"
#include "kernel/core/port.hpp"
#include "kernel/model/mounting.hpp"
#include "kernel/pipeline/outputs_section.hpp"
#include "kernel/pipeline/rate_watch.hpp"

namespace tactus {

/// [robot]: the period, the mounting, the tool, the measured values as outputs for the blocks, and
/// the one command as an input.
struct RobotSection : OutputsSection<> {
  static constexpr double kHalfTurn_rad = 3.15;  ///< refuses degrees from 4 on

  Name name;                           ///< robot that the file is written for; must be the board's
  int period_us = kRequiredInt;        ///< cycle period
  Vector3 mounting = Vector3::Zero();  ///< of the base in the world: roll, pitch, yaw, rad
  // Values not given are NaN; the models then assume zero.
  double tool_mass = kRequired;                     ///< kg
  Vector3 tool_com = Vector3::Constant(kRequired);  ///< m, flange frame
  Vector3 tool_tip = Vector3::Constant(kRequired);  ///< m, flange frame; axes as the flange's

  Out<Quantity::kJointPosition> q;
  Out<Quantity::kJointVelocity> dq;
  Out<Quantity::kJointEffort> tau;
  Out<Quantity::kSensorWrench> ft;       ///< zero without a sensor
  Out<Quantity::kTool> tool;             ///< set when the section has been read
  Out<Quantity::kScalar> speed_scaling;  ///< that of the robot, 0..1; 1 if it has none

  In<Quantity::kJointPosition> q_c;
  In<Quantity::kJointVelocity> dq_c;
  In<Quantity::kJointEffort> tau_c;
  In<Quantity::kJointVelocity> dq_ff;  ///< beside q_c
  In<Quantity::kJointEffort> tau_ff;   ///< beside q_c or dq_c

  template <class Visitor>
  void describe(Visitor& visit) {
    describe_robot(visit);
    describe_command(visit);
  }
  /// All but the command.
  template <class Visitor>
  void describe_robot(Visitor& visit) {
    visit.text("name", name, "the robot the file is written for");
    visit.param("period_us", period_us, Range{100.0, 100000.0}, "us");
    visit.param("mounting", mounting, Range{-kHalfTurn_rad, kHalfTurn_rad}, "rad");
    visit.optional("tool_mass", tool_mass, Range{0.0, Tool::kMostMass_kg}, "kg");
    visit.optional("tool_com", tool_com, Range{-Tool::kFarthest_m, Tool::kFarthest_m}, "m");
    visit.optional("tool_tip", tool_tip, Range{-Tool::kFarthest_m, Tool::kFarthest_m}, "m");
    visit.out("q", q);
    visit.out("dq", dq);
    visit.out("tau", tau);
    visit.out("tool", tool);
    visit.out("ft", ft);
    visit.out("speed_scaling", speed_scaling);
  }
  /// Describes the commands, bound after the last block; exactly one of them is given, and the
  /// feed-forward beside it.
  template <class Visitor>
  void describe_command(Visitor& visit) {
    visit.optional("q_c", q_c);
    visit.optional("dq_c", dq_c);
    visit.optional("tau_c", tau_c);
    visit.optional("dq_ff", dq_ff);
    visit.optional("tau_ff", tau_ff);
    describe_outputs(visit);
  }

  /// [cyclic]
  void set_measured(const RobotState& state) {
    q.value = state.q;
    dq.value = state.dq;
    tau.value = state.tau;
    ft.value = state.ft;
    speed_scaling.value = state.speed_scaling;
  }
  CommandMode mode() const {
    return tau_c.wired()  ? CommandMode::kEffort
           : dq_c.wired() ? CommandMode::kVelocity
                          : CommandMode::kPosition;
  }
  /// Returns the value of the wired command with its feed-forward. [cyclic]
  RobotCommand command() const {
    const JointVector& value = tau_c.wired() ? *tau_c : dq_c.wired() ? *dq_c : *q_c;
    return {mode(), value, DriveRequest::kDisable, {}, *dq_ff, *tau_ff};
  }
  /// The tool as the file gives it: NaN where it does not. The models have that of the output.
  /// [init]
  Tool given_tool() const {
    return {tool_mass, tool_com, Pose{tool_tip, {1.0, 0.0, 0.0, 0.0}}, gravity_in_base(mounting)};
  }
  double period_s() const { return period_us * 1e-6; }
};

/// [executive]
struct ExecutiveSection {
  static constexpr int kRestBlock = 10;  ///< cycles whose velocities are judged together

  int budget_us = 0;         ///< intended longest time of the control chain; 0: half a period
  int max_slip = 3;          ///< missed periods in a row that are bridged; more: hold; more than
                             ///< twice as many: stop
  int max_late = 10;         ///< late cycles, within the window, that are bridged; more: hold
  int late_window = 100;     ///< cycles
  int max_overruns = 3;      ///< cycles longer than the period, within the window; more: one rung
  int overrun_window = 100;  ///< cycles
  int clean_cycles = 1000;   ///< cycles without an overrun until optional rows run again
  int stop_ms = 3000;        ///< longest time in which a brake must come to rest; beyond rest_ms
  int arming_ms = 10000;     ///< longest time in which all drives must become enabled, and the arm
                             ///< be at rest; beyond rest_ms
  int disabling_ms = 2000;   ///< longest time in which they must then become disabled
  int rest_ms = 100;         ///< time without motion, in whole blocks, after which it is at rest
  double rest_velocity = 0.01;  ///< rad/s of every joint; the arm is at rest below it

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("budget_us", budget_us, Range{0.0, 100000.0}, "us");
    visit.param("max_slip", max_slip, Range{0.0, 1000.0}, "cycles");
    visit.param("max_late", max_late, Range{0.0, RateWatch::kMost}, "cycles");
    visit.param("late_window", late_window, Range{1.0, 1000000.0}, "cycles");
    visit.param("max_overruns", max_overruns, Range{0.0, RateWatch::kMost}, "cycles");
    visit.param("overrun_window", overrun_window, Range{1.0, 1000000.0}, "cycles");
    visit.param("clean_cycles", clean_cycles, Range{1.0, 10000000.0}, "cycles");
    visit.param("stop_ms", stop_ms, Range{1.0, 60000.0}, "ms");
    visit.param("arming_ms", arming_ms, Range{1.0, 600000.0}, "ms");
    visit.param("disabling_ms", disabling_ms, Range{1.0, 60000.0}, "ms");
    visit.param("rest_ms", rest_ms, Range{1.0, 60000.0}, "ms");
    visit.param("rest_velocity", rest_velocity, kPositive, "rad/s");
  }
  /// Blocks that together last rest_ms, at least.
  int rest_blocks(int period_us) const {
    const int block_us = kRestBlock * period_us;
    return (1000 * rest_ms + block_us - 1) / block_us;
  }
  int budget(int period_us) const { return budget_us > 0 ? budget_us : (period_us + 1) / 2; }
};

/// [recorder]
struct RecorderSection {
  int divisor = 1;     ///< cycles per recorded row
  int offset = 0;      ///< cycle modulo divisor
  int budget_us = 20;  ///< intended longest time
  Value signals;       ///< outputs to record; default: all
  Value tracking;      ///< pairs "reference measured" whose difference is reported

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("divisor", divisor, Range{1.0, 1000.0}, "cycles");
    visit.param("offset", offset, Range{0.0, 999.0}, "cycles");
    visit.param("budget_us", budget_us, Range{1.0, 100000.0}, "us");
    visit.text("signals", signals, "outputs to record; default: all");
    visit.text("tracking", tracking, "pairs: reference measured");
  }
};

}  // namespace tactus
