// EthercatMaster: what it asks the drives, how it judges the clock of the segment, and what it says
// of a fault.
#include "hal/cia402/hex.hpp"
#include "hal/ethercat/ethercat_master.hpp"

namespace tactus::ethercat {

/// Carries what is asked of a drive, one request at a time. A mode that is mapped is written by the
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
  steer_.start(period_ns(), startup_.phase_ns());
  sync0_.start(period_ns(), startup_.phase_ns(), std::int64_t{1000} * ethercat_->sync0_us,
               startup_.sync0_ns());
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
CyclicFrame::Came EthercatMaster::close_cycle(std::int64_t sent_ns, std::int64_t now_ns) {
  const CyclicFrame::Came came = cyclic_.close();
  arrived_ = came != CyclicFrame::Came::kNothing;
  const bool runs = phase_ == Phase::kRuns;
  if (runs) sync0_.count_frame();
  if (arrived_) take_state();
  if (!arrived_ || !cyclic_.has_reference()) return came;
  if (clock_.take(cyclic_.reference_ns(), sent_ns, now_ns) != ReferenceClock::Verdict::kRuns)
    return CyclicFrame::Came::kNothing;
  const std::int64_t reference_ns = clock_.time_ns();
  if (!runs) in_step_ns_ = sent_ns - steer_.error_of(reference_ns);
  if (runs) steer_.take(reference_ns);
  if (runs && ethercat_->has_sync0()) sync0_.take(reference_ns);
  return came;
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
