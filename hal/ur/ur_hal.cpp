// UrHal: its cycle.
#include "hal/ur/ur_hal.hpp"

#include <ctime>

#include "hal/ur/flange_wrench.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ur {
namespace {

void pause(std::int64_t time_ns) {
  const timespec time = {time_ns / kSecond_ns, time_ns % kSecond_ns};
  nanosleep(&time, nullptr);
}

}  // namespace

static_assert(kDof == 6, "a UR arm has six joints");

Capabilities UrHal::capabilities() const {
  Capabilities offered;
  offered.position = offered.wrench = true;
  offered.outputs = (1u << kDigitalOutputNames.size()) - 1;
  offered.min_period_us = 2000;
  offered.max_period_us = 8000;
  return offered;
}

/// Waits for the packet of the cycle; if it does not come, the cycle begins without it. Without a
/// wire the cycles go on at the nominal period.
Status UrHal::wait(CycleTime& now) {
  constexpr int kMostWakes = 4;  // a packet may come in up to so many pieces
  if (period_us_ <= 0) return Status::kClock;
  if (fault_ != Status::kOk) pause(std::int64_t{1000} * period_us_);
  Received came = Received::kNothing;
  for (int i = 0; i < kMostWakes && came == Received::kNothing && fault_ == Status::kOk; ++i) {
    if (!session_.wait(clock_.patience_ns(settings_->packet_wait))) break;
    came = receive();
  }
  if (came != Received::kCycle) clock_.bridge();
  now.stamp_ns = clock_.stamp_ns();
  return Status::kOk;
}

UrHal::Received UrHal::receive() {
  int count = 0;
  fault_ = session_.receive(state_, count, why_);
  if (fault_ != Status::kOk || count == 0) return Received::kNothing;
  switch (clock_.packet(state_.timestamp_s)) {
    case PacketClock::Arrival::kCycle: return Received::kCycle;
    case PacketClock::Arrival::kLate: return Received::kNothing;
    case PacketClock::Arrival::kRepeated: return Received::kNothingNew;
    case PacketClock::Arrival::kBackwards: break;
  }
  why_ = Message("the robot's clock jumped to ");
  why_ << state_.timestamp_s << " s; the controller was probably restarted";
  fault_ = Status::kClock;
  return Received::kNothing;
}

Status UrHal::read(const CycleTime&, RobotState& state) {
  if (fault_ == Status::kOk) fault_ = judge_silence();
  if (fault_ != Status::kOk) return fault_;
  drives_.watch(state_);
  show(state);
  return Status::kOk;
}

Status UrHal::judge_silence() {
  if (clock_.missed() <= settings_->max_missed) return Status::kOk;
  why_ = Message("RTDE: no new packet for ");
  why_ << clock_.missed() << (clock_.missed() == 1 ? " period" : " periods") << ", limit "
       << settings_->max_missed << ", since time stamp " << state_.timestamp_s
       << " s; check the network and the load of this computer";
  return Status::kBusTimeout;
}

void UrHal::show(RobotState& state) {
  state.q = state_.q;
  state.dq = state_.dq;
  state.tau = state_.moment;
  state.ft = flange_wrench(state_, assumed(given_), session_.version());
  state.speed_scaling = time_scaling(state_.speed_scaling, state_.speed_fraction);
  state.stamp_ns = clock_.packet_ns();
  state.drives.fill(drives_.drive());
  if (drives_.phase() != DrivePhase::kFault) listened_ = false;
}

/// Without a wire that works, a program that runs is still told to end.
Status UrHal::write(const RobotCommand& command) {
  session_.put_out(command.outputs);
  if (fault_ == Status::kOk) fault_ = drives_.step(command, state_);
  if (fault_ != Status::kOk) drives_.end_program();
  return fault_;
}

const char* UrHal::output_name(int output) const {
  const auto i = static_cast<std::size_t>(output);
  return i < kDigitalOutputNames.size() ? kDigitalOutputNames[i] : nullptr;
}

Message UrHal::trouble() {
  constexpr int kMostWaits = 20;
  constexpr std::int64_t kWait_ns = 10'000'000;
  RobotPort& robot = drives_.robot();
  const bool listens = drives_.stopped_by_robot() && !listened_;
  for (int i = 0; listens && i < kMostWaits && robot.connected() && robot.stop().empty(); ++i) {
    robot.wait(kWait_ns);
    robot.receive();
  }
  listened_ = true;
  Message text = why_;
  if (!robot.stop().empty()) text << "; the robot reports " << robot.stop();
  return text;
}

}  // namespace tactus::ur
