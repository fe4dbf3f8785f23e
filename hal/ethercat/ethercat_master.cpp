#include "hal/ethercat/ethercat_master.hpp"

#include "hal/cia402/hex.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::int64_t kSilence_ns = 100'000'000;  // before OP, as that of the start-up
constexpr std::int64_t kAnyTime_ns = std::int64_t{1} << 62;

}  // namespace

Status EthercatMaster::configure(const EthercatSettings& ethercat,
                                 const cia402::Cia402Settings& drive, const Tool& tool,
                                 CommandMode mode, int period_us, int arming_ms) {
  ethercat_ = &ethercat;
  drive_ = &drive;
  mode_ = mode;
  period_us_ = period_us;
  state_ = MasterState::kOff;
  TRY(judge_places());
  TRY(judge_times());
  return drives_.configure(drive, tool, period_us, arming_ms, why_);
}

Status EthercatMaster::judge_places() {
  why_ = Message("[ethercat] ");
  if (ethercat_->interface.empty()) {
    why_ << "interface is missing; `ip link` lists the network interfaces";
    return Status::kMissingKey;
  }
  std::array<bool, kDof> taken{};
  for (int j = 0; j < kDof; ++j) {
    const double place = ethercat_->slave[j];
    const int number = static_cast<int>(place);
    const bool whole = number == place && number >= 1 && number <= kDof;
    if (!whole || taken[static_cast<std::size_t>(number - 1)]) {
      why_ << "slave of joint " << j + 1 << " is " << place
           << "; the joints' slaves are the numbers 1 to " << kDof << " in any order";
      return Status::kBadValue;
    }
    taken[static_cast<std::size_t>(number - 1)] = true;
  }
  return Status::kOk;
}

Status EthercatMaster::judge_times() {
  why_ = Message("[ethercat] ");
  if (ethercat_->sync0_us >= period_us_) {
    why_ << "sync0_us is " << ethercat_->sync0_us << ", which must be less than the period of "
         << period_us_ << " us";
    return Status::kBadValue;
  }
  const int timeout_ms = ethercat_->timeout_ms(period_us_);
  if (1000 * timeout_ms <= 2 * period_us_) {
    why_ << "watchdog_ms is " << timeout_ms << ", which must be more than two periods of "
         << period_us_ << " us";
    return Status::kBadValue;
  }
  why_ = {};
  return Status::kOk;
}

void EthercatMaster::connect(const std::uint8_t* source, std::int64_t now_ns) {
  why_ = {};
  state_ = MasterState::kStartingUp;
  now_ns_ = -1;
  has_out_ = arrived_ = own_extra_ = stops_ = false;
  steady_ = cycles_ = asked_ = boxed_ = carried_ = 0;
  commands_ = {};
  startup_.exchange().set_source(source);
  startup_.begin(*ethercat_, *drive_, mode_, period_us_, now_ns);
}

Status EthercatMaster::connecting(std::int64_t now_ns) {
  if (state_ == MasterState::kEnteringOp) return operating(now_ns);
  const Status status = startup_.advance(now_ns);
  if (status != Status::kOk) return status;
  state_ = MasterState::kEnteringOp;
  since_ns_ = now_ns;
  sent_ns_ = now_ns - period_ns();
  due_ns_ = now_ns;
  cyclic_.start(startup_.image(), startup_.clock().all_have_clocks(), startup_.exchange().source());
  start_steering();
  start_clock(slack_ns());
  port_.reset();
  coe_.cancel();
  return Status::kArming;
}

/// Cycles with outputs that move nothing; then OP is requested, and awaited.
Status EthercatMaster::operating(std::int64_t now_ns) {
  if (now_ns < due_ns_) return Status::kArming;
  const CyclicFrame::Arrival arrival = close_cycle(sent_ns_, now_ns);
  sent_ns_ = now_ns;
  due_ns_ = in_step(now_ns + period_ns());
  if (cyclic_.missing() * period_ns() > kSilence_ns) return startup_.silent();
  bool all = true;
  for (const Slave& slave : slaves_) all = all && slave.al_status == kOperational;
  steady_ = arrival == CyclicFrame::Arrival::kInputs && all ? steady_ + 1 : 0;
  if (arrival == CyclicFrame::Arrival::kInputs)
    for (Slave& slave : slaves_) slave.data.decode(cyclic_.inputs(), slave.feedback);
  if (steady_ >= kSteady) {
    cia402::Feedbacks feedbacks;
    for (std::size_t j = 0; j < kDof; ++j) {
      slaves_[j].feedback.forget_what_has_gone();
      feedbacks[j] = slaves_[j].feedback;
    }
    drives_.set_velocity_units(startup_.findings().velocity_units);
    TRY(drives_.attach(mode_, feedbacks, why_));
    state_ = MasterState::kConnected;
    // Stamps of cycles that wait for their frames say nothing of the time that passes.
    start_clock(ethercat_->frame_wait_ms > 0 ? kAnyTime_ns : slack_ns());
    return Status::kOk;
  }
  if (now_ns - since_ns_ > ethercat_->state_ms * kMillisecond_ns) return not_operating();
  const Request op = Request::number(Command::kBwr, address_of(0, kAlControlReg), kOperational);
  compose(commands_, cycles_++ % kAgain == kBeforeOp ? &op : nullptr);
  return Status::kArming;
}

void EthercatMaster::receive(Frame& frame) {
  if (state_ == MasterState::kStartingUp) return startup_.exchange().receive(frame);
  if (state_ != MasterState::kOff) cyclic_.receive(frame);
}

bool EthercatMaster::take(Frame& frame) {
  if (state_ == MasterState::kStartingUp && startup_.exchange().take(frame)) return true;
  if (!has_out_) return false;
  has_out_ = false;
  frame = out_;
  return true;
}

/// Takes the state of the polled slave and the working counter of all slaves from the frame. A
/// slave that has left OP can be used again after the next connect().
void EthercatMaster::take_state() {
  Slave& slave = slaves_[static_cast<std::size_t>(asked_)];
  const bool answered = cyclic_.asked_counter() == 1;
  slave.unanswered = answered ? 0 : slave.unanswered + (slave.unanswered < kMostUnanswered);
  if (answered) {
    slave.al_status = cyclic_.asked_status();
    slave.al_code = cyclic_.asked_code();
  }
  const bool left = answered && slave.al_status != kOperational;
  if (state_ == MasterState::kConnected && (left || slave.unanswered == kMostUnanswered))
    slave.feedback.lost = Status::kConnectionLost;
  asked_ = asked_ + 1 == kDof ? 0 : asked_ + 1;
}

void EthercatMaster::take_mailbox() {
  if (own_extra_) return;
  Slave& slave = slaves_[static_cast<std::size_t>(boxed_)];
  can::Emergency emergency;
  const Answer answer = arrived_ ? cyclic_.extra() : Answer{};
  if (port_.take(slave.boxes, answer, emergency, now_ns_)) {
    slave.feedback.error_code = emergency.code;
    slave.feedback.emergency = slave.feedback.emergency || emergency.code != 0;
  }
  // Without its frame, or with a mailbox that was full, the request to the drive is repeated.
  if (answer.counter != 1) carried_ = 0;
  coe_.advance(now_ns_);
  const bool waits = coe_.progress() == CoeClient::Progress::kBusy || port_.busy();
  if (!waits) boxed_ = boxed_ + 1 == kDof ? 0 : boxed_ + 1;
}

void EthercatMaster::take_cycle() {
  const CyclicFrame::Arrival arrival = close_cycle(sampled_ns_, now_ns_);
  take_mailbox();
  LoopBound<kDof> slaves;
  for (Slave& slave : slaves_) {
    slaves.tick();
    slave.feedback.fresh = arrival == CyclicFrame::Arrival::kInputs;
    if (!slave.feedback.fresh) continue;
    const std::uint16_t emergency_code = slave.feedback.emergency ? slave.feedback.error_code : 0;
    slave.data.decode(cyclic_.inputs(), slave.feedback);
    if (slave.feedback.error_code == 0)
      slave.feedback.error_code = emergency_code;  // 603Fh follows later
  }
}

Status EthercatMaster::read(const CycleTime& now, RobotState& state) {
  if (state_ != MasterState::kConnected) return Status::kNotStarted;
  const bool first = now_ns_ < 0;
  now_ns_ = now.stamp_ns;
  if (first) sampled_ns_ = now_ns_;  // what it holds is of the start-up
  if (!first) take_cycle();
  cia402::Feedbacks feedbacks;
  LoopBound<kDof> slaves;
  for (std::size_t j = 0; j < kDof; ++j) {
    slaves.tick();
    if (first) slaves_[j].feedback.fresh = true;
    feedbacks[j] = slaves_[j].feedback;
    slaves_[j].feedback.emergency = false;
  }
  drives_.watch(feedbacks, sampled_ns_);
  carry_request();
  drives_.show(state);
  return Status::kOk;
}

void EthercatMaster::write(const RobotCommand& command) {
  if (state_ != MasterState::kConnected) return;
  stops_ = command.request == DriveRequest::kDisable;
  drives_.step(command, commands_, now_ns_);
  compose(commands_, nullptr);
  sampled_ns_ = now_ns_;
}

/// `extra` takes the place of the mailbox's datagram.
void EthercatMaster::compose(const cia402::DriveCommands& commands, const Request* extra) {
  LoopBound<kDof> slaves;
  for (std::size_t j = 0; j < kDof; ++j) {
    slaves.tick();
    slaves_[j].data.encode(commands[j], cyclic_.image());
  }
  own_extra_ = extra != nullptr;
  Slave& boxed = slaves_[static_cast<std::size_t>(boxed_)];
  const Slave& asked = slaves_[static_cast<std::size_t>(asked_)];
  cyclic_.compose(asked.boxes.station,
                  own_extra_ ? *extra : port_.next(boxed.boxes, cyclic_.room()), out_);
  has_out_ = true;
}

void EthercatMaster::leave() {
  if (state_ != MasterState::kConnected) {
    const bool began = state_ != MasterState::kOff && startup_.give_up();
    has_out_ = began && startup_.exchange().take(out_);
    state_ = MasterState::kOff;
    return;
  }
  RobotCommand stop;
  stop.mode = mode_;
  drives_.step(stop, commands_, now_ns_);
  const Request init = Request::number(Command::kBwr, address_of(0, kAlControlReg),
                                       static_cast<std::uint16_t>(AlState::kInit));
  compose(commands_, &init);
  state_ = MasterState::kOff;
}

/// Carries the SDO requests of the drives, one at a time. A mode that is mapped is written by the
/// cycle alone: a drive may refuse it by SDO.
void EthercatMaster::carry_request() {
  const cia402::ObjectRequest& request = drives_.request();
  if (request.number == 0 || request.number != carried_) {
    carried_ = request.number;
    if (request.number == 0) return;
    const Slave& slave = slaves_[static_cast<std::size_t>(request.joint)];
    const auto [index, sub, bytes] = request.object;
    if (index == cia402::kModeOfOperation.index && slave.data.commands_mode())
      return drives_.answer(request.value);
    const std::uint16_t room = slave.boxes.out_bytes;
    boxed_ = request.joint;
    port_.reset();
    if (request.writes) return coe_.download(room, index, sub, request.value, bytes, now_ns_);
    return coe_.upload(room, index, sub, now_ns_);
  }
  if (coe_.progress() == CoeClient::Progress::kBusy) return;
  if (coe_.progress() != CoeClient::Progress::kDone)
    return drives_.answer(0, {can::status_of(coe_.abort()), can::meaning(coe_.abort())});
  drives_.answer(coe_.value());
}

void EthercatMaster::start_clock(std::int64_t slack_ns) {
  bool has_64_bits = true;
  for (const Slave& slave : slaves_)
    if (slave.position == 0) has_64_bits = (slave.features & kHasLongClock) != 0;
  clock_.start(has_64_bits, slack_ns);
}

void EthercatMaster::start_steering() {
  steer_.start(period_ns());
  sync0_ = {};
  if (!ethercat_->has_sync0()) return;
  steer_.start(period_ns(), startup_.clock().phase_ns());
  sync0_.start(period_ns(), startup_.clock().phase_ns(), std::int64_t{1000} * ethercat_->sync0_us,
               startup_.clock().sync0_ns());
  in_step_ns_ = sent_ns_;
}

std::int64_t EthercatMaster::in_step(std::int64_t near_ns) const {
  if (!ethercat_->has_sync0()) return near_ns;
  const std::int64_t half_ns = period_ns() / 2;
  const std::int64_t rest_ns = (near_ns - in_step_ns_ + half_ns) % period_ns();
  return near_ns + half_ns - rest_ns - (rest_ns < 0 ? period_ns() : 0);
}

/// Closes the cycle of a frame that was sent after `sent_ns`. One whose clock does not run is
/// an old one: its inputs are none.
CyclicFrame::Arrival EthercatMaster::close_cycle(std::int64_t sent_ns, std::int64_t now_ns) {
  const CyclicFrame::Arrival arrival = cyclic_.close();
  arrived_ = arrival != CyclicFrame::Arrival::kNothing;
  const bool runs = state_ == MasterState::kConnected;
  if (runs) sync0_.count_frame();
  if (arrived_) take_state();
  if (!arrived_ || !cyclic_.has_reference()) return arrival;
  if (clock_.take(cyclic_.reference_ns(), sent_ns, now_ns) != ReferenceClock::Verdict::kRuns)
    return CyclicFrame::Arrival::kNothing;
  const std::int64_t reference_ns = clock_.time_ns();
  if (!runs) in_step_ns_ = sent_ns - steer_.error_of(reference_ns);
  if (runs) steer_.take(reference_ns);
  if (runs && ethercat_->has_sync0()) sync0_.take(reference_ns);
  return arrival;
}

/// The frames and the time of the reference clock go through its slave, the first of the line.
Message EthercatMaster::clock_text() const {
  Message text("the clock of slave 1 (0910h) ");
  text << (clock_.verdict() == ReferenceClock::Verdict::kStands ? "stands still" : "jumps")
       << ", its last good time is " << static_cast<std::size_t>(clock_.time_ns())
       << " ns: frames come back with old or wrong contents; check this drive, and what is between "
          "it and the computer";
  return text;
}

/// Names the clock that does not run, or the first slave that is not in OP, and why.
Status EthercatMaster::not_operating() {
  if (clock_.verdict() != ReferenceClock::Verdict::kRuns) {
    why_ = clock_text();
    return Status::kRefusedByRobot;
  }
  for (int j = 0; j < kDof; ++j) {
    const Slave& slave = slaves_[static_cast<std::size_t>(j)];
    if (slave.al_status == kOperational) continue;
    why_ = label(j);
    why_ << ": is in " << name(static_cast<AlState>(slave.al_status & kAlStateBits))
         << ", not in OP, after [ethercat] state_ms, " << ethercat_->state_ms
         << " ms: " << std::string_view(startup_.code_text(slave.al_code));
    return Status::kRefusedByRobot;
  }
  if (cyclic_.exchanged()) {
    why_ = Message("slave 1 does not show its clock (0910h): the working counter of FRMW is 0");
    return Status::kRefusedByRobot;
  }
  why_ = cyclic_.counter_text();
  why_ << ": a drive does not read or write its process data";
  return Status::kBusTimeout;
}

Message EthercatMaster::trouble() const {
  if (!why_.empty()) return why_;
  Message text = drives_.why();
  if (text.empty() && cyclic_.missing() > kMostUnanswered)
    text << "no frame came back in the last " << cyclic_.missing() << " cycles" << Startup::kCheck;
  if (clock_.verdict() != ReferenceClock::Verdict::kRuns)
    text << (text.empty() ? "" : "; ") << std::string_view(clock_text());
  int first = -1;  // joint whose slave is the first of the line that does not answer
  for (int j = 0; j < kDof; ++j)
    if (slave(j).unanswered > 0 && (first < 0 || slave(j).position < slave(first).position))
      first = j;
  if (first >= 0)
    text << (text.empty() ? "" : "; ") << "the first slave that does not answer is that of "
         << std::string_view(label(first)) << ": check its power and the cable to it";
  for (int j = 0; j < kDof; ++j) {
    const Slave& slave = slaves_[static_cast<std::size_t>(j)];
    if (slave.feedback.lost == Status::kOk || slave.al_code == 0) continue;
    text << (text.empty() ? "" : "; ") << std::string_view(label(j)) << " is in "
         << name(static_cast<AlState>(slave.al_status & kAlStateBits)) << ": "
         << al_code_text(slave.al_code) << " (" << cia402::hex(slave.al_code).c_str() << ")";
    break;
  }
  return text;
}

}  // namespace tactus::ethercat
