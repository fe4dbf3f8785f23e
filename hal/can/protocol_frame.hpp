// CanFrame: a frame of classic CAN or CAN FD, and the integers in its data, which CANopen sends
// with the lowest byte first (CiA 301, 7.1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus::can {

inline constexpr std::size_t kMaxData = 64;     ///< bytes of a CAN FD frame
inline constexpr std::size_t kClassicData = 8;  ///< bytes of a classic frame

struct CanFrame {
  std::uint16_t id = 0;  ///< 11 bits; frames with 29 bits do not reach us
  std::uint8_t size = 0;
  bool fd = false;
  bool remote = false;        ///< a remote transmission request, without data
  std::int64_t stamp_ns = 0;  ///< when the kernel received it, by CLOCK_REALTIME; 0: unknown
  std::array<std::uint8_t, kMaxData> data{};
};

/// Returns the integer whose lowest byte is at `at`; the caller keeps within the array. [any]
template <class T, std::size_t N>
constexpr T load(const std::array<std::uint8_t, N>& data, std::size_t at) {
  std::uint64_t bits = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) bits = bits << 8 | data[at + i];
  return static_cast<T>(bits);
}

/// Writes an integer, the lowest byte first; the caller keeps within the array. [any]
template <class T, std::size_t N>
constexpr void store(std::array<std::uint8_t, N>& data, std::size_t at, T value) {
  auto bits = static_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i, bits >>= 8)
    data[at + i] = static_cast<std::uint8_t>(bits);
}

/// Returns the shortest data that a CAN FD frame can have for `size` bytes (ISO 11898-1: 0 to 8,
/// 12, 16, 20, 24, 32, 48, 64). [any]
constexpr std::size_t fd_size(std::size_t size) {
  constexpr std::size_t kSizes[] = {12, 16, 20, 24, 32, 48, 64};
  if (size <= 8) return size;
  for (const std::size_t fits : kSizes)
    if (size <= fits) return fits;
  return kMaxData;
}

}  // namespace tactus::can
