#include "hal/ethercat/startup.hpp"

#include "hal/cia402/hex.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

/// Registers that are reset in all slaves, as an earlier master may have written them. A slave need
/// not have all of them.
struct RegisterReset {
  std::uint16_t reg;
  std::uint8_t bytes;
  std::uint16_t value;
};
constexpr RegisterReset kRegisterResets[] = {
    {kDlControlReg + 3, 1, 0},                               // no alias addresses
    {kFmmuReg, kFmmuBytes * 8, 0},                           //
    {kSmReg, kSmBytes * 8, 0},                               //
    {kDcControlReg, 2, 0},                                   // no SYNC pulses
    {kErrorCountersReg, 8, 0},                               //
    {kTimeOffsetReg, 12, 0},                                 // offset and delay
    {kEepromOwnerReg, 1, 2},       {kEepromOwnerReg, 1, 0},  // the EEPROM is the master's
};
constexpr int kRegisterResetCount = static_cast<int>(std::size(kRegisterResets));

constexpr int kProcessSteps = 6;

Request sm_request(std::uint16_t station, int sm, std::uint16_t start, std::size_t length,
                   std::uint8_t control) {
  const auto reg = static_cast<std::uint16_t>(kSmReg + int{kSmBytes} * sm);
  Request request(Command::kFpwr, address_of(station, reg), kSmBytes);
  put(&request.data[0], start);
  put(&request.data[2], static_cast<std::uint16_t>(length));
  request.data[4] = control;
  request.data[6] = length > 0 ? kSmEnabled : 0;
  return request;
}

Request fmmu_request(std::uint16_t station, int fmmu, std::size_t logical, std::size_t length,
                     std::uint16_t physical, std::uint8_t type) {
  const auto reg = static_cast<std::uint16_t>(kFmmuReg + int{kFmmuBytes} * fmmu);
  Request request(Command::kFpwr, address_of(station, reg), kFmmuBytes);
  put(&request.data[0], static_cast<std::uint32_t>(kImageAddress + logical));
  put(&request.data[4], static_cast<std::uint16_t>(length));
  request.data[7] = 7;  // last bit
  put(&request.data[8], physical);
  request.data[11] = type;
  request.data[12] = length > 0 ? 1 : 0;
  return request;
}

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
    line_.set(slave.position, j);
  }
  coe_.cancel();
  port_.reset();
  image_.lrw = true;
  clock_.reset(ethercat, period_us);
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
    case Stage::kEeprom: return eeprom_.next();
    case Stage::kMailboxes: return mailbox_request();
    case Stage::kPreop: return state_request(AlState::kPreop);
    case Stage::kIdentify:
    case Stage::kSetup:
    case Stage::kMapping: return port_.next(at().boxes, kMaxData);
    case Stage::kProcessData: return process_request();
    case Stage::kSafeop: return state_request(AlState::kSafeop);
    default: return clock_.request();
  }
}

Request Startup::clear_request() const {
  const RegisterReset& row = kRegisterResets[step_];
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
      if (++step_ == kRegisterResetCount) enter(Stage::kStation);
      break;
    case Stage::kStation:
      if (answer.counter != 1) return refuse(Status::kBusTimeout, "takes no address");
      next_slave(Stage::kStation, Stage::kFeatures);
      break;
    case Stage::kFeatures: return take_features(answer);
    case Stage::kEeprom: return take_eeprom(answer);
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
    case Stage::kSafeop: return await_state(answer, AlState::kSafeop);
    default: return take_clocks(answer);
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

Status Startup::take_features(const Answer& answer) {
  if (answer.counter != 1) return refuse(Status::kBusTimeout, "does not answer to its address");
  at().features = answer.word(8);
  image_.lrw = image_.lrw && (at().features & kNoLrw) == 0;
  TRY(clock_.judge(at_));
  stage_ = Stage::kEeprom;
  eeprom_.begin(at());
  return Status::kOk;
}

Status Startup::take_eeprom(const Answer& answer) {
  Message what;
  const Status status = eeprom_.take(answer, what);
  if (status == Status::kArming) return Status::kOk;
  if (status != Status::kOk) return refuse(status, what);
  stage_ = Stage::kMailboxes;
  step_ = 0;
  return Status::kOk;
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

Request Startup::mailbox_request() const {
  const Slave& slave = at();
  const Mailboxes& boxes = slave.boxes;
  if (step_ == 0)
    return sm_request(boxes.station, 0, boxes.out, boxes.out_bytes, slave.mailbox_out_control);
  return sm_request(boxes.station, 1, boxes.in, boxes.in_bytes, slave.mailbox_in_control);
}

/// The watchdog covers the outputs, regardless of the EEPROM.
Request Startup::process_request() const {
  const Slave& slave = at();
  const std::uint16_t station = slave.boxes.station;
  const ProcessData& data = slave.data;
  const auto outputs = static_cast<std::uint8_t>(slave.outputs.control | kSmWatchdog);
  const int units = 10 * ethercat_->timeout_ms(period_us_);  // of 100 us
  switch (step_) {
    case 0:
      return sm_request(station, slave.outputs.sm, slave.outputs.start, data.outputs.bytes(),
                        outputs);
    case 1:
      return sm_request(station, slave.inputs.sm, slave.inputs.start, data.inputs.bytes(),
                        slave.inputs.control);
    case 2:
      return fmmu_request(station, 0, data.out_at, data.outputs.bytes(), slave.outputs.start,
                          kFmmuWrite);
    case 3:
      return fmmu_request(station, 1, data.in_at, data.inputs.bytes(), slave.inputs.start,
                          kFmmuRead);
    case 4:
      return Request::number(Command::kFpwr, address_of(station, kWatchdogDividerReg),
                             kDivider100us);
    default:
      return Request::number(Command::kFpwr, address_of(station, kDataWatchdogReg),
                             static_cast<std::uint16_t>(units));
  }
}

Status Startup::take_process_data() {
  if (exchange_.answer().counter != 1)
    return refuse(Status::kRefusedByRobot, "does not take its sync managers, FMMUs and watchdog");
  if (++step_ < kProcessSteps) return Status::kOk;
  next_slave(Stage::kProcessData, clock_.all_have_clocks() ? Stage::kClocks : Stage::kSafeop);
  if (stage_ == Stage::kClocks) clock_.begin(now_ns_);
  return Status::kOk;
}

/// Outputs of all joints, then inputs of all.
Status Startup::place_image() {
  image_.outputs = image_.inputs = 0;
  for (Slave& slave : slaves_) {
    slave.data.out_at = image_.outputs;
    image_.outputs += slave.data.outputs.bytes();
  }
  for (Slave& slave : slaves_) {
    slave.data.in_at = image_.bytes();
    image_.inputs += slave.data.inputs.bytes();
  }
  if (image_.bytes() <= kMostImage) return Status::kOk;
  why_ = Message("the process data of all drives have ");
  why_ << image_.bytes() << " bytes, at most " << kMostImage;
  return Status::kTooLarge;
}

Status Startup::take_clocks(const Answer& answer) {
  const Status status = clock_.take(answer, now_ns_);
  if (status == Status::kArming) return Status::kOk;
  if (status == Status::kOk) enter(Stage::kSafeop);
  return status;
}

Message Startup::code_text(std::uint16_t code) const {
  Message text(al_code_text(code));
  text << " (" << std::string_view(cia402::hex(code)) << ")";
  if (!ethercat_->has_sync0() && concerns_sync0(code))
    text << "; add [ethercat] sync0_us, for example " << period_us_ / 2 << ", half of the period";
  return text;
}

}  // namespace tactus::ethercat
