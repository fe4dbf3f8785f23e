// BusLoad: how long the frames of one cycle occupy a CAN bus, from their real lengths, with and
// without stuff bits (ISO 11898-1). A cycle that does not fit is refused before the first frame.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/can/protocol_frame.hpp"
#include "kernel/core/load_error.hpp"

namespace tactus::can {

struct BitRates {
  double nominal_hz = 1e6;
  double data_hz = 0.0;  ///< of CAN FD's second half, with bit rate switch; 0: classic CAN

  constexpr bool fd() const { return data_hz > 0.0; }
};

/// The bits of a frame with an 11-bit identifier, with three bits of pause after it.
struct FrameBits {
  int nominal = 0, data = 0;              ///< without stuff bits, at each bit rate
  int nominal_stuff = 0, data_stuff = 0;  ///< most stuff bits
};

/// Returns the bits of a frame with `size` data bytes; a CAN FD frame is padded to a length that
/// exists. [any]
constexpr FrameBits frame_bits(std::size_t size, bool fd) {
  if (!fd) {
    // 34 bits from the start to the checksum, with the data, are stuffed after five equal ones.
    const int bits = 8 * static_cast<int>(size);
    return {47 + bits, 0, (34 + bits - 1) / 4, 0};
  }
  const std::size_t padded = fd_size(size);
  const int bits = 8 * static_cast<int>(padded);
  const bool short_checksum = padded <= 16;
  const int checksum = short_checksum ? 17 + 6 : 21 + 7;  // with its stuff bits, which are fixed
  return {30, 5 + bits + 4 + checksum, 4, (5 + bits) / 4};
}

/// Times on the wire, us.
struct WireTime {
  double best_us = 0.0, worst_us = 0.0;
};

constexpr WireTime wire_time(std::size_t size, bool fd, const BitRates& rates) {
  const FrameBits bits = frame_bits(size, fd);
  const double nominal_us = 1e6 / rates.nominal_hz;
  const double data_us = fd ? 1e6 / rates.data_hz : 0.0;
  return {
      bits.nominal * nominal_us + bits.data * data_us,
      (bits.nominal + bits.nominal_stuff) * nominal_us + (bits.data + bits.data_stuff) * data_us};
}

class BusLoad {
 public:
  /// `rates.data_hz` > 0: frames are CAN FD frames if not said otherwise. [any]
  constexpr explicit BusLoad(const BitRates& rates) : rates_(rates) {}

  /// Adds frames with `size` data bytes, `per_cycle` of them in a cycle: 7 for one of each joint,
  /// 0.1 for a heartbeat every ten cycles. [any]
  constexpr void add(std::size_t size, double per_cycle = 1.0) {
    add(size, per_cycle, rates_.fd());
  }
  /// Adds frames that are CAN FD frames or are not. [any]
  constexpr void add(std::size_t size, double per_cycle, bool fd) {
    const WireTime time = wire_time(size, fd, rates_);
    sum_.best_us += per_cycle * time.best_us;
    sum_.worst_us += per_cycle * time.worst_us;
  }

  constexpr double best_us() const { return sum_.best_us; }
  constexpr double worst_us() const { return sum_.worst_us; }

  /// kOverBudget: the worst time is above the share `most` of `period_us`, or is not finite; `why`
  /// names bus, times, joints, bit rate and what helps; `packs`: packed commands may. [init]
  Status judge(const char* interface, int joints, double period_us, double most, bool packs,
               Message& why) const;

 private:
  BitRates rates_;
  WireTime sum_;
};

/// Judges the frames that an interface queues for sending, -1: not known. kTooLarge for a queue
/// that does not hold the `frames` of a cycle, and loses some in every cycle. [init]
Status judge_queue(const char* interface, int queue, int frames, Message& why);

}  // namespace tactus::can
