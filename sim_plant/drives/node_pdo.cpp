// The PDOs of a drive: reception, SYNC, events.
#include <algorithm>

#include "sim_plant/drives/dictionary.hpp"
#include "sim_plant/drives/injected_values.hpp"
#include "sim_plant/drives/node.hpp"

namespace tactus::drives {

using can::CanFrame;

namespace {

constexpr Slot kSyncPeriod = slot_of(can::kSyncPeriod), kSyncWindow = slot_of(can::kSyncWindow),
               kCounter = slot_of(can::kSyncCounter);

}  // namespace

void Node::load_pdos() {
  for (std::uint16_t i = 0; i < kPdos; ++i) {
    load_pdo(static_cast<std::uint16_t>(can::kRpdoCommunication + i));
    load_pdo(static_cast<std::uint16_t>(can::kTpdoCommunication + i));
  }
}

/// Reads the parameters of a PDO again, of which `index` is one record.
void Node::load_pdo(std::uint16_t index) {
  const std::uint16_t i = index & (kPdos - 1);
  const auto at = [i](std::uint16_t base) { return static_cast<std::uint16_t>(base + i); };
  if (index < can::kTpdoCommunication)
    rpdos_[i].settings.load(dictionary_, at(can::kRpdoCommunication), at(can::kRpdoMapping));
  else
    tpdos_[i].settings.load(dictionary_, at(can::kTpdoCommunication), at(can::kTpdoMapping));
}

void Node::begin_operation(std::int64_t now_ns) {
  sync_deadline_ns_ = 0;
  for (Rpdo& rpdo : rpdos_) {
    rpdo.fresh = false;
    rpdo.deadline_ns = 0;
  }
  for (Tpdo& tpdo : tpdos_) {
    tpdo.sent_once = false;
    tpdo.counting = tpdo.settings.start == 0;
    tpdo.syncs = 0;
    tpdo.earliest_ns = 0;
    tpdo.next_event_ns = now_ns + tpdo.settings.event_ns;
  }
}

/// Returns true if the frame is one of its PDOs.
bool Node::take_rpdo(const CanFrame& frame, std::int64_t now_ns) {
  if (!operational()) return false;
  bool mine = false;
  for (Rpdo& rpdo : rpdos_) {
    const PdoSettings& pdo = rpdo.settings;
    if (!pdo.valid || pdo.id != frame.id) continue;
    mine = true;
    if (frame.size < pdo.bytes) {
      raise(kPdoTooShort, false);
      continue;
    }
    clear(kPdoTooShort);
    const std::size_t padded = frame.fd ? can::fd_size(pdo.bytes) : pdo.bytes;
    if (frame.size > padded)
      raise(kPdoTooLong, false);
    else
      clear(kPdoTooLong);
    clear(kRpdoTimeout);
    rpdo.deadline_ns = pdo.event_ns != 0 ? now_ns + pdo.event_ns : 0;
    rpdo.received = frame.data;
    if (pdo.synchronous())
      rpdo.fresh = true;
    else
      apply(pdo, rpdo.received);
  }
  return mine;
}

/// Writes the objects of an RPDO; values out of their range are left out. The controlword last.
void Node::apply(const PdoSettings& pdo, const std::array<std::uint8_t, can::kMaxData>& data) {
  std::size_t at = 0;
  bool commanded = false;
  for (int i = 0; i < pdo.count; ++i) {
    const MappedEntry& entry = pdo.entries[static_cast<std::size_t>(i)];
    const std::size_t here = at;
    at += entry.bytes;
    if (entry.row == nullptr) continue;
    const std::int64_t value = decode(entry.row->type, data.data() + here);
    if (value < lowest(*entry.row) || value > highest(*entry.row)) continue;
    if (entry.slot == kMode && !has_mode(value)) continue;
    dictionary_.set(entry.slot, value);
    commanded = commanded || entry.slot == kControlword;
    if (entry.slot == kMode) axis_.follow_mode();
  }
  if (commanded) apply_controlword();
}

void Node::receive_sync(const CanFrame& frame, std::int64_t now_ns, const JointSample& sample) {
  ++syncs_;
  if (device_.nmt == can::NmtState::kBootUp) return;
  const bool counted = dictionary_.get(kCounter) != 0;
  if (frame.size != (counted ? 1 : 0)) return operational() ? raise(kSyncLength, false) : void();
  clear(kSyncLength);
  clear(kSyncMissing);
  inject(now_ns);
  if (operational()) {
    const std::int64_t period_us = dictionary_.get(kSyncPeriod);
    const std::int64_t late_us = std::max(dictionary_.get(kSyncWindow), period_us / 2);
    sync_deadline_ns_ = period_us != 0 ? now_ns + (period_us + late_us) * 1000 : 0;
    for (Rpdo& rpdo : rpdos_) {
      if (!rpdo.fresh) continue;
      rpdo.fresh = false;
      apply(rpdo.settings, rpdo.received);
    }
  }
  measure(sample);
  if (operational()) send_on_sync(frame, now_ns);
}

void Node::send_on_sync(const CanFrame& frame, std::int64_t now_ns) {
  for (Tpdo& tpdo : tpdos_) {
    const PdoSettings& pdo = tpdo.settings;
    if (!pdo.valid || !pdo.synchronous()) continue;
    if (!tpdo.counting && frame.size == 1) tpdo.counting = frame.data[0] == pdo.start;
    if (!tpdo.counting && frame.size == 1) continue;
    ++tpdo.syncs;
    const bool due = pdo.type == 0 ? !tpdo.sent_once || tpdo.last != pack(dictionary_, pdo)
                                   : tpdo.syncs >= pdo.type;
    if (!due) continue;
    tpdo.syncs = 0;
    send_tpdo(tpdo, now_ns);
  }
}

/// TPDOs of types 254 and 255: on change, not within the inhibit time, and by the event timer.
void Node::send_events(std::int64_t now_ns) {
  for (Tpdo& tpdo : tpdos_) {
    const PdoSettings& pdo = tpdo.settings;
    if (!pdo.valid || pdo.type < 254 || now_ns < tpdo.earliest_ns) continue;
    const bool timer = pdo.event_ns != 0 && now_ns >= tpdo.next_event_ns;
    const bool changed = !tpdo.sent_once || tpdo.last != pack(dictionary_, pdo);
    if (timer || changed) send_tpdo(tpdo, now_ns);
  }
}

void Node::send_tpdo(Tpdo& tpdo, std::int64_t now_ns) {
  const PdoSettings& pdo = tpdo.settings;
  tpdo.last = pack(dictionary_, pdo);
  tpdo.sent_once = true;
  tpdo.next_event_ns = now_ns + pdo.event_ns;
  tpdo.earliest_ns = now_ns + pdo.inhibit_ns;
  CanFrame frame;
  frame.id = pdo.id;
  frame.fd = settings_.fd;
  frame.size = static_cast<std::uint8_t>(frame.fd ? can::fd_size(pdo.bytes) : pdo.bytes);
  {
    const InjectedValues injected(dictionary_, faults_, syncs_);
    frame.data = pack(dictionary_, pdo);
  }
  push_tpdo(tpdo, frame);
}

/// Sends a TPDO as injected faults make it.
void Node::push_tpdo(Tpdo& tpdo, CanFrame frame) {
  const auto i = static_cast<std::size_t>(&tpdo - tpdos_.data());
  if (holds_[i]) queue_->push(held_[i]);
  holds_[i] = faults_.active(FaultKind::kDelayTpdo, syncs_) != nullptr;
  if (faults_.active(FaultKind::kTruncateTpdo, syncs_) != nullptr && frame.size > 0) --frame.size;
  if (holds_[i]) {
    held_[i] = frame;
    return;
  }
  if (faults_.active(FaultKind::kDropTpdo, syncs_) != nullptr) return;
  queue_->push(frame);
  if (faults_.active(FaultKind::kDuplicateTpdo, syncs_) != nullptr) queue_->push(frame);
}

}  // namespace tactus::drives
