// What a drive watches: heartbeats, SYNC, its command PDOs; errors, their EMCY and their reactions.
#include <algorithm>

#include "sim_plant/drives/node.hpp"

namespace tactus::drives {

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
