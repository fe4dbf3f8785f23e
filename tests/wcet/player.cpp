#include "tests/wcet/player.hpp"
#include "tests/support/armed.hpp"

namespace tactus {

template <class Space>
TapeClient<Space>::TapeClient() {
  for (std::size_t i = 0; i < kStores; ++i) {
    channel.stores[i].waypoints = waypoints[i];
    channel.stores[i].capacity = kCapacity;
  }
}

template <class Space>
void TapeClient<Space>::poll(TapeHal& outside) {
  Report report;
  while (client.poll(report)) outside.told(report);
  Feedback<Space> feedback;
  while (client.poll_feedback(feedback)) outside.told(feedback);
}

template struct TapeClient<JointSpace>;
template struct TapeClient<TaskSpace>;

Status Player::load(std::string_view text, LoadError& error) {
  Loader loader({&joints_.channel, &poses_.channel}, hal_.capabilities(), board_);
  TRY(loader.load(text, pipeline_, error));
  for (int i = 0; i < pipeline_.ports.count(); ++i) {
    const PortEntry& port = pipeline_.ports[i];
    if (reference_ == nullptr && std::string_view(port.port) == "x_d")
      reference_ = static_cast<const Pose*>(port.value);
  }
  return Status::kOk;
}

void Player::widen(Waypoint<JointSpace>* waypoints, int capacity) {
  joints_.channel.stores[0].waypoints = waypoints;
  joints_.channel.stores[0].capacity = capacity;
}

void Player::note(const Verdict& verdict) {
  accepted_ += verdict.ok() ? 1 : 0;
  hal_.told(verdict);
}

bool Player::prepare() {
  if (deaf_ > 0) {
    --deaf_;
  } else {
    joints_.poll(hal_);
    poses_.poll(hal_);
  }
  if (repeats_ > 0) {
    --repeats_;
  } else {
    TapeOp op = TapeOp::kCount;
    while (op != TapeOp::kCycle && op != TapeOp::kCycles) {
      if (tape_.empty()) return false;
      op = static_cast<TapeOp>(tape_.take<std::uint8_t>() %
                               static_cast<std::uint8_t>(TapeOp::kCount));
      apply(op);
    }
  }
  if (!started_) apply(TapeOp::kStart);
  stamp_ns_ += std::int64_t{1000} * pipeline_.robot.period_us + late_ns_;
  late_ns_ = 0;
  return !started_ || executive_.rung() != Rung::kDisabled;
}

/// The arm is taken over at rest, and then moves as the tape says.
void Player::start() {
  static_cast<void>(executive_.stop());
  const JointVector dq = hal_.state.dq;
  hal_.state.dq.setZero();
  stamp_ns_ = 0;
  const std::int64_t period_ns = std::int64_t{1000} * pipeline_.robot.period_us;
  started_ = start_armed(executive_, period_ns, stamp_ns_) == Status::kOk || started_;
  arming_cycles_ += executive_.telemetry().cycles;
  hal_.state.dq = dq;
}

void Player::apply(TapeOp op) {
  const JointLimits limits;
  std::uint32_t id = 0;
  switch (op) {
    case TapeOp::kCycles: repeats_ = tape_.take<std::uint8_t>(); break;
    case TapeOp::kStart: start(); break;
    case TapeOp::kState:
      for (JointVector* value : {&hal_.state.q, &hal_.state.dq, &hal_.state.tau})
        for (int i = 0; i < kDof; ++i) (*value)[i] = static_cast<double>(tape_.take<float>());
      for (int i = 0; i < 6; ++i) hal_.state.ft[i] = static_cast<double>(tape_.take<float>());
      break;
    case TapeOp::kJoints: take_fractions(hal_.state.q, limits.q_min, limits.q_max); break;
    case TapeOp::kVelocities: take_fractions(hal_.state.dq, -limits.dq_max, limits.dq_max); break;
    case TapeOp::kEfforts: take_fractions(hal_.state.tau, -limits.tau_max, limits.tau_max); break;
    case TapeOp::kWrench:
      for (int i = 0; i < 6; ++i)
        hal_.state.ft[i] = (i < 3 ? 1.3 : 0.13) * tape_.take<std::int8_t>();
      break;
    case TapeOp::kPoint: return take_point();
    case TapeOp::kTrajectory: return take_trajectory();
    case TapeOp::kWaypoints: return take_waypoints();
    case TapeOp::kAppend: return take_append();
    case TapeOp::kCancel: return note(poses_.client.cancel(id));
    case TapeOp::kOverride:
      return note(poses_.client.set_override(tape_.take<std::uint8_t>() / 255.0, id));
    case TapeOp::kPause: return note(poses_.client.pause(id));
    case TapeOp::kResume: return note(poses_.client.resume(id));
    case TapeOp::kLate:
      late_ns_ = std::int64_t{250} * pipeline_.robot.period_us * tape_.take<std::uint8_t>();
      break;
    case TapeOp::kDeaf: deaf_ = tape_.take<std::uint8_t>(); break;
    case TapeOp::kCycle:
    case TapeOp::kCount: break;
  }
}

void Player::take_fractions(JointVector& value, const JointVector& low, const JointVector& high) {
  for (int i = 0; i < kDof; ++i) {
    const double fraction = tape_.take<std::int8_t>() / 127.0;
    value[i] = 0.5 * ((1.0 - fraction) * low[i] + (1.0 + fraction) * high[i]);
    value[i] = value[i] < low[i] ? low[i] : value[i] > high[i] ? high[i] : value[i];
  }
}

}  // namespace tactus
