#include "sim_plant/ethercat/esc.hpp"

#include <algorithm>
#include <cstring>

namespace tactus::segment {

using namespace ethercat;

namespace {

constexpr std::uint8_t kType = 0x11, kRevision = 0, kRamKiB = 8;
constexpr std::uint8_t kPorts = 0x0F;                            // 0 and 1: MII
constexpr std::uint16_t kLastOfLine = 0x5611, kInLine = 0x5A31;  // DL status
constexpr std::uint16_t kDefaultWatchdog = 1000;                 // of 100 us
constexpr std::uint8_t kReads = 1, kWrites = 2;

/// Effect of a command in a slave that it addresses.
constexpr std::uint8_t kDoes[kCommands] = {
    0,      kReads,  kWrites,          kReads | kWrites,  // by position
    kReads, kWrites, kReads | kWrites,                    // by station
    kReads, kWrites, kReads | kWrites,                    // all
    kReads, kWrites, kReads | kWrites,                    // logical
    kReads, kReads};

}  // namespace

void Esc::power_on(const SiiImage& image, const EscClock& clock, bool lrw) {
  memory_.fill(0);
  open_.fill(false);
  image_ = &image;
  clock_ = clock;
  outputs_ns_ = -1;
  requested_ = outputs_ = expired_ = latched_ = sync0_ = false;
  const std::uint8_t head[8] = {kType, kRevision, 0, 0, kFmmus, kSms, kRamKiB, kPorts};
  std::memcpy(memory_.data(), head, sizeof head);
  const unsigned features = kHasClock | kHasLongClock | (lrw ? 0U : kNoLrw);
  put(&memory_[kFeaturesReg], static_cast<std::uint16_t>(features));
  put<std::uint32_t>(&memory_[kDlControlReg], 0x0007C001);
  put<std::uint16_t>(&memory_[kWatchdogDividerReg], kDivider100us);
  put<std::uint16_t>(&memory_[kPdiWatchdogReg], kDefaultWatchdog);
  put<std::uint16_t>(&memory_[kDataWatchdogReg], kDefaultWatchdog);
  put<std::uint16_t>(&memory_[kPdiControlReg], image.word(0));
  put<std::uint16_t>(&memory_[kAliasReg], image.word(4));
  put<std::uint16_t>(&memory_[kEepromControlReg], kEepromReads8);
  put<std::uint16_t>(&memory_[kTimeSpeedReg], 0x1000);
  memory_[kWatchdogStatusReg] = 1;
  show(static_cast<std::uint16_t>(AlState::kInit), 0);
  set_line(false);
}

void Esc::set_line(bool last) {
  put<std::uint16_t>(&memory_[kDlStatusReg], last ? kLastOfLine : kInLine);
}

bool Esc::addressed(const Datagram& datagram) const {
  switch (datagram.command) {
    case Command::kAprd:
    case Command::kApwr:
    case Command::kAprw:
    case Command::kArmw: return datagram.position() == 0;
    case Command::kFprd:
    case Command::kFpwr:
    case Command::kFprw:
    case Command::kFrmw: {
      const std::uint16_t station = datagram.position();
      const bool alias = (memory_[kDlControlReg + 3] & 0x01) != 0 && station == reg16(kAliasReg);
      return station == reg16(kStationReg) || alias;
    }
    default: return true;
  }
}

void Esc::process(const Datagram& datagram, std::int64_t now_ns) {
  now_ns_ = now_ns;
  const auto code = static_cast<std::uint8_t>(datagram.command);
  if (code >= kCommands) return;
  const bool reads = (kDoes[code] & kReads) != 0, writes = (kDoes[code] & kWrites) != 0;
  const bool mine = addressed(datagram);
  switch (datagram.command) {
    case Command::kNop: return;
    case Command::kLrw:
      if ((reg16(kFeaturesReg) & kNoLrw) != 0) return;
      [[fallthrough]];
    case Command::kLrd:
    case Command::kLwr: return logical(datagram, reads, writes);
    case Command::kArmw:
    case Command::kFrmw: physical(datagram, mine, !mine, false); break;
    default:
      if (mine) physical(datagram, reads, writes, code >= static_cast<std::uint8_t>(Command::kBrd));
  }
  const bool counts = datagram.command == Command::kArmw || code <= 3 || (code >= 7 && code <= 9);
  if (counts) datagram.set_position(static_cast<std::uint16_t>(datagram.position() + 1));
}

/// `joins`: what is read is OR-ed to what others have read.
void Esc::physical(const Datagram& datagram, bool reads, bool writes, bool joins) {
  std::array<std::uint8_t, kLengthBits + 1> received;
  std::memcpy(received.data(), datagram.data, datagram.size);
  unsigned counter = datagram.counter();
  if (reads && read(datagram.reg(), datagram.data, datagram.size, joins)) counter += 1;
  if (writes && write(datagram.reg(), received.data(), datagram.size)) counter += reads ? 2U : 1U;
  datagram.set_counter(static_cast<std::uint16_t>(counter));
}

/// The port on which the frame comes back, if there is a slave behind; latched together with the
/// receive times.
void Esc::note_return(std::int64_t now_ns, bool last) {
  if (!latched_) return;
  latched_ = false;
  put<std::uint32_t>(&memory_[kPortTimesReg], static_cast<std::uint32_t>(clock_.local(port_ns_)));
  const std::int64_t back_ns = last ? 0 : clock_.local(now_ns);
  put<std::uint32_t>(&memory_[kPortTimesReg + 4], static_cast<std::uint32_t>(back_ns));
  put<std::uint64_t>(&memory_[kUnitTimeReg], static_cast<std::uint64_t>(clock_.local(port_ns_)));
}

void Esc::advance(std::int64_t now_ns) {
  now_ns_ = now_ns;
  const SyncManager outputs = sm(2);
  const bool watched = (outputs.control & kSmWatchdog) != 0 && outputs.enabled();
  const std::int64_t unit_ns = (std::int64_t{reg16(kWatchdogDividerReg)} + 2) * 40;
  const std::int64_t limit_ns = unit_ns * reg16(kDataWatchdogReg);
  if (!watched || limit_ns == 0 || outputs_ns_ < 0 || now_ns - outputs_ns_ <= limit_ns) return;
  outputs_ns_ = -1;
  expired_ = true;
  memory_[kWatchdogStatusReg] = 0;
  if (memory_[kWatchdogCounterReg] < 0xFF) ++memory_[kWatchdogCounterReg];
}

bool Esc::take_request(std::uint16_t& control) {
  if (!requested_) return false;
  requested_ = false;
  control = reg16(kAlControlReg);
  memory_[kAlEventReg] &= 0xFE;
  return true;
}

void Esc::show(std::uint16_t status, std::uint16_t code) {
  put(&memory_[kAlStatusReg], status);
  put(&memory_[kAlCodeReg], code);
}
std::uint16_t Esc::status() const {
  return reg16(kAlStatusReg);
}
std::uint16_t Esc::reg16(std::uint16_t reg) const {
  return get<std::uint16_t>(&memory_[reg]);
}

std::uint32_t Esc::reg32(std::uint16_t reg) const {
  return get<std::uint32_t>(&memory_[reg]);
}

SyncManager Esc::sm(std::size_t i) const {
  const std::uint8_t* const at = &memory_[kSmReg + kSmBytes * i];
  return {get<std::uint16_t>(at), get<std::uint16_t>(at + 2), at[4], at[5], at[6]};
}

std::uint8_t* Esc::bytes(std::size_t i) {
  const SyncManager manager = sm(i);
  const bool inside = manager.start >= kRam && manager.start + manager.length <= int{kMemory};
  return inside ? &memory_[manager.start] : nullptr;
}

void Esc::set_full(std::size_t i, bool full) {
  std::uint8_t& status = memory_[kSmReg + kSmBytes * i + 5];
  status = static_cast<std::uint8_t>(full ? status | kSmFull : status & ~kSmFull);
  open_[i] = false;
}

bool Esc::take_outputs() {
  const bool came = outputs_;
  outputs_ = false;
  return came;
}

bool Esc::take_expired() {
  const bool expired = expired_;
  expired_ = false;
  return expired;
}

using namespace ethercat;

namespace {

struct Fmmu {
  std::uint64_t logical;
  std::size_t length;
  std::uint8_t first_bit, last_bit;
  std::size_t physical;
  std::uint8_t physical_bit, type;
  bool active;
};

Fmmu load(const std::uint8_t* at) {
  return {get<std::uint32_t>(at),
          get<std::uint16_t>(at + 4),
          static_cast<std::uint8_t>(at[6] & 7),
          static_cast<std::uint8_t>(at[7] & 7),
          get<std::uint16_t>(at + 8),
          static_cast<std::uint8_t>(at[10] & 7),
          at[11],
          (at[12] & 1) != 0};
}

}  // namespace

/// The counter grows by what the slave has done, however many FMMUs were hit. The write takes the
/// bytes that were received, even where the areas of reading and writing overlap.
void Esc::logical(const Datagram& datagram, bool reads, bool writes) {
  std::array<std::uint8_t, kLengthBits + 1> received;
  std::memcpy(received.data(), datagram.data, datagram.size);
  bool read = false, written = false;
  for (std::size_t i = 0; i < kFmmus; ++i) {
    const Fmmu fmmu = load(&memory_[kFmmuReg + kFmmuBytes * i]);
    if (!fmmu.active) continue;
    if (reads && (fmmu.type & kFmmuRead) != 0) read = map(i, datagram, false, nullptr) || read;
    if (writes && (fmmu.type & kFmmuWrite) != 0)
      written = map(i, datagram, true, received.data()) || written;
  }
  const unsigned counter =
      datagram.counter() + (read ? 1U : 0U) + (written ? (reads ? 2U : 1U) : 0U);
  datagram.set_counter(static_cast<std::uint16_t>(counter));
}

/// True if bytes were read or written.
bool Esc::map(std::size_t i, const Datagram& datagram, bool writes, const std::uint8_t* from) {
  const Fmmu fmmu = load(&memory_[kFmmuReg + kFmmuBytes * i]);
  if (fmmu.first_bit != 0 || fmmu.last_bit != 7 || fmmu.physical_bit != 0)
    return map_bits(i, datagram, writes, from);
  const std::uint64_t begin = std::max<std::uint64_t>(fmmu.logical, datagram.logical());
  const std::uint64_t end = std::min<std::uint64_t>(
      fmmu.logical + fmmu.length, std::uint64_t{datagram.logical()} + datagram.size);
  if (begin >= end) return false;
  const auto at = static_cast<std::size_t>(begin - datagram.logical());
  const auto physical = fmmu.physical + static_cast<std::size_t>(begin - fmmu.logical);
  const auto size = static_cast<std::size_t>(end - begin);
  return writes ? write(physical, from + at, size)
                : read(physical, datagram.data + at, size, false);
}

bool Esc::map_bits(std::size_t i, const Datagram& datagram, bool writes, const std::uint8_t* from) {
  const Fmmu fmmu = load(&memory_[kFmmuReg + kFmmuBytes * i]);
  if (fmmu.length == 0) return false;
  const std::size_t bits = 8 * (fmmu.length - 1) + fmmu.last_bit + 1U;
  bool done = false;
  for (std::size_t bit = fmmu.first_bit; bit < bits; ++bit) {
    const std::uint64_t logical = fmmu.logical + bit / 8;
    if (logical < datagram.logical() ||
        logical >= std::uint64_t{datagram.logical()} + datagram.size)
      continue;
    const auto at = static_cast<std::size_t>(logical - datagram.logical());
    const std::size_t to = bit - fmmu.first_bit + fmmu.physical_bit, byte = fmmu.physical + to / 8;
    std::uint8_t value = 0;
    if (byte >= kMemory) continue;
    if (writes) {
      const unsigned mask = 1U << (to % 8), wanted = from[at] >> (bit % 8) & 1U;
      value = static_cast<std::uint8_t>((memory_[byte] & ~mask) | (wanted << (to % 8)));
      done = write(byte, &value, 1) || done;
    } else if (read(byte, &value, 1, false)) {
      const unsigned mask = 1U << (bit % 8), shown = value >> (to % 8) & 1U;
      datagram.data[at] =
          static_cast<std::uint8_t>((datagram.data[at] & ~mask) | (shown << (bit % 8)));
      done = true;
    }
  }
  return done;
}

}  // namespace tactus::segment
