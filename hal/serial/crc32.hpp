// CRC-32 of IEEE 802.3, clause 3.2.9: reflected polynomial EDB88320h, begun with ones, inverted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/core/loop_bound.hpp"

namespace tactus::serial {

namespace crc {

constexpr std::uint32_t kPolynomial = 0xEDB88320;

/// Contribution of each half byte.
constexpr std::array<std::uint32_t, 16> table() {
  std::array<std::uint32_t, 16> sums{};
  for (std::uint32_t i = 0; i < 16; ++i) {
    std::uint32_t sum = i;
    for (int bit = 0; bit < 4; ++bit) sum = (sum & 1) != 0 ? sum >> 1 ^ kPolynomial : sum >> 1;
    sums[i] = sum;
  }
  return sums;
}
inline constexpr std::array<std::uint32_t, 16> kTable = table();

}  // namespace crc

/// Returns the check sum of at most `kMost` bytes. [any]
template <std::size_t kMost>
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t sum = ~std::uint32_t{0};
  LoopBound<kMost> loop;
  for (std::size_t i = 0; i < size; ++i) {
    loop.tick();
    sum ^= bytes[i];
    sum = sum >> 4 ^ crc::kTable[sum & 15];
    sum = sum >> 4 ^ crc::kTable[sum & 15];
  }
  return ~sum;
}

}  // namespace tactus::serial
