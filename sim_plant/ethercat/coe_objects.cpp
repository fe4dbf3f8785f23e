#include "sim_plant/ethercat/coe_objects.hpp"

#include <algorithm>

#include "hal/ethercat/protocol_coe.hpp"
#include "hal/ethercat/protocol_frame.hpp"
#include "sim_plant/ethercat/default_pdos.hpp"

namespace tactus::segment {

using can::SdoAbort;
using drives::find;
using drives::Found;
using drives::Slot;

namespace {

constexpr int kSmCount = 4;

/// Objects of SYNC, EMCY, heartbeat, SDO channel and PDO communication.
bool only_can(std::uint16_t index) {
  const std::uint16_t block = index & 0xFF00;
  return (index >= 0x1005 && index <= 0x1007) || (index >= 0x1014 && index <= 0x1017) ||
         index == 0x1019 || index == 0x1029 || block == 0x1200 || block == 0x1400 ||
         block == 0x1800;
}
bool is_assignment(std::uint16_t index) {
  return index == ethercat::kRxAssign || index == ethercat::kTxAssign;
}
bool is_mapping(std::uint16_t index) {
  const std::uint16_t base = index & 0xFFFC;
  return base == ethercat::kRxMapping || base == ethercat::kTxMapping;
}

/// An entry of a mapping: as over CAN, but with index 0 for padding, and without dummy objects.
drives::MappedEntry judge(std::uint32_t entry, bool outputs) {
  const auto bits = entry & 0xFFU;
  if (entry >> 8 == 0) {
    drives::MappedEntry padding;
    padding.bytes = bits / 8;
    if (bits == 0 || bits % 8 != 0) padding.abort = SdoAbort::kNotMappable;
    return padding;
  }
  drives::MappedEntry judged = drives::judge_entry(entry, outputs);
  if (judged.row == nullptr && judged.abort == SdoAbort::kNone)
    judged.abort = SdoAbort::kNotMappable;
  return judged;
}

}  // namespace

void CoeObjects::reset() {
  for (const bool outputs : {true, false}) {
    Assignment& assigned = assigned_[outputs ? 0 : 1];
    assigned = {};
    assigned.pdos[0] = outputs ? ethercat::kRxMapping : ethercat::kTxMapping;
    const std::uint32_t* const entries = outputs ? kDefaultOutputs.data() : kDefaultInputs.data();
    const std::size_t count = outputs ? kDefaultOutputs.size() : kDefaultInputs.size();
    const Slot first = find(assigned.pdos[0], 0).slot;
    dictionary_.set(first, static_cast<std::int64_t>(count));
    for (std::size_t i = 0; i < count; ++i)
      dictionary_.set(static_cast<Slot>(first + 1 + i), entries[i]);
  }
}

bool CoeObjects::has(std::uint16_t index) const {
  return index == ethercat::kSmTypes || is_assignment(index) ||
         (!only_can(index) && find(index, 0).has_index);
}

int CoeObjects::next(int index) const {
  int found = 0;
  const auto take = [&](std::uint16_t candidate) {
    if (candidate > index && !only_can(candidate) && (found == 0 || candidate < found))
      found = candidate;
  };
  for (const drives::Row& row : drives::kRows) take(row.index);
  for (const std::uint16_t own : {ethercat::kSmTypes, ethercat::kRxAssign, ethercat::kTxAssign})
    take(own);
  return found;
}

int CoeObjects::last_sub(std::uint16_t index) const {
  if (index == ethercat::kSmTypes) return kSmCount;
  if (is_assignment(index)) return kAssignable;
  int last = -1;
  for (const drives::Row& row : drives::kRows)
    if (row.index == index && !only_can(index)) last = std::max<int>(last, row.last);
  return last;
}

bool CoeObjects::entry(std::uint16_t index, std::uint8_t sub, ObjectEntry& found) const {
  const bool assigns = is_assignment(index);
  if (assigns || index == ethercat::kSmTypes) {
    found = {assigns && sub > 0 ? drives::Type::kU16 : drives::Type::kU8,
             assigns ? drives::kReadWrite : drives::kRead, assigns};
    return sub <= last_sub(index);
  }
  const Found at = find(index, sub);
  if (at.row == nullptr || only_can(index)) return false;
  found = {at.row->type, at.row->access, is_mapping(index)};
  return true;
}

SdoAbort CoeObjects::read(std::uint16_t index, std::uint8_t sub, drives::ObjectBytes& bytes) const {
  if (only_can(index)) return SdoAbort::kNoObject;
  if (index == ethercat::kSmTypes) {
    if (sub > kSmCount) return SdoAbort::kNoSubIndex;
    bytes.data[0] = sub == 0 ? std::uint8_t{kSmCount} : sub;  // mailbox out, in, outputs, inputs
    bytes.size = 1;
    return SdoAbort::kNone;
  }
  if (!is_assignment(index)) return drives::read_object(dictionary_, index, sub, bytes);
  const Assignment& assigned = assignment(index == ethercat::kRxAssign);
  if (sub > kAssignable) return SdoAbort::kNoSubIndex;
  bytes.size = sub == 0 ? 1 : 2;
  if (sub == 0) bytes.data[0] = assigned.count;
  if (sub > 0) ethercat::put(bytes.data.data(), assigned.pdos[sub - 1U]);
  return SdoAbort::kNone;
}

SdoAbort CoeObjects::write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* data,
                           std::size_t size, bool preop, bool powered) {
  if (only_can(index)) return SdoAbort::kNoObject;
  if (index == ethercat::kSmTypes)
    return sub > kSmCount ? SdoAbort::kNoSubIndex : SdoAbort::kReadOnly;
  if ((is_assignment(index) || is_mapping(index)) && !preop) return SdoAbort::kDeviceState;
  if (is_assignment(index)) return write_assignment(index == ethercat::kRxAssign, sub, data, size);
  if (is_mapping(index)) return write_mapping(index, sub, data, size);
  drives::DeviceState state;
  state.nmt = can::NmtState::kPreOperational;
  state.powered = powered;
  return drives::write_object(dictionary_, state, index, sub, data, size);
}

/// Changed only while no PDO is assigned; the number comes last.
SdoAbort CoeObjects::write_assignment(bool outputs, std::uint8_t sub, const std::uint8_t* data,
                                      std::size_t size) {
  Assignment& assigned = assigned_[outputs ? 0 : 1];
  if (sub > kAssignable) return SdoAbort::kNoSubIndex;
  const std::size_t needed = sub == 0 ? 1 : 2;
  if (size != needed) return size > needed ? SdoAbort::kTooLong : SdoAbort::kTooShort;
  if (sub == 0) {
    if (data[0] > kAssignable) return SdoAbort::kTooHigh;
    std::size_t bytes = 0;
    for (int i = 0; i < data[0]; ++i) {
      const std::uint16_t pdo = assigned.pdos[static_cast<std::size_t>(i)];
      if (pdo == 0) return SdoAbort::kRange;
      bytes += pdo_bytes(pdo);
    }
    if (bytes > kMostPdoBytes) return SdoAbort::kPdoLength;
    assigned.count = data[0];
    return SdoAbort::kNone;
  }
  if (assigned.count != 0) return SdoAbort::kDeviceState;
  const auto pdo = ethercat::get<std::uint16_t>(data);
  const std::uint16_t base = outputs ? ethercat::kRxMapping : ethercat::kTxMapping;
  if (pdo != 0 && (pdo & 0xFFFC) != base) return SdoAbort::kRange;
  assigned.pdos[sub - 1U] = pdo;
  return SdoAbort::kNone;
}

/// Changed only while its PDO is not assigned; entries only while their number is 0.
SdoAbort CoeObjects::write_mapping(std::uint16_t index, std::uint8_t sub, const std::uint8_t* data,
                                   std::size_t size) {
  const SdoAbort access = drives::judge_access(index, sub, size);
  if (access != SdoAbort::kNone) return access;
  const bool outputs = index < ethercat::kTxMapping;
  const Assignment& assigned = assignment(outputs);
  for (int i = 0; i < assigned.count; ++i)
    if (assigned.pdos[static_cast<std::size_t>(i)] == index) return SdoAbort::kDeviceState;
  const Found found = find(index, sub);
  const auto first = static_cast<Slot>(found.slot - sub);
  const std::int64_t value = drives::decode(found.row->type, data);
  if (sub != 0) {
    if (dictionary_.get(first) != 0) return SdoAbort::kDeviceState;
    const SdoAbort judged = judge(static_cast<std::uint32_t>(value), outputs).abort;
    if (judged != SdoAbort::kNone) return judged;
  } else {
    if (value > drives::kMappable) return SdoAbort::kTooHigh;
    std::size_t bytes = 0;
    for (std::int64_t i = 1; i <= value; ++i) {
      const auto entry = static_cast<std::uint32_t>(dictionary_.get(static_cast<Slot>(first + i)));
      const drives::MappedEntry judged = judge(entry, outputs);
      if (judged.abort != SdoAbort::kNone) return judged.abort;
      bytes += judged.bytes;
    }
    if (bytes > kMostPdoBytes) return SdoAbort::kPdoLength;
  }
  dictionary_.write(found.slot, value);
  return SdoAbort::kNone;
}

std::size_t CoeObjects::pdo_bytes(std::uint16_t index) const {
  const Slot first = find(index, 0).slot;
  std::size_t bits = 0;
  for (std::int64_t i = 1; i <= dictionary_.get(first); ++i)
    bits += static_cast<std::size_t>(dictionary_.get(static_cast<Slot>(first + i))) & 0xFFU;
  return bits / 8;
}

ProcessData CoeObjects::process_data(bool outputs) const {
  ProcessData data;
  const Assignment& assigned = assignment(outputs);
  for (int i = 0; i < assigned.count; ++i) {
    const Slot first = find(assigned.pdos[static_cast<std::size_t>(i)], 0).slot;
    for (std::int64_t k = 1; k <= dictionary_.get(first); ++k) {
      const auto entry = static_cast<std::uint32_t>(dictionary_.get(static_cast<Slot>(first + k)));
      const drives::MappedEntry judged = judge(entry, outputs);
      if (data.count == data.entries.size() || data.bytes + judged.bytes > kMostPdoBytes)
        return data;
      data.entries[data.count++] = {judged.row, judged.slot, judged.bytes};
      data.bytes += judged.bytes;
    }
  }
  return data;
}

}  // namespace tactus::segment
