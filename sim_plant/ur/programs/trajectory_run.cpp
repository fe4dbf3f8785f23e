#include "sim_plant/ur/programs/trajectory_run.hpp"

#include <cmath>
#include <limits>

namespace tactus::ur {
namespace {

constexpr std::string_view kTrajectorySocket = "trajectory_socket";
constexpr double kPatience_s = 0.5;  // longest wait for a point while the robot is at rest
constexpr double kSamePlace = 0.01;  // rad
constexpr std::int64_t kEndless = std::numeric_limits<std::int32_t>::max();

}  // namespace

/// Discards points. True: none is left, or none has come for a while.
bool TrajectoryRun::read_away(Machine& machine) {
  TrajectoryPoint point;
  Link* link = machine.links.find(kTrajectorySocket);
  while (left_ > 0 && link != nullptr && link->read_ints(point.data(), point.size())) {
    --left_;
    waited_s_ = 0.0;
  }
  if (left_ <= 0) return true;
  waited_s_ += machine.cycle_s();
  return waited_s_ >= kPatience_s;
}

void TrajectoryRun::start(std::int32_t points, bool stream, Machine& machine) {
  next_points_ = points;
  next_stream_ = stream;
  if (left_ <= 0 && !active()) return begin();
  clear(Then::kStart, machine);
}

void TrajectoryRun::begin() {
  phase_ = Phase::kPoints;
  stream_ = next_stream_;
  left_ = stream_ ? kEndless : next_points_;
  first_ = true;
  waited_s_ = 0.0;
  result_ = kSucceeded;
  spline_.forget();
}

void TrajectoryRun::end_stream(std::int32_t points) {
  if (!stream_) return;
  stream_ = false;
  left_ = points - (kEndless - left_);
}

void TrajectoryRun::cancel(std::int32_t points, Machine& machine) {
  if (features_.counts_cancelled) end_stream(points);
  result_ = kCancelled;
  clear(Then::kTell, machine);
}

void TrajectoryRun::leave(Machine& machine) {
  const bool runs = phase_ == Phase::kPoints || phase_ == Phase::kSpline;
  if (features_.tells_left_only ? left_ > 0 : runs) {
    result_ = kCancelled;
    clear(Then::kTell, machine);
  } else if (features_.tells_left_only) {
    drop(machine);
  }
}

void TrajectoryRun::drop(Machine& machine) {
  if (active() || left_ > 0) clear(Then::kNothing, machine);
}

void TrajectoryRun::clear(Then then, Machine& machine) {
  if (!machine.motion.resting()) machine.motion.stop_j(kStopDeceleration);
  phase_ = Phase::kClearing;
  then_ = then;
  waited_s_ = 0.0;
}

ProgramStep TrajectoryRun::cleared(Machine& machine) {
  left_ = 0;
  stream_ = false;
  if (then_ == Then::kStart) {
    begin();
    return command(machine);
  }
  phase_ = Phase::kIdle;
  if (then_ == Then::kTell) tell(machine);
  return ProgramStep::kEnded;
}

void TrajectoryRun::tell(Machine& machine) {
  if (result_ == kCancelled && !features_.tells_cancelled) return;
  if (Link* link = machine.links.find(kTrajectorySocket)) link->send_int(result_);
}

void TrajectoryRun::finish(TrajectoryResult result, Machine& machine) {
  result_ = result;
  machine.motion.stop_j(kStopDeceleration);
  phase_ = Phase::kStopping;
}

ProgramStep TrajectoryRun::command(Machine& machine) {
  if (machine.motion.busy()) return ProgramStep::kRunning;
  switch (phase_) {
    case Phase::kIdle: return ProgramStep::kEnded;
    case Phase::kSpline:
      if (spline_step(machine)) return ProgramStep::kRunning;
      phase_ = Phase::kPoints;
      waited_s_ = 0.0;
      [[fallthrough]];
    case Phase::kPoints: {
      const ProgramStep step = next_point(machine);
      if (phase_ == Phase::kSpline) spline_step(machine);  // no cycle lies between two segments
      return step;
    }
    case Phase::kClearing: return read_away(machine) ? cleared(machine) : ProgramStep::kWaiting;
    case Phase::kStopping:
      phase_ = Phase::kIdle;
      tell(machine);
      return ProgramStep::kEnded;
  }
  return ProgramStep::kEnded;
}

/// Gives the next command of a spline. False: the segment has ended.
bool TrajectoryRun::spline_step(Machine& machine) {
  const bool more = spline_.command(machine.motion, machine.cycle_s());
  if (features_.publishes_spline_time) machine.io.output.doubles[1] = spline_.travelled_s();
  return more;
}

ProgramStep TrajectoryRun::next_point(Machine& machine) {
  // After a blend radius whose next point did not come in time, the arm goes on to its waypoint.
  const bool arriving = machine.motion.arriving();
  if (left_ <= 0 && arriving) return ProgramStep::kWaiting;
  if (left_ <= 0) {
    finish(kSucceeded, machine);
    return ProgramStep::kRunning;
  }
  TrajectoryPoint point;
  Link* link = machine.links.find(kTrajectorySocket);
  if (link != nullptr && link->read_ints(point.data(), point.size())) {
    --left_;
    waited_s_ = 0.0;
    take_point(point, machine);
    first_ = false;
    return ProgramStep::kRunning;
  }
  if (arriving) return ProgramStep::kWaiting;
  waited_s_ += machine.cycle_s();
  const bool moving = !machine.motion.dq().isZero(1e-6);
  if (waited_s_ > (moving ? 1.5 * machine.cycle_s() : kPatience_s)) {
    --left_;  // the point is not expected later
    finish(kFailed, machine);
    return ProgramStep::kRunning;
  }
  return ProgramStep::kWaiting;
}

void TrajectoryRun::take_point(const TrajectoryPoint& point, Machine& machine) {
  if (point[20] == kPointSpline) {
    take_spline(point, left_ == 0, machine);
    return;
  }
  if (!is_move(point[20]) && !is_optimove(point[20])) return;  // the script ignores it
  spline_.forget();
  if (!take_move(point, machine)) finish(kFailed, machine);
}

void TrajectoryRun::take_spline(const TrajectoryPoint& point, bool last, Machine& machine) {
  const Joints q = machine.motion.q(), q_end = six_numbers(point, 0);
  const double duration_s = point[18] / features_.format.time_scale;
  const double way = (q_end - q).cwiseAbs().maxCoeff();
  if (point[19] != kCubic && point[19] != kQuintic) {
    result_ = kFailed;
    return clear(Then::kTell, machine);
  }
  if (!(duration_s > 0.0)) {
    if (first_ && duration_s == 0.0 && (q_end - q).norm() < kSamePlace) {
      if (features_.publishes_spline_time) machine.io.output.doubles[1] = 0.0;
      return;
    }
    machine.messages.popup("External Control error", "A spline takes time", false, true);
    return finish(kCancelled, machine);
  }
  if (way / duration_s > kIgnoreSpeed) {
    machine.messages.popup("External Control speed limit", "A point is too far away", true, false);
    return finish(kCancelled, machine);
  }
  const bool quintic = point[19] == kQuintic;
  const double scale = features_.format.rate_scale;
  spline_.start(q, q_end, six_numbers(point, 6, scale), six_numbers(point, 12, scale), duration_s,
                quintic, last);
  if (!quintic) spline_.forget_acceleration();
  phase_ = Phase::kSpline;
}

bool TrajectoryRun::take_move(const TrajectoryPoint& point, Machine& machine) {
  if (is_optimove(point[20])) {
    machine.messages.popup("", "Optimoves are only supported from software 5.21.0", false, true);
    return true;
  }
  Move move;
  if (!read_move(point, features_.format, machine, move)) return false;
  if (left_ == 0) move.r = 0.0;  // the last point is not blended
  if (machine.motion.move(move)) return true;
  if (move.kind == Move::Kind::kJ) return false;
  machine.protective_stop({Code::kSingularity, 0});
  return true;
}

}  // namespace tactus::ur
