// The targets that are due as single points.
//
//   rest     each is a time-optimal move to rest, within limits of velocity, acceleration and jerk,
//            by the project's own law of motion; each joint moves by itself
//   stream   the stream of points of the reference generator, `online = limit`
#include "tests/bench/policies/due_target.hpp"
#include "tests/bench/policies/recording.hpp"
#include "tests/bench/policies/replay.hpp"
#include "tests/bench/policies/space_points.hpp"
#include "tests/reference/motion/motion_bench.hpp"

namespace tactus {
namespace {

AxisLimits limits_of(const JointLimits& robot, int i) {
  return {-robot.dq_max[i], robot.dq_max[i], robot.ddq_max[i], robot.ddq_max[i], robot.dddq_max[i]};
}

/// Moves a period ahead on the way to rest at `goal`.
void move_to_rest(JointSpace::Point& point, const JointVector& goal, double period_s) {
  const JointLimits limits;
  for (int i = 0; i < kDof; ++i) {
    const AxisState from = {point.q[i], point.dq[i], point.ddq[i]};
    const AxisState next = plan_to(from, goal[i], 0.0, limits_of(limits, i)).at(period_s);
    point.q[i] = next.p;
    point.dq[i] = next.v;
    point.ddq[i] = next.a;
  }
}

}  // namespace

bool replay_rest(const std::vector<ChunkMessage>& chunks, const Replay& replay) {
  Recording recording(replay.out);
  if (!recording.open()) return false;
  DueTarget targets(chunks);
  const JointSpace::Point home = home_point<JointSpace>();
  auto point = point_of<JointSpace>(chunks.front().points.front());
  for (int cycle = 0; cycle < replay.cycles(); ++cycle) {
    recording.add(replay.time_s(cycle), point, home, false);
    if (const ChunkPoint* const due = targets.at(replay.time_ns(cycle)))
      move_to_rest(point, point_of<JointSpace>(*due).q, replay.period_s());
  }
  return true;
}

bool replay_stream(const std::vector<ChunkMessage>& chunks, const Replay& replay) {
  Recording recording(replay.out);
  if (!recording.open()) return false;
  DueTarget targets(chunks);
  MotionBench<JointSpace> bench(replay.period_s());
  if (bench.start(point_of<JointSpace>(chunks.front().points.front())) != Status::kOk) return false;
  std::int64_t sent_ns = -1;  // a newer chunk repeats targets that were sent
  for (int cycle = 0; cycle < replay.cycles(); ++cycle) {
    recording.add(replay.time_s(cycle), bench.out(), bench.home, false);
    const ChunkPoint* const due = targets.at(replay.time_ns(cycle));
    if (due != nullptr && due->t_target_ns > sent_ns) {
      bench.send(point_of<JointSpace>(*due));
      sent_ns = due->t_target_ns;
    }
    if (bench.step() != Status::kOk) return false;
    bench.report_of(0);
  }
  return true;
}

}  // namespace tactus
