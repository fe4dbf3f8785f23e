#include "hal/ur/ur_hal.hpp"

#include <limits>

#include "hal/ur/flange_wrench.hpp"

namespace tactus::ur {

static_assert(kDof == 6, "a UR arm has six joints");

Capabilities UrHal::capabilities() const {
  Capabilities offered;
  offered.position = offered.wrench = true;
  offered.min_period_us = 2000, offered.max_period_us = 8000;
  return offered;
}

/// The packet of the cycle; where it does not come, the cycle begins without it.
std::int64_t UrHal::wait() {
  constexpr int kMostWakes = 4;  // a packet may come in pieces, but not for ever
  Came came = Came::kNothing;
  for (int i = 0; i < kMostWakes && came == Came::kNothing && fault_ == Status::kOk; ++i) {
    if (!session_.wait(clock_.patience_ns(settings_->packet_wait))) break;
    came = receive();
  }
  if (came != Came::kCycle) clock_.bridge();
  return clock_.stamp_ns();
}

UrHal::Came UrHal::receive() {
  int count = 0;
  robot_.receive();
  fault_ = session_.receive(state_, count, why_);
  if (fault_ != Status::kOk || count == 0) return Came::kNothing;
  switch (clock_.packet(state_.timestamp_s)) {
    case PacketClock::Found::kCycle:
      return Came::kCycle;
    case PacketClock::Found::kLate:
      return Came::kNothing;
    case PacketClock::Found::kRepeated:
      return Came::kNothingNew;
    case PacketClock::Found::kBackwards:
      break;
  }
  why_ = Message("the robot's clock was set back to ");
  why_ << state_.timestamp_s << " s";
  fault_ = Status::kClock;
  return Came::kNothing;
}

Status UrHal::read(RobotState& state) {
  if (fault_ == Status::kOk && clock_.missed() > settings_->max_missed) {
    why_ = Message("no new packet for ");
    why_ << clock_.missed() << " periods, limit " << settings_->max_missed << "; the last one at "
         << state_.timestamp_s << " s";
    fault_ = Status::kBusTimeout;
  }
  if (fault_ == Status::kOk) fault_ = judge_modes(state_, why_);
  if (fault_ == Status::kOk) fault_ = judge_program();
  if (fault_ == Status::kOk) show(state);
  return fault_;
}

Status UrHal::judge_program() {
  constexpr std::array<const char*, 6> kNames = {"stopping", "stopped", "playing",
                                                 "pausing",  "paused",  "resuming"};
  const bool ended = state_.echo == kServoEnded;
  if (state_.playing() && !ended) return Status::kOk;
  why_ = Message("the program on the robot ");
  if (ended)
    why_ << "has ended: no set-points, or the first one not where the arm is";
  else if (state_.runtime_state < kNames.size())
    why_ << "is " << kNames[state_.runtime_state];
  else
    why_ << "is in state " << static_cast<std::size_t>(state_.runtime_state);
  return Status::kProgramStopped;
}

void UrHal::show(RobotState& state) const {
  state.q = state_.q;
  state.dq = state_.dq;
  state.tau = state_.moment;
  state.ft = flange_wrench(state_, tool_);
  state.speed_scaling = time_scaling(state_.speed_scaling, state_.speed_fraction);
}

Status UrHal::write(const RobotCommand& command) {
  if (fault_ != Status::kOk) return fault_;
  count_ = count_ < std::numeric_limits<std::int32_t>::max() ? count_ + 1 : 1;
  const Socket::Sent sent = session_.send(count_, command.value);
  unsent_ = sent == Socket::Sent::kNothing ? unsent_ + 1 : 0;
  if (sent == Socket::Sent::kLost) {
    why_ = Message("RTDE: the connection does not take set-points any more");
    fault_ = Status::kConnectionLost;
  } else if (unsent_ > settings_->max_missed) {
    why_ = Message("RTDE: no set-point could be sent for ");
    why_ << unsent_ << " periods, limit " << settings_->max_missed;
    fault_ = Status::kBusTimeout;
  }
  return fault_;
}

/// A negative count is the program's end: it brakes. Where that does not arrive, the program brakes
/// because no set-points do. The connections stay until the next start or the end, so that what was
/// sent arrives and the robot's reason can still be read.
void UrHal::stop() {
  if (session_.running() && session_.send(kServoEnded, state_.q) == Socket::Sent::kLost)
    session_.close();
  if (fault_ == Status::kOk) fault_ = Status::kNotStarted;
}

Message UrHal::trouble() {
  constexpr int kMostWaits = 20;
  constexpr std::int64_t kWait_ns = 10'000'000;
  const bool by_robot = fault_ >= Status::kRobotMode && fault_ <= Status::kProgramStopped;
  for (int i = 0; by_robot && i < kMostWaits && robot_.connected() && robot_.stop().empty(); ++i) {
    robot_.wait(kWait_ns);
    robot_.receive();
  }
  Message text = why_;
  if (!robot_.stop().empty()) text << "; the robot says " << robot_.stop();
  return text;
}

void UrHal::close() {
  session_.close();
  robot_.close();
  dashboard_.close();
}

}  // namespace tactus::ur
