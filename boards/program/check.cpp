// `tactus check`: the loader, the admission and the generator's own first step, without a robot.
#include <cstdio>

#include "boards/program/session.hpp"
#include "boards/program/trajectory_input.hpp"

namespace tactus {

int check(Session& session, const Options& options, const RobotState& initial) {
  TrajectoryInput input;
  if (!read_input(session, options, input)) return kRefused;
  Pipeline& pipeline = session.pipeline;
  Status status = pipeline.start(initial);
  if (status == Status::kOk && !send_input(session, input)) return kRefused;
  if (status == Status::kOk) status = pipeline.step(initial);
  // A robot at rest on its reference holds itself with what is commanded first.
  RobotState held = initial;
  if (pipeline.robot.mode() == CommandMode::kEffort) held.tau = pipeline.robot.command().value;
  Guard guard;
  if (status == Status::kOk)
    status = guard.start(pipeline.guard, pipeline.robot.mode(), held, pipeline.robot.period_s());
  if (status != Status::kOk) {
    print_stop(options.pipeline, "refused", status, guard.telemetry());
    return kRefused;
  }
  Report report;
  while (poll_report(session, input, report)) {
    if (report.outcome != Outcome::kRefused) continue;
    print_verdict(input, report.verdict);
    return kRefused;
  }
  std::printf("%s: accepted", options.pipeline);
  if (input.given())
    std::printf("; %s: accepted, %d waypoints, %.6g s", input.path.c_str(), input.count(),
                input.end_s());
  if (input.stretch() > 0.0) std::printf(", %.1f %% longer", 100.0 * input.stretch());
  std::printf("\n");
  return kSucceeded;
}

}  // namespace tactus
