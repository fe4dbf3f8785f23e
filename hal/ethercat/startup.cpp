#include "hal/ethercat/startup.hpp"

#include "hal/cia402/hex.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

/// Registers that are cleared in all slaves: what an earlier master has left. A slave need not have
/// all of them.
struct Cleared {
  std::uint16_t reg;
  std::uint8_t bytes;
  std::uint16_t value;
};
constexpr Cleared kCleared[] = {
    {kDlControlReg + 3, 1, 0},                               // no alias addresses
    {kFmmuReg, kFmmuBytes * 8, 0},                           //
    {kSmReg, kSmBytes * 8, 0},                               //
    {kDcControlReg, 2, 0},                                   // no SYNC pulses
    {kErrorCountersReg, 8, 0},                               //
    {kTimeOffsetReg, 12, 0},                                 // offset and delay
    {kEepromOwnerReg, 1, 2},       {kEepromOwnerReg, 1, 0},  // the EEPROM is the master's
};
constexpr int kClearedCount = static_cast<int>(std::size(kCleared));

}  // namespace

void Startup::begin(const EthercatSettings& ethercat, const cia402::Cia402Settings& drive,
                    CommandMode mode, int period_us, std::int64_t now_ns) {
  ethercat_ = &ethercat;
  drive_ = &drive;
  mode_ = mode;
  period_us_ = period_us;
  now_ns_ = now_ns;
  for (int j = 0; j < kDof; ++j) {
    Slave& slave = slaves_[static_cast<std::size_t>(j)];
    slave = {};
    slave.position = static_cast<int>(ethercat.slave[j]) - 1;
    slave.boxes.station = static_cast<std::uint16_t>(kFirstStation + slave.position);
    order_[static_cast<std::size_t>(slave.position)] = j;
  }
  coe_.cancel();
  port_.reset();
  has_clocks_ = image_.lrw = true;
  phase_ns_ = apart_ns_ = 0;
  enter(Stage::kCount);
  exchange_.ask(request(), now_ns);
}

void Startup::enter(Stage stage) {
  stage_ = stage;
  at_ = step_ = attempts_ = 0;
  since_ns_ = now_ns_;
}

/// The same stages with the next slave, or the stage after them.
void Startup::next_slave(Stage again, Stage then) {
  const int next = at_ + 1;
  enter(next < kDof ? again : then);
  if (next < kDof) at_ = next;
}

Status Startup::advance(std::int64_t now_ns) {
  now_ns_ = now_ns;
  exchange_.advance(now_ns);
  coe_.advance(now_ns);
  if (exchange_.progress() == Exchange::Progress::kBusy) return Status::kArming;
  if (exchange_.progress() == Exchange::Progress::kLost) return silent();
  TRY(take(exchange_.answer()));
  if (stage_ == Stage::kDone) return Status::kOk;
  exchange_.ask(request(), now_ns);
  return Status::kArming;
}

bool Startup::give_up() {
  if (stage_ == Stage::kCount) return false;
  exchange_.ask(Request::number(Command::kBwr, address_of(0, kAlControlReg),
                                static_cast<std::uint16_t>(AlState::kInit)),
                now_ns_);
  return true;
}

Status Startup::refuse(Status status, std::string_view what) {
  why_ = label(joint(), at());
  why_ << ": " << what;
  return status;
}

Status Startup::silent() {
  why_ = Message("no frame came back from the segment");
  why_ << kCheck;
  return Status::kBusTimeout;
}

Request Startup::request() {
  const std::uint32_t station = address_of(at().boxes.station, 0);
  switch (stage_) {
    case Stage::kCount: return Request(Command::kBrd, address_of(0, kTypeReg), 1);
    case Stage::kInit:
      return Request::number<std::uint16_t>(
          Command::kBwr, address_of(0, kAlControlReg),
          static_cast<std::uint16_t>(AlState::kInit) | kAlErrorBit);
    case Stage::kAwaitInit: return Request(Command::kBrd, address_of(0, kAlStatusReg), 2);
    case Stage::kClear: return clear_request();
    case Stage::kStation:
      return Request::number(Command::kApwr, address_of(position_field(at_), kStationReg),
                             at().boxes.station);
    case Stage::kFeatures: return Request(Command::kFprd, station, 16);
    case Stage::kEeprom:
    case Stage::kCategories: return eeprom_.next();
    case Stage::kMailboxes: return area_request();
    case Stage::kPreop: return state_request(AlState::kPreop);
    case Stage::kIdentify:
    case Stage::kSetup:
    case Stage::kMapping: return port_.next(at().boxes, kMaxData);
    case Stage::kProcessData: return process_request();
    case Stage::kSync0: return sync0_request();
    case Stage::kSafeop: return state_request(AlState::kSafeop);
    default: return clock_request();
  }
}

Request Startup::clear_request() const {
  const Cleared& row = kCleared[step_];
  Request request(Command::kBwr, address_of(0, row.reg), row.bytes);
  put(request.data.data(), row.value);
  return request;
}

/// First the request, then the status until it is reached.
Request Startup::state_request(AlState state) const {
  const std::uint16_t station = at().boxes.station;
  if (step_ > 0) return Request(Command::kFprd, address_of(station, kAlStatusReg), 6);
  return Request::number(Command::kFpwr, address_of(station, kAlControlReg),
                         static_cast<std::uint16_t>(state));
}

Status Startup::take(const Answer& answer) {
  switch (stage_) {
    case Stage::kCount: return count(answer);
    case Stage::kInit: enter(Stage::kAwaitInit); break;
    case Stage::kAwaitInit: return await_init(answer);
    case Stage::kClear:
      if (++step_ == kClearedCount) enter(Stage::kStation);
      break;
    case Stage::kStation:
      if (answer.counter != 1) return refuse(Status::kBusTimeout, "takes no address");
      next_slave(Stage::kStation, Stage::kFeatures);
      break;
    case Stage::kFeatures:
      if (answer.counter != 1) return refuse(Status::kBusTimeout, "does not answer to its address");
      at().features = answer.word(8);
      image_.lrw = image_.lrw && (at().features & kNoLrw) == 0;
      has_clocks_ = has_clocks_ && at().has_clock();
      TRY(judge_clock());
      stage_ = Stage::kEeprom;
      step_ = 0;
      eeprom_.begin(at().boxes.station, kSiiVendor);
      break;
    case Stage::kEeprom: eeprom_.take(answer); return take_eeprom();
    case Stage::kCategories: eeprom_.take(answer); return take_category();
    case Stage::kMailboxes:
      if (++step_ == 2) {
        stage_ = Stage::kPreop;
        step_ = 0;
        since_ns_ = now_ns_;
      }
      break;
    case Stage::kPreop: return await_state(answer, AlState::kPreop);
    case Stage::kIdentify:
    case Stage::kSetup:
    case Stage::kMapping: return take_mailbox(answer);
    case Stage::kProcessData: return take_process_data();
    case Stage::kSync0: return take_sync0(answer);
    case Stage::kSafeop: return await_state(answer, AlState::kSafeop);
    default: return take_times(answer);
  }
  return Status::kOk;
}

/// Every slave adds 1 to the counter.
Status Startup::count(const Answer& answer) {
  if (answer.counter == kDof) {
    enter(Stage::kInit);
    return Status::kOk;
  }
  why_ = Message("the segment has ");
  why_ << answer.counter << " slaves, expected " << kDof << ", one for each joint" << kCheck;
  return Status::kBusTimeout;
}

Status Startup::await_init(const Answer& answer) {
  const bool all = answer.word() == static_cast<std::uint16_t>(AlState::kInit);
  if (all && answer.counter == kDof) {
    enter(Stage::kClear);
    return Status::kOk;
  }
  if (now_ns_ - since_ns_ <= ethercat_->state_ms * kMillisecond_ns) return Status::kOk;
  why_ = Message("not all slaves are in INIT within [ethercat] state_ms, ");
  why_ << ethercat_->state_ms << " ms: their states together are "
       << std::string_view(cia402::hex(answer.word())) << " of " << answer.counter << " slaves";
  return Status::kBusTimeout;
}

Status Startup::await_state(const Answer& answer, AlState state) {
  Message what;
  if (step_++ == 0) {
    if (answer.counter == 1) return Status::kOk;
    return refuse(Status::kBusTimeout, "does not answer to its address any more");
  }
  const std::uint16_t status = answer.word(), code = answer.word(4);
  if (answer.counter == 1 && (status & kAlErrorBit) != 0) {
    what << "refuses " << name(state) << ": " << std::string_view(code_text(code));
    return refuse(Status::kRefusedByRobot, what);
  }
  if (answer.counter == 1 && status == static_cast<std::uint16_t>(state)) {
    if (state == AlState::kSafeop) {
      next_slave(Stage::kSafeop, Stage::kDone);
      return Status::kOk;
    }
    begin_steps(Stage::kIdentify);
    return Status::kOk;
  }
  if (now_ns_ - since_ns_ <= ethercat_->state_ms * kMillisecond_ns) return Status::kOk;
  what << "is not in " << name(state) << " within [ethercat] state_ms, " << ethercat_->state_ms
       << " ms, but in " << name(static_cast<AlState>(status & kAlStateBits));
  return refuse(Status::kBusTimeout, what);
}

}  // namespace tactus::ethercat
