#include "sim_plant/drives/object_access.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "hal/cia402/protocol.hpp"

namespace tactus::drives {
namespace {

using can::NmtState;
using can::SdoAbort;

constexpr std::int64_t kExtendedId = 0x20000000, kIdBits = 0x7FF;

std::string_view text_of(std::uint16_t index) {
  switch (index) {
    case can::kDeviceName: return "Tactus emulated servo drive";
    case can::kHardwareVersion: return "emulated";
    default: return "1.0.0";
  }
}

/// Identifiers that CiA 301 (7.3.5) reserves.
bool is_restricted(std::int64_t id) {
  return id <= 0x07F || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) ||
         (id >= 0x601 && id <= 0x67F) || (id >= 0x6E0 && id <= 0x6FF) || id >= 0x701;
}

/// Of PDO and EMCY: bit 31 makes it invalid; while it is valid its identifier does not change.
SdoAbort judge_id(std::int64_t before, std::int64_t after) {
  if ((after & kExtendedId) != 0 || (after & ~(kInvalid | kNoRemote | kIdBits)) != 0)
    return SdoAbort::kRange;
  if ((after & kInvalid) != 0) return SdoAbort::kNone;
  if (is_restricted(after & kIdBits)) return SdoAbort::kRange;
  const bool moved = ((before ^ after) & kIdBits) != 0;
  return (before & kInvalid) == 0 && moved ? SdoAbort::kDeviceState : SdoAbort::kNone;
}

bool receives(std::uint16_t index) {
  return index < can::kTpdoCommunication;
}

SdoAbort judge_communication(const Dictionary& dictionary, const DeviceState& state,
                             std::uint16_t index, std::uint8_t sub, std::int64_t value) {
  const bool valid = is_valid_pdo(dictionary, index);
  switch (sub) {
    case can::kPdoId: {
      const SdoAbort abort = judge_id(dictionary.get(find(index, sub).slot), value);
      if (abort != SdoAbort::kNone) return abort;
      return state.nmt == NmtState::kOperational ? SdoAbort::kDeviceState : SdoAbort::kNone;
    }
    case can::kPdoType:
      if (value > 240 && value < 252) return SdoAbort::kRange;
      return receives(index) && value > 240 && value < 254 ? SdoAbort::kRange : SdoAbort::kNone;
    case can::kPdoEventTimer: return SdoAbort::kNone;
    default: return valid ? SdoAbort::kDeviceState : SdoAbort::kNone;  // inhibit, SYNC start
  }
}

SdoAbort judge_mapping(const Dictionary& dictionary, const DeviceState& state, std::uint16_t index,
                       std::uint8_t sub, std::int64_t value) {
  const bool in = receives(index);
  const auto communication = static_cast<std::uint16_t>(index - 0x200);
  if (is_valid_pdo(dictionary, communication) || state.nmt == NmtState::kOperational)
    return SdoAbort::kDeviceState;
  const Slot first = find(index, 0).slot;
  if (sub != 0)
    return dictionary.get(first) != 0 ? SdoAbort::kDeviceState
                                      : judge_entry(static_cast<std::uint32_t>(value), in).abort;
  std::size_t bytes = 0;
  for (std::int64_t i = 1; i <= value; ++i) {
    const auto slot = static_cast<Slot>(first + i);
    const MappedEntry entry = judge_entry(static_cast<std::uint32_t>(dictionary.get(slot)), in);
    if (entry.abort != SdoAbort::kNone) return entry.abort;
    bytes += entry.bytes;
  }
  return bytes > state.pdo_bytes ? SdoAbort::kPdoLength : SdoAbort::kNone;
}

/// A node must be watched only once (CiA 301, 7.5.2.19).
SdoAbort judge_consumer(const Dictionary& dictionary, std::uint8_t sub, std::int64_t value) {
  const std::int64_t node = value >> 16 & 0x7F;
  if (node == 0 || (value & 0xFFFF) == 0) return SdoAbort::kNone;
  for (std::uint8_t i = 1; i <= kHeartbeatsWatched; ++i) {
    const std::int64_t other = dictionary.get(find(can::kHeartbeatConsumer, i).slot);
    if (i != sub && (other >> 16 & 0x7F) == node && (other & 0xFFFF) != 0)
      return SdoAbort::kIncompatible;
  }
  return SdoAbort::kNone;
}

/// What the table does not say.
SdoAbort judge_special(const Dictionary& dictionary, const DeviceState& state, std::uint16_t index,
                       std::uint8_t sub, std::int64_t value) {
  const bool pdo = (index & 0xF1FC) == 0x1000 && index >= 0x1400 && index < 0x1C00;
  if (pdo && (index & 0x0200) != 0) return judge_mapping(dictionary, state, index, sub, value);
  if (pdo) return judge_communication(dictionary, state, index, sub, value);
  switch (index) {
    case can::kSyncIdObject:  // it cannot produce SYNC: bit 30
      return (value & ~kIdBits) != 0 || is_restricted(value) ? SdoAbort::kRange : SdoAbort::kNone;
    case can::kEmcyIdObject: return judge_id(dictionary.get(find(index, 0).slot), value);
    case can::kHeartbeatConsumer: return judge_consumer(dictionary, sub, value);
    case can::kSyncCounter:
      if (value == 1) return SdoAbort::kRange;
      return dictionary.get(slot_of(can::kSyncPeriod)) != 0 ? SdoAbort::kDeviceState
                                                            : SdoAbort::kNone;
    case 0x1010: return value == cia402::kSaveSignature ? SdoAbort::kNone : SdoAbort::kNotStored;
    case 0x6060: return has_mode(value) ? SdoAbort::kNone : SdoAbort::kRange;
    default: return SdoAbort::kNone;
  }
}

/// What a drive keeps of a value that it takes.
std::int64_t kept(std::uint16_t index, std::uint8_t sub, std::int64_t value) {
  if (index == 0x1010) return 1;
  return index == 0x2003 && sub == 5 ? value / 2 * 2 : value;
}

}  // namespace

bool has_mode(std::int64_t mode) {
  return mode == 0 || mode == 6 || (mode >= 8 && mode <= 10);
}

MappedEntry judge_entry(std::uint32_t entry, bool receives) {
  const auto index = static_cast<std::uint16_t>(entry >> 16);
  const auto sub = static_cast<std::uint8_t>(entry >> 8);
  const std::size_t bits = entry & 0xFF;
  MappedEntry judged;
  constexpr std::uint8_t kDummyBits[] = {8, 16, 32, 8, 16, 32};  // 0002h to 0007h
  if (index >= 0x0001 && index <= 0x0007) {
    const bool fits = index > 1 && sub == 0 && receives && bits == kDummyBits[index - 2];
    judged.abort = fits ? SdoAbort::kNone : SdoAbort::kNotMappable;
    judged.bytes = bits / 8;
    return judged;
  }
  const Found found = find(index, sub);
  judged.row = found.row;
  judged.slot = found.slot;
  judged.bytes = bits / 8;
  if (found.row == nullptr) {
    judged.abort = found.has_index ? SdoAbort::kNoSubIndex : SdoAbort::kNoObject;
    return judged;
  }
  const bool mappable = (found.row->access & (receives ? kRpdo : kTpdo)) != 0;
  if (!mappable || bits != 8 * size_of(found.row->type)) judged.abort = SdoAbort::kNotMappable;
  return judged;
}

can::SdoAbort read_object(const Dictionary& dictionary, std::uint16_t index, std::uint8_t sub,
                          ObjectBytes& bytes) {
  const Found found = find(index, sub);
  if (found.row == nullptr) return found.has_index ? SdoAbort::kNoSubIndex : SdoAbort::kNoObject;
  if (found.row->type == Type::kText) {
    const std::string_view text = text_of(index);
    bytes.size = std::min(text.size(), bytes.data.size());
    std::memcpy(bytes.data.data(), text.data(), bytes.size);
    return SdoAbort::kNone;
  }
  if (index == can::kErrorHistory && sub > dictionary.get(slot_of(can::kErrorHistory)))
    return SdoAbort::kNoData;
  bytes.size = size_of(found.row->type);
  encode(found.row->type, dictionary.get(found.slot), bytes.data.data());
  return SdoAbort::kNone;
}

can::SdoAbort judge_access(std::uint16_t index, std::uint8_t sub, std::size_t size) {
  const Found found = find(index, sub);
  if (found.row == nullptr) return found.has_index ? SdoAbort::kNoSubIndex : SdoAbort::kNoObject;
  if ((found.row->access & kWrite) == 0) return SdoAbort::kReadOnly;
  if (size == 0) return SdoAbort::kNone;
  if (size > size_of(found.row->type)) return SdoAbort::kTooLong;
  return size < size_of(found.row->type) ? SdoAbort::kTooShort : SdoAbort::kNone;
}

can::SdoAbort write_object(Dictionary& dictionary, const DeviceState& state, std::uint16_t index,
                           std::uint8_t sub, const std::uint8_t* data, std::size_t size) {
  const SdoAbort access = judge_access(index, sub, size);
  if (access != SdoAbort::kNone) return access;
  const Found found = find(index, sub);
  const std::int64_t value = decode(found.row->type, data);
  if (value > highest(*found.row)) return SdoAbort::kTooHigh;
  if (value < lowest(*found.row)) return SdoAbort::kTooLow;
  if ((found.row->access & kAtRest) != 0 && state.powered) return SdoAbort::kDeviceState;
  const SdoAbort special = judge_special(dictionary, state, index, sub, value);
  if (special != SdoAbort::kNone) return special;
  dictionary.write(found.slot, kept(index, sub, value));
  return SdoAbort::kNone;
}

}  // namespace tactus::drives
