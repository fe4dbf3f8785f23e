#include "program/session/rehearsal.hpp"

#include <cmath>
#include <cstdio>

#include "program/session/fault_verdict.hpp"
#include "program/session/lateness.hpp"
#include "program/session/stop_expectation.hpp"

namespace tactus {
namespace {

/// True for a path of the tip that gives wrenches; its outcome depends on the contact.
bool presses(const TrajectoryInput& input) {
  const auto* const poses = std::get_if<2>(&input.trajectory);
  return poses != nullptr && ((*poses)->fields & kEffortField) != 0;
}

}  // namespace

TrajectoryRehearsal::TrajectoryRehearsal(Session& session, TrajectoryInput& input, Guard& guard,
                                         const RobotState& state)
    : session_(session),
      input_(input),
      guard_(guard),
      goal_(session, input),
      state_(state),
      late_(state),
      law_(torque_law(session.pipeline)) {
  const Guard::Params& params = session.pipeline.guard;
  limiting_.start(params.limiting_share,
                  std::llround(params.limiting_window / session.pipeline.robot.period_s()));
}

/// Moves the robot to the commanded position at the end of a cycle; for torques, to the position at
/// which the law holds it.
void TrajectoryRehearsal::obey(const RobotCommand& command) {
  const double period_s = session_.pipeline.robot.period_s();
  const JointVector before = state_.q;
  switch (command.mode) {
    case CommandMode::kPosition: state_.q = command.value; break;
    case CommandMode::kVelocity: state_.q += period_s * command.value; break;
    case CommandMode::kEffort:
      state_.q = *law_.q_d;
      state_.dq = law_.dq_d != nullptr ? *law_.dq_d : JointVector(JointVector::Zero());
      return;
  }
  state_.dq = (state_.q - before) / period_s;
}

/// Moves each joint towards its reference, by the implicit Euler step of its equation.
void TrajectoryRehearsal::follow() {
  const Following& loop = *session_.following;
  const double dt_s = session_.pipeline.robot.period_s();
  for (int i = 0; i < kDof; ++i) {
    const double pull = loop.kp[i] * (state_.q[i] - late_.q[i]);
    const double along = loop.damps_error ? loop.kd[i] * state_.dq[i] : 0.0;
    const double m = loop.m[i] + dt_s * (loop.kd[i] + dt_s * loop.kp[i]);
    late_.dq[i] = (loop.m[i] * late_.dq[i] + dt_s * (pull + along)) / m;
    late_.q[i] += dt_s * late_.dq[i];
  }
  late_.stamp_ns = state_.stamp_ns;
}

/// One cycle, as the executive's, from the command of the one before.
Status TrajectoryRehearsal::cycle() {
  Pipeline& pipeline = session_.pipeline;
  RobotCommand command = pipeline.robot.command();
  Status status = guard_.limit(state_, command);
  if (status != Status::kOk) return status;
  const bool spent = saturated(command);
  if (limiting_.add(guard_.telemetry().limited || spent))
    return spent ? Status::kEffortLimit : Status::kLimiting;
  obey(command);
  state_.stamp_ns += std::int64_t{1000} * pipeline.robot.period_us;
  ++cycle_;
  if (pipeline.collision.present) follow();
  status = guard_.check(state_, {state_.stamp_ns});
  if (status == Status::kOk) status = pipeline.step(state_);
  if (status == Status::kOk && pipeline.collision.present)
    status = pipeline.collision_check.step(late_);
  return status;
}

/// Takes the generator's reports; true if no waypoint of the trajectory is left in the store.
bool TrajectoryRehearsal::ended() {
  goal_.follow();
  while (poll_report(session_, input_, report_))
    if (report_.id == input_.id &&
        (is_final(report_.outcome) || report_.outcome == Outcome::kStarved))
      return true;
  return false;
}

double TrajectoryRehearsal::time_s() const {
  return static_cast<double>(cycle_) * session_.pipeline.robot.period_s();
}

/// Returns true if the file states such an end (kOk: no stop). Prints a note if it states another.
bool TrajectoryRehearsal::stated(Status status) {
  Pipeline& pipeline = session_.pipeline;
  StopExpectation stop;
  stop.start(session_.expect.collision_stop, pipeline, input_.path.c_str());
  stop.take(status, pipeline.collision_check.telemetry(), true);
  if (stop.stated() && !stop.met())
    std::fprintf(stderr, "%s: note: [expect] collision_stop: in the rehearsal the arm was %s\n",
                 input_.path.c_str(), stop.seen().c_str());
  return stop.stated() && stop.met();
}

bool TrajectoryRehearsal::refuse(Status status) {
  Pipeline& pipeline = session_.pipeline;
  const bool spent = status == Status::kEffortLimit;  // a run falls behind, and gives its goal up
  Text<127> event(spent ? "refused: the law would be at its limit at t = "
                        : "refused: the run would stop at t = ");
  event << input_.start_s + time_s() << " s";
  print_stop(input_.path.c_str(), event.c_str(), fault_verdict(status, guard_, pipeline));
  if (status == Status::kCollision) print_collision(pipeline.collision_check.telemetry());
  if (law_.q_d != nullptr && (spent || status == Status::kLimiting)) print_torque();
  return false;
}

/// True if the law saturates: the guard then has nothing to limit.
bool TrajectoryRehearsal::saturated(const RobotCommand& command) const {
  return law_.limit != nullptr && (command.value.array().abs() >= law_.limit->array()).any();
}

/// The joint whose torque is farthest beyond its limit, or at that of the law.
void TrajectoryRehearsal::print_torque() const {
  const JointVector asked = session_.pipeline.robot.command().value.cwiseAbs();
  JointVector most = session_.pipeline.guard.effective().tau_max;
  if (law_.limit != nullptr) most = most.cwiseMin(*law_.limit);
  int joint = 0;
  (asked.array() / most.array()).maxCoeff(&joint);
  std::fprintf(
      stderr,
      "  joint %d (%s) takes %s%.4g N m to be held on the path, its limit is %.4g: look at "
      "the tool's mass, the mounting and the posture\n",
      joint + 1, Robot::kJointNames[static_cast<std::size_t>(joint)],
      asked[joint] > most[joint] ? "" : "at least ", asked[joint], most[joint]);
}

/// Prints how much of the trajectory was rehearsed, after a partial rehearsal without findings.
bool TrajectoryRehearsal::in_part() const {
  std::fprintf(stderr, "%s: note: only its first %.6g s are rehearsed\n", input_.path.c_str(),
               time_s());
  return true;
}

/// Returns why a rehearsal would be useless; null: it is useful.
const char* TrajectoryRehearsal::unrehearsed() const {
  if (session_.pipeline.robot.mode() == CommandMode::kEffort && law_.q_d == nullptr)
    return "neither pd_gravity nor pid gives the torque";
  return presses(input_) ? "what its wrenches do depends on the contact" : nullptr;
}

bool TrajectoryRehearsal::run() {
  if (!input_.given()) return true;
  if (const char* const obstacle = unrehearsed()) {
    std::fprintf(stderr, "%s: note: not rehearsed: %s\n", input_.path.c_str(), obstacle);
    return true;
  }
  const double end_s = goal_.latest_report_s();
  while (!ended()) {
    if (time_s() > end_s) return true;
    if (cycle_ == kMostCycles) return in_part();
    const Status status = cycle();
    if (status != Status::kOk) return stated(status) || refuse(status);
  }
  static_cast<void>(stated(Status::kOk));
  if (report_.outcome == Outcome::kRefused) print_verdict(input_, report_.verdict);
  if (report_.outcome == Outcome::kAborted) {
    const Reason why = report_.verdict.ok() ? GoalWatch::left() : goal_.given_up(report_.verdict);
    std::fprintf(stderr, "%s: refused: t = %.6g s: %s\n", input_.path.c_str(),
                 input_.start_s + time_s(), why.c_str());
  }
  if (report_.outcome == Outcome::kStarved) return in_part();
  return report_.outcome == Outcome::kSucceeded;
}

}  // namespace tactus
