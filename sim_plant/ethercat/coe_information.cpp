#include "sim_plant/ethercat/coe_information.hpp"

#include <algorithm>
#include <cstring>

#include "hal/ethercat/protocol_coe.hpp"
#include "hal/ethercat/protocol_frame.hpp"

namespace tactus::segment {

using can::SdoAbort;

namespace {

constexpr std::size_t kHead = 4;               // opcode, reserved, fragments left
constexpr std::uint8_t kIncomplete = 0x80;     // of the opcode
constexpr std::uint16_t kLists = 5;            // all, RxPDO, TxPDO, for a replacement, for start-up
constexpr std::uint8_t kVar = 7, kRecord = 9;  // object codes of CiA 301
constexpr std::uint8_t kReadable = 0x07, kWritablePreop = 0x08, kWritableAlways = 0x38;
constexpr std::uint8_t kInRxPdo = 0x40, kInTxPdo = 0x80;

/// Numbers of the data types in CiA 301.
std::uint16_t number_of(drives::Type type) {
  switch (type) {
    case drives::Type::kI8: return 2;
    case drives::Type::kI16: return 3;
    case drives::Type::kI32: return 4;
    case drives::Type::kU8: return 5;
    case drives::Type::kU16: return 6;
    case drives::Type::kU32: return 7;
    case drives::Type::kText: break;
  }
  return 9;
}

bool is_listed(const CoeObjects& objects, std::uint16_t index, std::uint16_t list) {
  bool listed = false;
  ObjectEntry entry;
  for (int sub = 0; sub <= objects.last_sub(index); ++sub) {
    if (!objects.entry(index, static_cast<std::uint8_t>(sub), entry)) continue;
    listed = listed || list == 1 || (list == 2 && (entry.access & drives::kRpdo) != 0) ||
             (list == 3 && (entry.access & drives::kTpdo) != 0);
  }
  return listed;
}

}  // namespace

void CoeInformation::ask(const std::uint8_t* request, std::size_t size) {
  reset();
  const std::uint8_t opcode = size > 0 ? request[0] & 0x7F : 0;
  opcode_ = static_cast<std::uint8_t>(opcode + 1);
  if (size < kHead + 2) return fail(SdoAbort::kCommand);
  const auto number = ethercat::get<std::uint16_t>(request + kHead);
  switch (opcode) {
    case ethercat::kListRequest: return list(number);
    case ethercat::kDescriptionRequest: return describe(number);
    case ethercat::kEntryRequest:
      if (size < kHead + 4) return fail(SdoAbort::kCommand);
      return describe_entry(number, request[kHead + 2]);
    default: return fail(SdoAbort::kCommand);
  }
}

std::size_t CoeInformation::take(std::uint8_t* fragment, std::size_t room) {
  const std::size_t most = (room - kHead) / 2 * 2;
  const std::size_t size = std::min(size_ - sent_, most);
  const std::size_t left = (size_ - sent_ - size + most - 1) / most;
  fragment[0] = static_cast<std::uint8_t>(opcode_ | (left > 0 ? kIncomplete : 0));
  fragment[1] = 0;
  ethercat::put(fragment + 2, static_cast<std::uint16_t>(left));
  std::memcpy(fragment + kHead, answer_.data() + sent_, size);
  sent_ += size;
  return kHead + size;
}

/// List 0 has the lengths of the others.
void CoeInformation::list(std::uint16_t type) {
  if (type > kLists) return fail(SdoAbort::kRange);
  put16(type);
  for (std::uint16_t list = 1; type == 0 && list <= kLists; ++list) {
    std::uint16_t count = 0;
    for (int index = objects_.next(0); index > 0; index = objects_.next(index))
      count = static_cast<std::uint16_t>(
          count + is_listed(objects_, static_cast<std::uint16_t>(index), list));
    put16(count);
  }
  for (int index = objects_.next(0); index > 0 && type > 0; index = objects_.next(index))
    if (is_listed(objects_, static_cast<std::uint16_t>(index), type))
      put16(static_cast<std::uint16_t>(index));
}

void CoeInformation::describe(std::uint16_t index) {
  ObjectEntry entry;
  const int last = objects_.last_sub(index);
  if (last < 0 || !objects_.entry(index, static_cast<std::uint8_t>(last), entry))
    return fail(SdoAbort::kNoObject);
  put16(index);
  put16(number_of(entry.type));
  put8(static_cast<std::uint8_t>(last));
  put8(last == 0 ? kVar : kRecord);
  put_name(index);
}

void CoeInformation::describe_entry(std::uint16_t index, std::uint8_t sub) {
  ObjectEntry entry;
  if (objects_.last_sub(index) < 0) return fail(SdoAbort::kNoObject);
  if (!objects_.entry(index, sub, entry)) return fail(SdoAbort::kNoSubIndex);
  drives::ObjectBytes text;
  if (entry.type == drives::Type::kText) (void)objects_.read(index, sub, text);
  const std::size_t bytes = text.size > 0 ? text.size : drives::size_of(entry.type);
  unsigned access = kReadable;
  if ((entry.access & drives::kWrite) != 0)
    access |= entry.only_preop ? kWritablePreop : kWritableAlways;
  if ((entry.access & drives::kRpdo) != 0) access |= kInRxPdo;
  if ((entry.access & drives::kTpdo) != 0) access |= kInTxPdo;
  put16(index);
  put8(sub);
  put8(0);  // no unit, default or range
  put16(number_of(entry.type));
  put16(static_cast<std::uint16_t>(8 * bytes));
  put16(static_cast<std::uint16_t>(access));
  put_name(index);
}

/// "6040h": the drive has no other names of its objects.
void CoeInformation::put_name(std::uint16_t index) {
  for (int shift = 12; shift >= 0; shift -= 4)
    put8(static_cast<std::uint8_t>("0123456789ABCDEF"[index >> shift & 15]));
  put8('h');
}

void CoeInformation::fail(SdoAbort abort) {
  reset();
  opcode_ = ethercat::kInformationError;
  put16(static_cast<std::uint16_t>(abort));
  put16(static_cast<std::uint16_t>(static_cast<std::uint32_t>(abort) >> 16));
}

}  // namespace tactus::segment
