#include "boards/program/trajectory_input.hpp"

#include <cstdio>

#include "gateway/trajectory_csv.hpp"

namespace tactus {

void print_verdict(const TrajectoryInput& input, const Verdict& verdict) {
  std::fprintf(stderr, "%s: refused: %s", input.path.c_str(), name(verdict.status));
  if (verdict.waypoint >= 0)
    std::fprintf(stderr, ", waypoint %d (t = %.6g s)", verdict.waypoint + 1,
                 input.trajectory->waypoints[verdict.waypoint].time_s);
  if (verdict.axis >= 0)
    std::fprintf(stderr, ", joint %d (%s)", verdict.axis + 1,
                 Robot::kJointNames[static_cast<std::size_t>(verdict.axis)]);
  std::fprintf(stderr, ": value %.9g, limit %.9g\n", verdict.value, verdict.limit);
}

bool read_input(const Session& session, const Options& options, TrajectoryInput& input) {
  if (options.trajectory[0] != '\0') {
    input.path = Path(options.trajectory);
  } else if (!session.gateway.trajectory.empty()) {
    input.path = relative_to(options.pipeline, session.gateway.trajectory);
  } else {
    return true;
  }
  if (!session.pipeline.takes_references) {
    std::fprintf(stderr, "%s: refused: the pipeline has no reference generator\n",
                 input.path.c_str());
    return false;
  }
  Trajectory<JointSpace>* trajectory = session.client.acquire();
  CsvError error;
  if (!read_trajectory(input.path.c_str(), *trajectory, error)) {
    std::fprintf(stderr, "%s:%s%s\n", input.path.c_str(), error.line > 0 ? "" : " ",
                 error.message().c_str());
    return false;
  }
  trajectory->interpolation = session.gateway.interpolation;
  input.trajectory = trajectory;
  const Verdict verdict = session.client.judge(*trajectory);
  if (!verdict.ok()) print_verdict(input, verdict);
  return verdict.ok();
}

bool send_input(Session& session, TrajectoryInput& input) {
  if (input.trajectory == nullptr) return true;
  const Verdict verdict = session.client.send(*input.trajectory, input.id);
  if (!verdict.ok()) print_verdict(input, verdict);
  return verdict.ok();
}

}  // namespace tactus
