// UrHal: the cycle, then connecting and disconnecting.
#include "hal/ur/ur_hal.hpp"

#include <algorithm>
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

/// Waits for the packet of the cycle; if it does not arrive, the cycle begins without it. Without a
/// wire the cycles go on at the nominal period.
Status UrHal::wait(CycleTime& now) {
  constexpr int kMostWakes = 4;  // most pieces in which a packet may arrive
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

/// A running program still gets the command to end after the wire has failed.
Status UrHal::write(const RobotCommand& command) {
  session_.set_outputs(command.outputs);
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

void UrHal::configure(const UrSettings& settings, const Tool& given, int period_us, bool outputs) {
  sends_outputs_ = outputs;
  settings_ = &settings;
  given_ = given;
  period_us_ = period_us;
  drives_.configure(settings, given, period_us);
}

Status UrHal::connect(CommandMode mode) {
  static_cast<void>(disconnect());
  why_ = Message();
  listened_ = false;
  fault_ = open(mode);
  if (fault_ == Status::kOk)
    clock_.start(state_.timestamp_s, std::int64_t{1000} * period_us_);
  else
    close();
  return fault_;
}

Status UrHal::open(CommandMode mode) {
  if (mode != CommandMode::kPosition) {
    why_ = Message("the robot is commanded in positions only");
    return Status::kNotOffered;
  }
  TRY(check_rate());
  const UrSettings& set = *settings_;
  const Deadline deadline(set.connect_ms);
  TRY(session_.start(set.address.c_str(), set.rtde_port, 1e6 / period_us_, sends_outputs_, deadline,
                     why_));
  TRY(check_sensor());
  TRY(await_state(deadline));
  TRY(check_arm());
  TRY(drives_.connect(deadline));
  return await_calibration(deadline);
}

Status UrHal::check_rate() {
  if (period_us_ == 8000 || period_us_ == 2000) return Status::kOk;
  why_ = Message("[robot] period_us = ");
  why_ << period_us_ << ": a UR takes 8000, or 2000 with an e-Series";
  return Status::kNotOffered;
}

Status UrHal::check_sensor() {
  if (settings_->zero_force == ZeroForce::kOff || session_.version().major >= 5) return Status::kOk;
  why_ = Message("[ur] zero_force: a CB3 has no force sensor to set to zero; set it off");
  return Status::kNotOffered;
}

/// Finds what arming would refuse. An arm without power may have no valid position, and in motion
/// joints and tip may be of different times.
Status UrHal::check_arm() {
  if (!state_.running() || !state_.at_rest()) return Status::kOk;
  return check_before_program(given_, state_, settings_->tip_tolerance, why_);
}

/// Waits for the first data package.
Status UrHal::await_state(const Deadline& deadline) {
  for (std::int64_t left_ns = deadline.left_ns(); left_ns > 0; left_ns = deadline.left_ns()) {
    if (!session_.wait(left_ns)) break;
    int count = 0;
    TRY(session_.receive(state_, count, why_));
    if (count > 0) return Status::kOk;
  }
  why_ = Message("RTDE: no data package within ");
  why_ << deadline.whole_ms() << " ms; check the network or raise connect_ms";
  return Status::kBusTimeout;
}

/// A controller tells it within a second; the state is received meanwhile.
Status UrHal::await_calibration(const Deadline& deadline) {
  if (settings_->calibration == Calibration::kAny) return Status::kOk;
  RobotPort& robot = drives_.robot();
  while (robot.connected() && !robot.calibration().told && deadline.left_ns() > 0) {
    robot.wait(std::min<std::int64_t>(deadline.left_ns(), std::int64_t{1000} * period_us_));
    robot.receive();
    int count = 0;
    TRY(session_.receive(state_, count, why_));
  }
  return drives_.compare_arm(state_);
}

/// If the negative count does not arrive, the program brakes because no set-points arrive.
Status UrHal::disconnect() {
  drives_.end_program();
  close();
  if (fault_ == Status::kOk) fault_ = Status::kNotStarted;
  return Status::kOk;
}

void UrHal::close() {
  session_.close();
  drives_.close();
}

}  // namespace tactus::ur
