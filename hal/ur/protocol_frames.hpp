// Frames: cuts a stream of bytes into packets that begin with their own length. TCP keeps the order
// of bytes and nothing else: a packet may come in pieces, and several in one piece.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tactus::ur {

struct Packet {
  const std::uint8_t* data = nullptr;  ///< with its length and type
  std::size_t size = 0;
};

enum class NextPacket : std::uint8_t {
  kNone,    ///< the next packet is not complete
  kPacket,  ///< here it is
  kBroken,  ///< a length that no packet has: the stream cannot be followed any further
};

/// `LengthBytes` hold the length of the whole packet (2: RTDE, 4: the other binary ports), which is
/// at least `Shortest` and at most `Capacity` bytes.
template <std::size_t LengthBytes, std::size_t Shortest, std::size_t Capacity>
class Frames {
  static_assert(LengthBytes <= Shortest && Shortest <= Capacity);

 public:
  /// Takes as many bytes as there is room for; returns how many. Packets got before are void.
  std::size_t take(const std::uint8_t* data, std::size_t size) {
    if (begin_ > 0) {
      std::memmove(bytes_.data(), bytes_.data() + begin_, end_ - begin_);
      end_ -= begin_;
      begin_ = 0;
    }
    if (size > Capacity - end_) size = Capacity - end_;
    if (size > 0) std::memcpy(bytes_.data() + end_, data, size);
    end_ += size;
    return size;
  }

  /// The next whole packet; valid until more is taken.
  NextPacket next(Packet& packet) {
    const std::size_t held = end_ - begin_;
    if (held < LengthBytes) return NextPacket::kNone;
    std::size_t length = 0;
    for (std::size_t i = 0; i < LengthBytes; ++i) length = length << 8 | bytes_[begin_ + i];
    if (length < Shortest || length > Capacity) return NextPacket::kBroken;
    if (held < length) return NextPacket::kNone;
    packet = {bytes_.data() + begin_, length};
    begin_ += length;
    return NextPacket::kPacket;
  }

  void clear() { begin_ = end_ = 0; }

 private:
  std::array<std::uint8_t, Capacity> bytes_;
  std::size_t begin_ = 0, end_ = 0;
};

/// RTDE: u16 length, u8 type, payload. No packet is longer than its length can say.
inline constexpr std::size_t kRtdeHeader = 3, kRtdeLongest = 65535;
using RtdeFrames = Frames<2, kRtdeHeader, kRtdeLongest>;

/// Primary and secondary: i32 length, i8 type. Real-time: i32 length, then doubles.
using StateFrames = Frames<4, 5, 16384>;

}  // namespace tactus::ur
