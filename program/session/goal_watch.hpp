// GoalWatch: how far the robot is from its goal, for a run that ends without having reached it.
#pragma once

#include "gateway/verdict_text.hpp"
#include "program/session/trajectory_input.hpp"

namespace tactus {

class GoalWatch {
 public:
  GoalWatch(Session& session, const TrajectoryInput& input) : session_(session), input_(input) {}

  /// Takes the generator's reports on its goal since the last call. [cyclic]
  void follow();
  /// Time until which a run waits for the generator's report on the end of the trajectory, s; of
  /// one that waits without an end, only for its cycles. Call it once the generator has started.
  double latest_report_s() const;
  /// Returns joint or axis, value, limit and remedy of a goal that the generator gave up; empty if
  /// something else ended it.
  Reason given_up(const Verdict& verdict) const;
  /// Returns the same of one that was reached, but not for as long as it must be.
  static Reason left();
  /// Returns the same of a goal that was pending when the run ended after `time_s`.
  Reason unfinished(double time_s) const;

 private:
  VerdictAxes axes() const;
  Verdict last_verdict() const;

  Session& session_;
  const TrajectoryInput& input_;
  Feedback<JointSpace> joints_;
  Feedback<TaskSpace> tip_;
  bool reported_ = false;
};

}  // namespace tactus
