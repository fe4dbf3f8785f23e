// `tactus check`: runs the loader, the admission and the first step of the pipeline from the state
// of the robot, whose drives stay disabled; then it goes along a path of the tip by inverse
// kinematics, and rehearses the trajectory.
#include <cinttypes>
#include <cstdio>

#include "program/reach/reach_warnings.hpp"
#include "program/results/expectation.hpp"
#include "program/results/realtime_result.hpp"
#include "program/session/fault_verdict.hpp"
#include "program/session/lateness.hpp"
#include "program/session/rehearsal.hpp"
#include "program/session/session.hpp"
#include "program/session/trajectory_input.hpp"

namespace tactus {
namespace {

/// The arm rests where it stands until the start time: that need not be waited for.
void begin_at_once(TrajectoryInput& input) {
  if (auto* joints = std::get_if<1>(&input.trajectory)) (*joints)->start_s = kStartAtOnce;
  if (auto* poses = std::get_if<2>(&input.trajectory)) (*poses)->start_s = kStartAtOnce;
}

/// So that signs, gears and offsets can be compared with the arm.
void print_place(const char* path, const JointVector& q) {
  std::printf("%s: the arm stands at", path);
  for (int i = 0; i < kDof; ++i) {
    std::printf(" %.4f", q[i]);
    if (i + 1 == kDof || is_prismatic<Robot>(i) != is_prismatic<Robot>(i + 1))
      std::printf(" %s", position_unit(i));
  }
  std::printf("\n");
}

/// Homing moves the arm before a reference or the guard does.
void print_homing(const Session& session, const char* path) {
  const Message joints = session.to_home != nullptr ? session.to_home() : Message();
  if (joints.empty()) return;
  std::fprintf(
      stderr,
      "%s: note: arming will home %s: their drives do not know where they are, so that their "
      "positions above mean nothing yet, and move them by themselves, without the guard\n",
      path, joints.c_str());
}

/// A torque law overshoots by its gains and the arm's inertia: reports if the file does not give
/// by how much.
void print_room(const char* path, const Guard::Params& guard) {
  const Guard::Params untold;
  if (guard.position_allowance != untold.position_allowance ||
      guard.velocity_allowance != untold.velocity_allowance)
    return;
  std::fprintf(
      stderr,
      "%s: note: [guard] position_allowance, velocity_allowance: the error of this loop is "
      "not given; references may use whole limits, and an arm that is %g rad or %g %% "
      "beyond them is stopped\n",
      path, Guard::kPositionTolerance, 100.0 * Guard::kVelocityTolerance);
}

/// Judges the host if the file ends the start on an unfit one, as a run does and by
/// taking the same steps. Only real-time runs require that, so that a simulated arm is not
/// refused.
bool judge_host(const Session& session, const Options& options) {
  const RealtimeSettings& settings = session.realtime;
  if (settings.required == Required::kWarn) return true;
  if (!settings.watchdog.empty())
    std::fprintf(stderr, "%s: note: not judged: [realtime] watchdog: to open it starts it\n",
                 options.pipeline);
  Realtime realtime;
  if (prepare(realtime, settings)) return true;
  if (!session.simulated) return false;
  std::fprintf(stderr, "%s: note: that ends `serve` and `run --realtime` here\n", options.pipeline);
  return true;
}

}  // namespace

Status look(Hal& hal, CommandMode mode, RobotState& state) {
  Status status = hal.connect(mode);
  if (status == Status::kOk) status = hal.read({}, state);
  static_cast<void>(hal.disconnect());
  return status;
}

void print_written(const char* path, const Session& session) {
  if (session.written == nullptr) return;
  int n = 0;
  for (Message text = session.written(n); !text.empty(); text = session.written(++n))
    std::printf("%s: %s\n", path, text.c_str());
}

int check(Session& session, const Options& options) {
  Expectation expectation;
  if (!expectation.start(session.expect, session.pipeline, options.pipeline)) return kRefused;
  TrajectoryInput input;
  if (!read_input(session, options, input)) return kRefused;
  const bool fit = judge_host(session, options);
  Pipeline& pipeline = session.pipeline;
  begin_at_once(input);
  RobotState initial;
  Status status = look(session.hal, pipeline.robot.mode(), initial);
  print_written(options.pipeline, session);
  if (status != Status::kOk) {
    print_stop(options.pipeline, "refused", status, session.hal.trouble());
    return kRefused;
  }
  if (!session.simulated) print_place(options.pipeline, initial.q);
  print_homing(session, options.pipeline);
  if (const Message line = session.hal.unstated(); !line.empty())
    std::fprintf(stderr,
                 "%s: note: another robot would be taken for this one; to compare, add %s\n",
                 options.pipeline, line.c_str());
  status = pipeline.start(initial);
  if (status == Status::kOk && !send_input(session, input)) return kRefused;
  if (status == Status::kOk) status = pipeline.step(initial);
  // A robot at rest on its reference holds itself with the first command.
  RobotState held = initial;
  if (pipeline.robot.mode() == CommandMode::kEffort) held.tau = pipeline.robot.command().value;
  Guard guard;
  if (status == Status::kOk)
    status = guard.start(pipeline.guard, pipeline.robot.mode(), held, pipeline.robot.period_s(),
                         {held.stamp_ns});
  if (status != Status::kOk) {
    print_stop(options.pipeline, "refused", fault_verdict(status, guard, pipeline));
    if (status == Status::kCollision) print_collision(pipeline.collision_check.telemetry());
    return kRefused;
  }
  if (pipeline.collision.present)
    print_lateness(options.pipeline, *session.following, pipeline.collision);
  Report report;
  while (poll_report(session, input, report)) {
    if (report.outcome != Outcome::kRefused) continue;
    print_verdict(input, report.verdict);
    return kRefused;
  }
  const bool goes = judge_reach(session, input, initial.q) &&
                    TrajectoryRehearsal(session, input, guard, initial).run();
  if (pipeline.robot.mode() == CommandMode::kEffort) print_room(options.pipeline, pipeline.guard);
  if (!judge_rest(session, input) || !goes || !fit) return kRefused;
  print_long_way(input);
  std::printf("%s: accepted", options.pipeline);
  if (input.given())
    std::printf("; %s: accepted, %" PRId64 " %s, %.6g s", input.path.c_str(), input.count(),
                input.count() == 1 ? "waypoint" : "waypoints", input.end_s());
  if (input.stretch() > 0.0)
    std::printf(", %.1f %% longer to stay within limits", 100.0 * input.stretch());
  if (input.smoothing().tolerance.allows()) std::printf(", %s", describe(input.moved()).c_str());
  std::printf("\n");
  return kSucceeded;
}

}  // namespace tactus
