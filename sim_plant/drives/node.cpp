#include "sim_plant/drives/node.hpp"

#include <algorithm>

#include "sim_plant/drives/dictionary.hpp"
#include "sim_plant/drives/injected_values.hpp"

namespace tactus::drives {

using can::CanFrame;
using can::NmtCommand;
using can::NmtState;

namespace {

constexpr Slot kSyncCob = slot_of(can::kSyncIdObject),
               kHeartbeat = slot_of(can::kHeartbeatProducer), kStatus = slot_of(0x6041);

}  // namespace

void Node::load(const NodeSettings& settings, FrameQueue& queue, std::int64_t now_ns) {
  settings_ = settings;
  queue_ = &queue;
  device_.pdo_bytes = settings.fd ? can::kMaxData : can::kClassicData;
  syncs_ = 0;
  reset(NmtCommand::kResetNode, now_ns);
}

/// The boot-up message follows boot_ns later.
void Node::reset(NmtCommand command, std::int64_t now_ns) {
  if (command == NmtCommand::kResetNode) {
    dictionary_.reset(settings_.node);
    errors_.reset();
    axis_.power_on(settings_.axis);
  } else {
    if (axis_.powered()) lose_master();
    dictionary_.reset_communication(settings_.node);
    for (const std::uint16_t code :
         {kHeartbeatLost, kPdoTooShort, kPdoTooLong, kSyncLength, kRpdoTimeout, kSyncMissing})
      clear(code);
  }
  sdo_.reset();
  watched_ = {};
  holds_ = {};
  guard_toggle_ = false;
  load_pdos();
  device_.nmt = NmtState::kBootUp;
  boot_ns_ = now_ns + settings_.boot_ns;
}

void Node::receive(const CanFrame& frame, std::int64_t now_ns) {
  if (device_.nmt == NmtState::kBootUp) return;
  if (frame.remote) return answer_remote(frame.id, now_ns);
  if (frame.id == can::kNmtId) return take_nmt(frame, now_ns);
  if (frame.id == can::kSdoRequestBase + settings_.node) return take_sdo(frame, now_ns);
  if (frame.id > can::kHeartbeatBase && frame.id <= can::kHeartbeatBase + can::kMaxNode)
    return take_heartbeat(frame, now_ns);
  take_rpdo(frame, now_ns);
}

void Node::take_nmt(const CanFrame& frame, std::int64_t now_ns) {
  if (frame.size != 2 || (frame.data[1] != 0 && frame.data[1] != settings_.node)) return;
  switch (static_cast<NmtCommand>(frame.data[0])) {
    case NmtCommand::kStart: return enter(NmtState::kOperational, now_ns);
    case NmtCommand::kStop: return enter(NmtState::kStopped, now_ns);
    case NmtCommand::kPreOperational: return enter(NmtState::kPreOperational, now_ns);
    case NmtCommand::kResetNode:
    case NmtCommand::kResetCommunication:
      return reset(static_cast<NmtCommand>(frame.data[0]), now_ns);
  }
}

void Node::enter(NmtState state, std::int64_t now_ns) {
  if (state == device_.nmt) return;
  const bool was_operational = operational();
  device_.nmt = state;
  if (state == NmtState::kStopped) {
    sdo_.reset();
    if (axis_.powered()) lose_master();
  }
  if (state == NmtState::kOperational) return begin_operation(now_ns);
  if (!was_operational) return;
  sync_deadline_ns_ = 0;
  for (Rpdo& rpdo : rpdos_) rpdo.deadline_ns = 0;
}

void Node::take_sdo(const CanFrame& frame, std::int64_t now_ns) {
  if (device_.nmt == NmtState::kStopped) return;
  const auto index = can::load<std::uint16_t>(frame.data, 1);
  const Fault* silence = faults_.active(FaultKind::kSdoSilence, syncs_);
  if (silence != nullptr && (silence->value == 0 || silence->value == index)) return;
  const Fault* refusal = faults_.active(FaultKind::kSdoAbort, syncs_);
  if (refusal != nullptr && (refusal->value == 0 || refusal->value == index)) {
    sdo_.reset();
    return queue_->push(SdoServer::abort_frame(settings_.node, index, frame.data[3],
                                               static_cast<can::SdoAbort>(refusal->abort)));
  }
  device_.powered = axis_.powered();
  SdoAnswer answer;
  if ((frame.data[0] & can::kSpecifier) == can::kUpload) {
    const InjectedValues injected(dictionary_, faults_, syncs_);
    answer = sdo_.receive(frame, now_ns, settings_.node, dictionary_, device_);
  } else {
    answer = sdo_.receive(frame, now_ns, settings_.node, dictionary_, device_);
  }
  if (answer.written && answer.index == 0x1010) {
    stored_ = answer.frame;
    stored_ns_ = now_ns + settings_.store_ns;
    return;
  }
  if (answer.sent) queue_->push(answer.frame);
  if (answer.written) note_written(answer.index, answer.sub, now_ns);
}

/// Objects whose new value has an effect beyond being stored.
void Node::note_written(std::uint16_t index, std::uint8_t sub, std::int64_t now_ns) {
  if (index >= can::kRpdoCommunication && index < 0x1C00) load_pdo(index);
  if (index == can::kErrorHistory)
    for (std::uint8_t i = 1; i <= kErrorsKept; ++i)
      dictionary_.set(find(can::kErrorHistory, i).slot, 0);
  if (index == can::kHeartbeatConsumer) watch_anew(sub);
  if (index == can::kHeartbeatProducer)
    heartbeat_ns_ = now_ns + dictionary_.get(kHeartbeat) * 1'000'000;
  if (index == 0x6060) axis_.follow_mode();
  if (index == 0x6040) apply_controlword();
}

void Node::apply_controlword() {
  const bool gone = !errors_.present(kHeartbeatLost) && !errors_.present(kRpdoTimeout) &&
                    !errors_.present(kSyncMissing);
  const auto word = static_cast<std::uint16_t>(dictionary_.get(kControlword));
  if (axis_.command(word, gone))
    while (const std::uint16_t code = errors_.first_latched()) clear(code);
  show_state();
}

void Node::show_state() {
  unsigned word = axis_.statusword();
  const bool fault = axis_.state() == cia402::State::kFault ||
                     axis_.state() == cia402::State::kFaultReactionActive;
  if (errors_.any() && !fault) word |= cia402::kWarning;
  dictionary_.set(kStatus, word);
}

void Node::send_heartbeat(std::int64_t now_ns) {
  const std::int64_t period_ns = dictionary_.get(kHeartbeat) * 1'000'000;
  if (period_ns == 0 || now_ns < heartbeat_ns_) return;
  heartbeat_ns_ = std::max(heartbeat_ns_ + period_ns, now_ns);  // a stall is not caught up
  if (faults_.active(FaultKind::kStopHeartbeat, syncs_) == nullptr)
    queue_->push(can::heartbeat_frame(settings_.node, device_.nmt));
}

/// Node guarding, and TPDOs on request.
void Node::answer_remote(std::uint16_t id, std::int64_t now_ns) {
  if (id == can::kHeartbeatBase + settings_.node && dictionary_.get(kHeartbeat) == 0) {
    CanFrame answer = can::heartbeat_frame(settings_.node, device_.nmt);
    if (guard_toggle_) answer.data[0] |= 0x80;
    guard_toggle_ = !guard_toggle_;
    queue_->push(answer);
  }
  if (!operational()) return;
  for (Tpdo& tpdo : tpdos_)
    if (tpdo.settings.valid && tpdo.settings.remote && tpdo.settings.id == id)
      send_tpdo(tpdo, now_ns);
}

void Node::advance(std::int64_t now_ns) {
  if (device_.nmt == NmtState::kBootUp) {
    if (now_ns < boot_ns_) return;
    device_.nmt = NmtState::kPreOperational;
    queue_->push(can::heartbeat_frame(settings_.node, NmtState::kBootUp));
    heartbeat_ns_ = now_ns + dictionary_.get(kHeartbeat) * 1'000'000;
    if (settings_.starts) enter(NmtState::kOperational, now_ns);
  }
  send_heartbeat(now_ns);
  if (stored_ns_ != 0 && now_ns >= stored_ns_) {
    stored_ns_ = 0;
    queue_->push(stored_);
  }
  const SdoAnswer late = sdo_.advance(now_ns, settings_.node);
  if (late.sent) queue_->push(late.frame);
  watch(now_ns);
  inject(now_ns);
  if (operational()) send_events(now_ns);
}

void Node::begin_period(const JointSample& sample, double period_s, std::int64_t now_ns) {
  bool mapped = false;  // the master's own feed-forward
  for (const Rpdo& rpdo : rpdos_)
    for (int i = 0; i < rpdo.settings.count && rpdo.settings.valid; ++i)
      mapped = mapped || rpdo.settings.entries[static_cast<std::size_t>(i)].slot == kVelocityOffset;
  axis_.stick_brake(faults_.active(FaultKind::kBrakeStuck, syncs_) != nullptr);
  const Fault* const fails = faults_.active(FaultKind::kHomingFails, syncs_);
  axis_.spoil_homing(static_cast<HomingFault>(fails != nullptr ? fails->value & 3U : 0U));
  const std::uint16_t code = axis_.begin_period(sample, period_s, !mapped);
  if (code != 0) raise(code, true);
  inject(now_ns);
}

void Node::measure(const JointSample& sample) {
  axis_.report(sample);
  show_state();
}

std::uint16_t Node::sync_id() const {
  return static_cast<std::uint16_t>(dictionary_.get(kSyncCob) & 0x7FF);
}

using can::NmtState;

namespace {

constexpr Slot kErrorCode = slot_of(0x603F), kEmcyCob = slot_of(can::kEmcyIdObject),
               kBehaviour = slot_of(can::kErrorBehaviour, 1),
               kConsumer = slot_of(can::kHeartbeatConsumer);

}  // namespace

void Node::send(const can::Emergency& emergency) {
  const bool speaks = device_.nmt == NmtState::kPreOperational || operational();
  const std::int64_t cob = dictionary_.get(kEmcyCob);
  if (!speaks || (cob & kInvalid) != 0) return;
  can::CanFrame frame;
  frame.id = static_cast<std::uint16_t>(cob & 0x7FF);
  frame.size = can::kEmergencySize;
  can::store(frame.data, 0, emergency.code);
  frame.data[2] = emergency.error_register;
  queue_->push(frame);
}

/// Notes an error and sends its EMCY; it `faults` the axis, or is only a warning.
void Node::raise(std::uint16_t code, bool faults) {
  can::Emergency emergency;
  if (errors_.raise(code, dictionary_, emergency)) {
    dictionary_.set(kErrorCode, code);
    send(emergency);
  }
  if (faults) axis_.trip();
  show_state();
}

void Node::clear(std::uint16_t code) {
  can::Emergency emergency;
  if (!errors_.clear(code, dictionary_, emergency)) return;
  dictionary_.set(kErrorCode, errors_.first());
  send(emergency);
  show_state();
}

/// NMT has taken the drive from its master: reaction of 6007h.
void Node::lose_master() {
  if (axis_.abort_connection()) raise(kCommunicationLost, true);
  show_state();
}

void Node::take_heartbeat(const can::CanFrame& frame, std::int64_t now_ns) {
  const std::int64_t node = frame.id - can::kHeartbeatBase;
  if (frame.size != 1 || frame.data[0] == static_cast<std::uint8_t>(NmtState::kBootUp)) return;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const std::int64_t entry = dictionary_.get(static_cast<Slot>(kConsumer + 1 + i));
    if ((entry >> 16 & 0x7F) != node || (entry & 0xFFFF) == 0) continue;
    watched_[i].deadline_ns = now_ns + (entry & 0xFFFF) * 1'000'000;
    find_heartbeat_again(watched_[i]);
  }
}

/// An entry of 1016h has been written: it waits for its next heartbeat.
void Node::watch_anew(std::uint8_t entry) {
  Watched& watched = watched_[static_cast<std::size_t>(entry - 1)];
  watched.deadline_ns = 0;
  find_heartbeat_again(watched);
}

void Node::find_heartbeat_again(Watched& watched) {
  watched.lost = false;
  for (const Watched& each : watched_)
    if (each.lost) return;
  clear(kHeartbeatLost);
}

void Node::watch(std::int64_t now_ns) {
  for (Watched& watched : watched_) {
    if (watched.deadline_ns == 0 || now_ns < watched.deadline_ns) continue;
    watched.deadline_ns = 0;  // until the next heartbeat
    watched.lost = true;
    raise(kHeartbeatLost, false);
    if (axis_.abort_connection()) axis_.trip();
    show_state();
    const std::int64_t behaviour = dictionary_.get(kBehaviour);
    if (behaviour == 0 && operational()) enter(NmtState::kPreOperational, now_ns);
    if (behaviour == 2) enter(NmtState::kStopped, now_ns);
  }
  if (!operational()) return;
  if (sync_deadline_ns_ != 0 && now_ns >= sync_deadline_ns_) {
    sync_deadline_ns_ = 0;
    raise(kSyncMissing, true);
  }
  for (Rpdo& rpdo : rpdos_) {
    if (rpdo.deadline_ns == 0 || now_ns < rpdo.deadline_ns) continue;
    rpdo.deadline_ns = 0;
    raise(kRpdoTimeout, true);
  }
}

/// Faults that happen once.
void Node::inject(std::int64_t now_ns) {
  if (const Fault* fault = faults_.once(FaultKind::kEmergency, syncs_))
    raise(fault->value != 0 ? static_cast<std::uint16_t>(fault->value) : std::uint16_t{0xFF00},
          true);
  if (faults_.once(FaultKind::kSwitchOnDisabled, syncs_) != nullptr) axis_.disable();
  if (faults_.once(FaultKind::kReboot, syncs_) != nullptr)
    reset(can::NmtCommand::kResetNode, now_ns);
}

}  // namespace tactus::drives
