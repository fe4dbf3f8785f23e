// Esc: access to registers and process data.
#include <algorithm>
#include <cstring>

#include "sim_plant/ethercat/esc.hpp"

namespace tactus::segment {

using namespace ethercat;

namespace {

/// Registers that the master may write; the others ignore it.
struct Span {
  std::uint16_t first, last;
};
constexpr Span kWritable[] = {
    {kStationReg, kStationReg + 1},
    {kDlControlReg, kDlControlReg + 3},
    {kAlControlReg, kAlControlReg + 1},
    {kEventMaskReg, kEventMaskReg + 1},
    {kWatchdogDividerReg, kWatchdogDividerReg + 1},
    {kPdiWatchdogReg, kPdiWatchdogReg + 1},
    {kDataWatchdogReg, kDataWatchdogReg + 1},
    {kEepromOwnerReg, kEepromOwnerReg},
    {kEepromControlReg, kEepromControlReg + 1},
    {kEepromAddressReg, kEepromAddressReg + 3},
    {kFmmuReg, kFmmuReg + kFmmuBytes* Esc::kFmmus - 1},
    {kTimeOffsetReg, kTimeOffsetReg + 11},
    {kTimeSpeedReg, kTimeSpeedReg + 5},
    {kDcControlReg, kDcControlReg + 1},
    {kSyncStartReg, kSyncStartReg + 7},
    {kSyncCycleReg, kSyncCycleReg + 7},
};
constexpr std::uint16_t kSmEnd = kSmReg + kSmBytes * Esc::kSms;

bool writable(std::size_t at) {
  return std::any_of(std::begin(kWritable), std::end(kWritable),
                     [at](const Span& span) { return at >= span.first && at <= span.last; });
}
bool covers(std::size_t at, std::size_t size, std::size_t reg) {
  return at <= reg && reg < at + size;
}

}  // namespace

/// A sync manager lets the master through in its direction only, and into a mailbox only if it is
/// full, or empty, and from its first byte on, be it in several datagrams.
bool Esc::allows(std::size_t at, std::size_t size, bool writes) const {
  if (at < kRam) return true;
  for (std::size_t i = 0; i < kSms; ++i) {
    const SyncManager manager = sm(i);
    if (!manager.enabled() || !manager.covers(at, size)) continue;
    if (manager.written() != writes) return false;
    if (!manager.mailbox()) continue;
    if (manager.full() == writes) return false;
    if (!open_[i] && !covers(at, size, manager.start)) return false;
  }
  return true;
}

/// The last byte of a mailbox fills or empties it; that of the outputs makes them valid.
void Esc::complete(std::size_t at, std::size_t size, bool writes) {
  for (std::size_t i = 0; i < kSms; ++i) {
    const SyncManager manager = sm(i);
    if (!manager.enabled()) continue;
    if (covers(at, size, manager.start)) open_[i] = true;
    if (!covers(at, size, std::size_t{manager.start} + manager.length - 1U)) continue;
    if (manager.mailbox()) set_full(i, writes);
    if (writes && !manager.mailbox()) {
      outputs_ = true;
      outputs_ns_ = now_ns_;
      memory_[kWatchdogStatusReg] = 1;
    }
  }
}

bool Esc::read(std::size_t at, std::uint8_t* into, std::size_t size, bool joins) {
  if (size == 0 || at + size > kMemory || !allows(at, size, false)) return false;
  if (covers(at, size, kSystemTimeReg) || covers(at, size, kSystemTimeReg + 7)) {
    put(&memory_[kSystemTimeReg], static_cast<std::uint64_t>(clock_.system(now_ns_)));
  }
  for (std::size_t i = 0; i < size; ++i)
    into[i] = static_cast<std::uint8_t>(joins ? into[i] | memory_[at + i] : memory_[at + i]);
  if (at + size > kRam) complete(at, size, false);
  return true;
}

bool Esc::write(std::size_t at, const std::uint8_t* from, std::size_t size) {
  if (size == 0 || at + size > kMemory || !allows(at, size, true)) return false;
  const std::size_t registers = at < kRam ? std::min(size, kRam - at) : 0;
  if (registers > 0) write_registers(at, from, registers);
  std::memcpy(&memory_[at] + registers, from + registers, size - registers);
  if (size > registers) complete(at + registers, size - registers, true);
  return true;
}

void Esc::write_registers(std::size_t at, const std::uint8_t* from, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    if (at + i >= kSmReg && at + i < kSmEnd)
      write_sm(at + i, from[i]);
    else if (writable(at + i))
      memory_[at + i] = from[i];
  }
  after_write(at, size, from);
}

/// Place, length and control are fixed while a sync manager is enabled; its status is not the
/// master's.
void Esc::write_sm(std::size_t at, std::uint8_t value) {
  const std::size_t i = (at - kSmReg) / kSmBytes, field = (at - kSmReg) % kSmBytes;
  const bool enabled = (memory_[kSmReg + kSmBytes * i + 6] & kSmEnabled) != 0;
  if (field < 5 && !enabled) memory_[at] = value;
  if (field != 6) return;
  memory_[at] = value & 0x03;
  if ((value & kSmEnabled) == 0) set_full(i, false);
}

void Esc::after_write(std::size_t at, std::size_t size, const std::uint8_t* from) {
  if (covers(at, size, kAlControlReg)) {
    requested_ = true;
    memory_[kAlEventReg] |= 0x01;
  }
  if (at < kErrorCountersReg + kErrorCounters && at + size > kErrorCountersReg)
    std::memset(&memory_[kErrorCountersReg], 0, kErrorCounters);
  if (covers(at, size, kWatchdogCounterReg)) memory_[kWatchdogCounterReg] = 0;
  if (covers(at, size, kEepromControlReg + 1)) serve_eeprom();
  if (covers(at, size, kPortTimesReg)) {
    latched_ = true;
    port_ns_ = now_ns_;
  }
  if (at == kSystemTimeReg && size >= 4) {
    // Of four bytes the upper half is that of the own time.
    const auto own = static_cast<std::uint64_t>(clock_.system(now_ns_));
    const auto low =
        static_cast<std::int32_t>(get<std::uint32_t>(from) - static_cast<std::uint32_t>(own));
    const std::uint64_t time =
        size >= 8 ? get<std::uint64_t>(from) : own + static_cast<std::uint64_t>(std::int64_t{low});
    clock_.steer(static_cast<std::int64_t>(time), now_ns_);
    const std::int64_t difference = clock_.difference();
    const std::int64_t size_ns = std::min<std::int64_t>(std::abs(difference), 0x7FFFFFFF);
    put(&memory_[kTimeDifferenceReg],
        static_cast<std::uint32_t>(size_ns) | (difference < 0 ? 0x80000000U : 0U));
  }
  if (covers(at, size, kTimeOffsetReg + 7))
    clock_.set_offset(get<std::int64_t>(&memory_[kTimeOffsetReg]));
  if (covers(at, size, kTimeDelayReg + 3))
    clock_.set_delay(get<std::uint32_t>(&memory_[kTimeDelayReg]));
  if (covers(at, size, kTimeSpeedReg)) clock_.reset_filter();
  if (covers(at, size, kDcControlReg + 1)) {
    const std::uint64_t left = get<std::uint64_t>(&memory_[kSyncStartReg]) -
                               static_cast<std::uint64_t>(clock_.system(now_ns_));
    const bool on = (reg16(kDcControlReg) & kSync0On) == kSync0On;
    sync0_ = on && (sync0_ || static_cast<std::int64_t>(left) > 0);
  }
}

/// Reads of 8 bytes, never busy; what is not a read is refused.
void Esc::serve_eeprom() {
  const std::uint16_t control = reg16(kEepromControlReg);
  std::uint16_t answer = kEepromReads8;
  switch (control & kEepromCommandBits) {
    case 0: break;
    case kEepromRead: {
      const auto at = get<std::uint32_t>(&memory_[kEepromAddressReg]);
      for (std::uint32_t i = 0; i < 4; ++i)
        put(&memory_[kEepromDataReg + 2 * i], image_->word(at + i));
      break;
    }
    default: answer |= kEepromError;
  }
  put(&memory_[kEepromControlReg], answer);
}

}  // namespace tactus::segment
