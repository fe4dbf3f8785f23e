#include "sim_plant/ethercat/drive_slave.hpp"

#include <cstring>

#include "sim_plant/drives/injected_values.hpp"

namespace tactus::segment {

using namespace ethercat;
using drives::Slot;
using drives::slot_of;

namespace {

constexpr Slot kControlword = slot_of(0x6040), kStatus = slot_of(0x6041),
               kErrorCode = slot_of(0x603F), kVelocityOffset = slot_of(0x60B1);
constexpr std::size_t kMailboxOutSm = 0, kMailboxInSm = 1, kOutputsSm = 2, kInputsSm = 3;

}  // namespace

void DriveSlave::power_on(const SlaveSettings& settings) {
  settings_ = settings;
  dictionary_.reset(settings.number);
  objects_.reset();
  const auto identity = [this](std::uint8_t sub) {
    return static_cast<std::uint32_t>(dictionary_.get(drives::find(can::kIdentity, sub).slot));
  };
  image_.compose({identity(1), identity(2), identity(3), identity(4)}, settings.places);
  esc_.power_on(image_, settings.clock, settings.lrw);
  errors_.reset();
  axis_.power_on(settings.axis);
  server_.reset(settings.places.mailbox_in_bytes);
  state_ = AlState::kInit;
  error_ = awaits_outputs_ = has_outputs_ = false;
  outputs_ = inputs_ = {};
}

void DriveSlave::serve(std::int64_t now_ns) {
  std::uint16_t control = 0;
  if (esc_.take_request(control)) request(control, now_ns);
  if (state_ >= AlState::kPreop && now_ns >= stored_ns_) serve_mailbox(now_ns);
  if (state_ >= AlState::kSafeop && esc_.take_outputs()) take_outputs();
}

void DriveSlave::advance(std::int64_t now_ns, std::int64_t periods) {
  periods_ = periods;
  esc_.advance(now_ns);
  if (esc_.take_expired() && state_ == AlState::kOp) {
    fall(kAlWatchdog);
    raise(drives::kCommunicationLost);
  }
  if (awaits_outputs_ && now_ns - requested_ns_ > kOutputs_ns) {
    awaits_outputs_ = false;
    refuse(kAlNoOutputs);
  }
  inject();
}

void DriveSlave::serve_mailbox(std::int64_t now_ns) {
  const SyncManager in = esc_.sm(kMailboxOutSm);
  const std::uint8_t* const bytes = esc_.bytes(kMailboxOutSm);
  if (in.enabled() && in.full() && bytes != nullptr) {
    const std::uint16_t index =
        in.length >= kCoeBody + 3 ? get<std::uint16_t>(bytes + kCoeBody + 1) : 0;
    const drives::Fault* silence = faults_.active(drives::FaultKind::kSdoSilence, periods_);
    const drives::Fault* refusal = faults_.active(drives::FaultKind::kSdoAbort, periods_);
    server_.refuse(
        refusal != nullptr ? static_cast<std::uint16_t>(refusal->value) : std::uint16_t{0},
        static_cast<can::SdoAbort>(refusal != nullptr ? refusal->abort : 0));
    const bool silent = silence != nullptr && (silence->value == 0 || silence->value == index);
    const bool preop = state_ == AlState::kPreop;
    CoeResult result;
    if (!silent) {
      const bool reads = (bytes[kCoeBody] & can::kSpecifier) == can::kUpload;
      if (reads) {
        const drives::InjectedValues injected(dictionary_, faults_, periods_);
        result = server_.receive(bytes, in.length, preop, axis_.powered());
      } else {
        result = server_.receive(bytes, in.length, preop, axis_.powered());
      }
    }
    esc_.set_full(kMailboxOutSm, false);
    if (result.written) note_written(result);
    if (result.written && result.index == 0x1010) stored_ns_ = now_ns + settings_.store_ns;
  }
  if (now_ns >= stored_ns_) post_mailbox();
}

/// Puts the next message into the mailbox of answers if that is empty.
void DriveSlave::post_mailbox() {
  const SyncManager out = esc_.sm(kMailboxInSm);
  std::uint8_t* const bytes = esc_.bytes(kMailboxInSm);
  MailboxMessage message;
  if (!out.enabled() || out.full() || bytes == nullptr || !server_.take(message)) return;
  const std::size_t size = message.size < out.length ? message.size : out.length;
  std::memset(bytes, 0, out.length);
  std::memcpy(bytes, message.bytes.data(), size);
  esc_.set_full(kMailboxInSm, true);
}

void DriveSlave::note_written(const CoeResult& result) {
  if (result.index == can::kErrorHistory)
    for (std::uint8_t i = 1; i <= drives::kErrorsKept; ++i)
      dictionary_.set(drives::find(can::kErrorHistory, i).slot, 0);
  if (result.index == 0x6060) axis_.follow_mode();
  if (result.index == 0x6040) apply_controlword();
}

/// Takes the outputs into force; values out of their range are left out. The controlword last.
void DriveSlave::take_outputs() {
  has_outputs_ = true;
  if (awaits_outputs_) {
    awaits_outputs_ = false;
    enter(AlState::kOp);
  }
  const std::uint8_t* bytes = esc_.bytes(kOutputsSm);
  if (state_ != AlState::kOp || bytes == nullptr || esc_.sm(kOutputsSm).length < outputs_.bytes)
    return;
  bool commanded = false;
  for (std::size_t i = 0; i < outputs_.count; bytes += outputs_.entries[i++].bytes) {
    const MappedObject& entry = outputs_.entries[i];
    if (entry.row == nullptr) continue;
    const std::int64_t value = drives::decode(entry.row->type, bytes);
    if (value < drives::lowest(*entry.row) || value > drives::highest(*entry.row)) continue;
    if (entry.row->index == 0x6060 && !drives::has_mode(value)) continue;
    dictionary_.set(entry.slot, value);
    if (entry.row->index == 0x6060) axis_.follow_mode();
    commanded = commanded || entry.slot == kControlword;
  }
  if (commanded) apply_controlword();
}

void DriveSlave::apply_controlword() {
  const bool gone = !errors_.present(drives::kCommunicationLost) || state_ == AlState::kOp;
  const auto word = static_cast<std::uint16_t>(dictionary_.get(kControlword));
  if (axis_.command(word, gone))
    while (const std::uint16_t code = errors_.first_latched()) clear(code);
  show_state();
}

void DriveSlave::show_state() {
  unsigned word = axis_.statusword();
  const bool fault = axis_.state() == cia402::State::kFault ||
                     axis_.state() == cia402::State::kFaultReactionActive;
  if (errors_.any() && !fault) word |= cia402::kWarning;
  dictionary_.set(kStatus, word);
}

void DriveSlave::raise(std::uint16_t code) {
  can::Emergency emergency;
  if (errors_.raise(code, dictionary_, emergency)) {
    dictionary_.set(kErrorCode, code);
    if (state_ >= AlState::kPreop) server_.emergency(emergency);
  }
  axis_.trip();
  show_state();
}

void DriveSlave::clear(std::uint16_t code) {
  can::Emergency emergency;
  if (!errors_.clear(code, dictionary_, emergency)) return;
  dictionary_.set(kErrorCode, errors_.first());
  if (state_ >= AlState::kPreop) server_.emergency(emergency);
  show_state();
}

void DriveSlave::begin_period(const drives::JointSample& sample, double period_s) {
  bool mapped = false;  // the master's own feed-forward
  for (std::size_t i = 0; i < outputs_.count; ++i)
    mapped = mapped || outputs_.entries[i].slot == kVelocityOffset;
  axis_.stick_brake(faults_.active(drives::FaultKind::kBrakeStuck, periods_) != nullptr);
  const drives::Fault* const fails = faults_.active(drives::FaultKind::kHomingFails, periods_);
  axis_.spoil_homing(static_cast<drives::HomingFault>(fails != nullptr ? fails->value & 3U : 0U));
  if (const std::uint16_t code = axis_.begin_period(sample, period_s, !mapped)) raise(code);
}

void DriveSlave::measure(const drives::JointSample& sample) {
  axis_.report(sample);
  show_state();
  std::uint8_t* bytes = esc_.bytes(kInputsSm);
  if (state_ < AlState::kSafeop || bytes == nullptr || esc_.sm(kInputsSm).length < inputs_.bytes)
    return;
  const drives::InjectedValues injected(dictionary_, faults_, periods_);
  for (std::size_t i = 0; i < inputs_.count; bytes += inputs_.entries[i++].bytes)
    if (const MappedObject& entry = inputs_.entries[i]; entry.row != nullptr)
      drives::encode(entry.row->type, dictionary_.get(entry.slot), bytes);
}

/// Faults of the drive that happen once.
void DriveSlave::inject() {
  if (const drives::Fault* fault = faults_.once(drives::FaultKind::kEmergency, periods_))
    raise(fault->value != 0 ? static_cast<std::uint16_t>(fault->value) : std::uint16_t{0xFF00});
  if (faults_.once(drives::FaultKind::kSwitchOnDisabled, periods_) != nullptr) axis_.disable();
  if (faults_.once(drives::FaultKind::kReboot, periods_) != nullptr) power_on(settings_);
}

}  // namespace tactus::segment
