// Esc: logical addresses and the FMMUs that map them.
#include <algorithm>
#include <cstring>

#include "sim_plant/ethercat/esc.hpp"

namespace tactus::segment {

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
