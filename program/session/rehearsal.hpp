// TrajectoryRehearsal: runs the chain on a trajectory with an ideal robot, which follows commands
// without delay while its sensors keep their present values. So `tactus check` finds, before
// anything moves, how law and guard treat a trajectory that admission accepts. A robot with torque
// commands is always at the position at which its law is to hold it, so the law gives the torque
// for that. The collision check uses an arm that lags as the closed loop does (lateness.hpp).
#pragma once

#include "kernel/cycle/limiting_watch.hpp"
#include "program/session/goal_watch.hpp"
#include "program/session/torque_law.hpp"

namespace tactus {

class TrajectoryRehearsal {
 public:
  /// Cycles that are rehearsed at most: about 5 s of computing.
  static constexpr std::int64_t kMostCycles = 1'000'000;

  /// Begins with a chain and a guard that have started and have done one cycle at `state`.
  TrajectoryRehearsal(Session& session, TrajectoryInput& input, Guard& guard,
                      const RobotState& state);

  /// Runs until the trajectory has ended, or as far as its store holds it. False: the run would
  /// stop, and not as [expect] states; prints when and why to stderr. True without a rehearsal for
  /// torques of no law of positions, and for wrenches that a contact is to answer.
  bool run();

 private:
  Status cycle();
  void obey(const RobotCommand& command);
  void follow();
  bool saturated(const RobotCommand& command) const;
  void print_torque() const;
  const char* unrehearsed() const;
  bool ended();
  double time_s() const;
  bool stated(Status status);
  bool refuse(Status status);
  bool in_part() const;

  Session& session_;
  TrajectoryInput& input_;
  Guard& guard_;
  GoalWatch goal_;
  LimitingWatch limiting_;
  RobotState state_, late_;  // at once, and as the joints follow
  TorqueLaw law_;
  std::int64_t cycle_ = 0;
  Report report_;
};

}  // namespace tactus
