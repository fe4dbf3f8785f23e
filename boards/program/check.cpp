// `tactus check`: the loader, the admission and the generator's own first step, without a robot.
#include <cstdio>

#include "boards/program/session.hpp"
#include "boards/program/trajectory_input.hpp"

namespace tactus {

int check(Session& session, const Options& options, const RobotState& initial) {
  TrajectoryInput input;
  if (!read_input(session, options, input)) return kRefused;
  Guard guard;
  Status status = guard.start(session.pipeline.guard, initial, session.pipeline.robot.period_s());
  if (status == Status::kOk) status = session.pipeline.start(initial);
  if (status == Status::kOk && !send_input(session, input)) return kRefused;
  if (status == Status::kOk) status = session.pipeline.step(initial);
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
  std::printf("\n");
  return kSucceeded;
}

}  // namespace tactus
