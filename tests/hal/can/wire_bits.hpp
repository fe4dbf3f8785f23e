// The bits of a CAN frame as a controller sends them, with checksum and stuff bits: an oracle for
// the load of a bus, written from ISO 11898-1 and not from the sums that it checks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus::can {

/// The bits of a frame that may be stuffed, before stuffing.
struct WireBits {
  static constexpr std::size_t kMost = 1024;
  std::array<bool, kMost> bits{};
  std::size_t count = 0;

  void put(std::uint32_t value, int width) {
    for (int i = width; i-- > 0;) bits[count++] = (value >> i & 1U) != 0;
  }
  /// Returns the CRC-15 of all bits.
  std::uint32_t checksum() const {
    std::uint32_t crc = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const bool next = bits[i] != ((crc >> 14 & 1U) != 0);
      crc = (crc << 1 & 0x7FFF) ^ (next ? 0x4599U : 0U);
    }
    return crc;
  }
  /// Counts the stuff bits after the bits from `first` to the one before `end`. After five equal
  /// bits, stuff bits included, comes the opposite one, also after the last bit.
  int stuff(std::size_t first, std::size_t end) const {
    int run = 0, found = 0;
    bool last = !bits[0];
    for (std::size_t i = 0; i < end; ++i) {
      run = bits[i] == last ? run + 1 : 1;
      last = bits[i];
      if (run < 5) continue;
      if (i >= first) ++found;
      last = !bits[i];
      run = 1;
    }
    return found;
  }
};

/// A classic frame from its start to the end of its checksum.
inline WireBits classic_bits(std::uint16_t id, const std::uint8_t* data, std::size_t size) {
  WireBits wire;
  wire.put(0, 1);  // start of frame
  wire.put(id, 11);
  wire.put(0, 3);  // data frame, 11-bit identifier, reserved
  wire.put(static_cast<std::uint32_t>(size), 4);
  for (std::size_t i = 0; i < size; ++i) wire.put(data[i], 8);
  wire.put(wire.checksum(), 15);
  return wire;
}
/// Delimiter, acknowledgement and its delimiter, end of frame, pause.
inline constexpr std::size_t kClassicTail = 1 + 1 + 1 + 7 + 3;

/// Bits of a CAN FD frame at the nominal bit rate, until the bit rate switch.
inline constexpr std::size_t kLongHead = 1 + 11 + 1 + 1 + 1 + 1 + 1;
/// A CAN FD frame from its start to its last data byte; its checksum has fixed stuff bits.
inline WireBits long_bits(std::uint16_t id, const std::uint8_t* data, std::size_t size, int dlc) {
  WireBits wire;
  wire.put(0, 1);  // start of frame
  wire.put(id, 11);
  wire.put(0, 2);  // RRS, 11-bit identifier
  wire.put(1, 1);  // FD frame
  wire.put(0, 1);  // reserved
  wire.put(1, 1);  // bit rate switch
  wire.put(0, 1);  // error state: active
  wire.put(static_cast<std::uint32_t>(dlc), 4);
  for (std::size_t i = 0; i < size; ++i) wire.put(data[i], 8);
  return wire;
}

}  // namespace tactus::can
