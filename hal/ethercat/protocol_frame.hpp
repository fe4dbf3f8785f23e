// EtherCAT frames and datagrams (IEC 61158-4-12): their places and commands, FrameWriter and
// FrameReader. Both ends share them. Numbers are little-endian on the wire; the EtherType is not.
//
// A frame is read by its EtherCAT length: an interface pads it to 60 bytes, and a virtual one does
// not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tactus::ethercat {

inline constexpr std::uint16_t kEtherType = 0x88A4;
inline constexpr std::size_t kEthernetBytes = 14;  ///< destination, source, EtherType
inline constexpr std::size_t kFrameBytes = 2;      ///< EtherCAT length and type
inline constexpr std::size_t kDatagramBytes = 10;  ///< before the data
inline constexpr std::size_t kCounterBytes = 2;    ///< working counter, after the data
inline constexpr std::size_t kMinFrame = 60, kMaxFrame = 1514;
inline constexpr std::size_t kMaxDatagrams = 15;
inline constexpr std::size_t kFirstDatagram = kEthernetBytes + kFrameBytes;
/// Data of a datagram that has a frame for itself: 1486 bytes.
inline constexpr std::size_t kMaxData = kMaxFrame - kFirstDatagram - kDatagramBytes - kCounterBytes;
inline constexpr std::uint16_t kLengthBits = 0x07FF, kFrameType = 0x1000, kTypeBits = 0xF000;
inline constexpr std::uint16_t kMoreBit = 0x8000;  ///< of a datagram's length

enum class Command : std::uint8_t {
  kNop = 0,
  kAprd = 1,  ///< read, by position
  kApwr = 2,  ///< write
  kAprw = 3,  ///< read and write
  kFprd = 4,  ///< by station address
  kFpwr = 5,
  kFprw = 6,
  kBrd = 7,  ///< all slaves; what they read is OR-ed
  kBwr = 8,
  kBrw = 9,
  kLrd = 10,  ///< logical addresses, through the FMMUs
  kLwr = 11,
  kLrw = 12,
  kArmw = 13,  ///< the slave at position 0 reads, all others write
  kFrmw = 14,  ///< the addressed slave reads, all others write
};
inline constexpr std::uint8_t kCommands = 15;

/// Reads a little-endian number. [any]
template <class Number>
Number get(const std::uint8_t* from) {
  std::uint64_t bits = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;) bits = bits << 8 | from[i];
  return static_cast<Number>(bits);
}
/// Writes one. [any]
template <class Number>
void put(std::uint8_t* to, Number number) {
  auto bits = static_cast<std::uint64_t>(number);
  for (std::size_t i = 0; i < sizeof(Number); ++i, bits >>= 8)
    to[i] = static_cast<std::uint8_t>(bits);
}

/// The address field of a datagram that names a slave, by position or station, and a register.
/// [any]
constexpr std::uint32_t address_of(std::uint16_t slave, std::uint16_t reg) {
  return std::uint32_t{reg} << 16 | slave;
}
/// The position field of the slave at `position`, from 0: each slave adds 1, and 0 is addressed.
/// [any]
constexpr std::uint16_t position_field(int position) {
  return static_cast<std::uint16_t>(-position);
}

struct Frame {
  std::array<std::uint8_t, kMaxFrame> bytes{};
  std::size_t size = 0;
};

/// A datagram in its frame.
struct Datagram {
  Command command = Command::kNop;
  std::uint8_t index = 0;
  std::size_t size = 0;  ///< of the data
  std::uint8_t* header = nullptr;
  std::uint8_t* data = nullptr;

  std::uint16_t position() const { return get<std::uint16_t>(header + 2); }
  std::uint16_t reg() const { return get<std::uint16_t>(header + 4); }
  std::uint32_t logical() const { return get<std::uint32_t>(header + 2); }
  void set_position(std::uint16_t position) const { put(header + 2, position); }
  std::uint16_t counter() const { return get<std::uint16_t>(data + size); }
  void set_counter(std::uint16_t counter) const { put(data + size, counter); }
  void set_interrupt(std::uint16_t bits) const { put(header + 8, bits); }
};

/// Composes a frame.
class FrameWriter {
 public:
  /// Begins a frame from `source`, a MAC address of 6 bytes, to all. [any]
  FrameWriter(Frame& frame, const std::uint8_t* source) : frame_(frame) {
    std::memset(frame.bytes.data(), 0xFF, 6);
    std::memcpy(frame.bytes.data() + 6, source, 6);
    frame.bytes[12] = kEtherType >> 8;
    frame.bytes[13] = kEtherType & 0xFF;
    frame.size = kFirstDatagram;
    finish();
  }
  /// Appends a datagram with `size` bytes of zeros, and returns them; null if there is no room.
  /// [any]
  std::uint8_t* add(Command command, std::uint8_t index, std::uint32_t address, std::size_t size) {
    const std::size_t whole = kDatagramBytes + size + kCounterBytes;
    if (count_ == kMaxDatagrams || frame_.size + whole > kMaxFrame) return nullptr;
    if (last_ != nullptr) put(last_ + 6, static_cast<std::uint16_t>(last_size_ | kMoreBit));
    last_ = frame_.bytes.data() + frame_.size;
    last_size_ = static_cast<std::uint16_t>(size);
    ++count_;
    std::memset(last_, 0, whole);
    last_[0] = static_cast<std::uint8_t>(command);
    last_[1] = index;
    put(last_ + 2, address);
    put(last_ + 6, last_size_);
    frame_.size += whole;
    finish();
    return last_ + kDatagramBytes;
  }
  /// Fills the frame up with zeros to what Ethernet demands. [any]
  void pad() {
    if (frame_.size >= kMinFrame) return;
    std::memset(frame_.bytes.data() + frame_.size, 0, kMinFrame - frame_.size);
    frame_.size = kMinFrame;
  }

 private:
  void finish() {
    const std::size_t length = frame_.size - kFirstDatagram;
    put(frame_.bytes.data() + kEthernetBytes, static_cast<std::uint16_t>(length | kFrameType));
  }

  Frame& frame_;
  std::uint8_t* last_ = nullptr;
  std::uint16_t last_size_ = 0;
  std::size_t count_ = 0;
};

/// Walks through the datagrams of a frame. No byte outside of the frame is touched, whatever it
/// says.
class FrameReader {
 public:
  explicit FrameReader(Frame& frame) {
    if (frame.size < kFirstDatagram || frame.size > kMaxFrame) return;
    std::uint8_t* const bytes = frame.bytes.data();
    if (bytes[12] != kEtherType >> 8 || bytes[13] != (kEtherType & 0xFF)) return;
    const auto head = get<std::uint16_t>(bytes + kEthernetBytes);
    const std::size_t length = head & kLengthBits;
    if ((head & kTypeBits) != kFrameType || length > frame.size - kFirstDatagram) return;
    next_ = bytes + kFirstDatagram;
    end_ = next_ + length;
    more_ = true;
  }
  /// Finds the next datagram; false: there is none, or it does not fit. [any]
  bool next(Datagram& datagram) {
    if (!more_) return false;
    more_ = false;
    const auto left = static_cast<std::size_t>(end_ - next_);
    if (left < kDatagramBytes + kCounterBytes || ++count_ > kMaxDatagrams) return false;
    const auto length = get<std::uint16_t>(next_ + 6);
    const std::size_t size = length & kLengthBits;
    if (size > left - kDatagramBytes - kCounterBytes) return false;
    datagram = {static_cast<Command>(next_[0]), next_[1], size, next_, next_ + kDatagramBytes};
    next_ += kDatagramBytes + size + kCounterBytes;
    more_ = (length & kMoreBit) != 0;
    ended_ = !more_ && next_ == end_;
    return true;
  }
  /// True after next() was false, if the frame was whole: no bytes missing or left over. [any]
  bool whole() const { return ended_; }

 private:
  std::uint8_t *next_ = nullptr, *end_ = nullptr;
  std::size_t count_ = 0;
  bool more_ = false, ended_ = false;
};

}  // namespace tactus::ethercat
