// Frames: cuts a stream of bytes into packets that begin with their own length. TCP preserves only
// the order of bytes: a packet may arrive in pieces, or several in one piece.
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
  kPacket,  ///< the packet is complete
  kBroken,  ///< the length is impossible, and the stream cannot be read any further
};

/// `LengthBytes` hold the length of the whole packet (2: RTDE, 4: the other binary ports), which is
/// at least `Shortest` and at most `Capacity` bytes.
template <std::size_t LengthBytes, std::size_t Shortest, std::size_t Capacity>
class Frames {
  static_assert(LengthBytes <= Shortest && Shortest <= Capacity);

 public:
  /// Takes as many bytes as fit and returns their number. Packets returned before become invalid.
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

  /// Returns the next whole packet, which is valid until the next take().
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

  /// How many bytes take() can take; at least one after next() has returned kNone.
  std::size_t room() const { return Capacity - (end_ - begin_); }
  void clear() { begin_ = end_ = 0; }

 private:
  std::array<std::uint8_t, Capacity> bytes_;
  std::size_t begin_ = 0, end_ = 0;
};

/// RTDE: u16 length, u8 type, payload. The type of the length field limits the size of a packet.
inline constexpr std::size_t kRtdeHeader = 3, kRtdeLongest = 65535;
using RtdeFrames = Frames<2, kRtdeHeader, kRtdeLongest>;

/// Primary and secondary: i32 length, i8 type. Real-time: i32 length, then doubles.
using StateFrames = Frames<4, 5, 16384>;

}  // namespace tactus::ur
