#include "hal/serial/frame.hpp"

#include <cstring>

#include "hal/net/protocol_bytes.hpp"
#include "hal/serial/crc32.hpp"

namespace tactus::serial {
namespace {

constexpr std::size_t kMostBytes = kHead + kMaxPayload + kTail;
constexpr std::uint8_t kLongest = 0xFF;  // code of 254 bytes without a zero behind them

/// COBS: every zero becomes the distance to the next one. Returns the length with the end.
std::size_t stuff(const std::uint8_t* from, std::size_t size, std::uint8_t* to) {
  std::size_t code_at = 0, at = 1;
  std::uint8_t code = 1;
  LoopBound<kMostBytes> loop;
  for (std::size_t i = 0; i < size; ++i) {
    loop.tick();
    if (from[i] != 0) {
      to[at++] = from[i];
      ++code;
    }
    if (from[i] != 0 && code != kLongest) continue;
    to[code_at] = code;
    code_at = at++;
    code = 1;
  }
  to[code_at] = code;
  to[at++] = 0;
  return at;
}

}  // namespace

std::size_t write_frame(const Frame& frame, std::uint8_t* out) {
  if (frame.size > kMaxPayload) return 0;
  std::array<std::uint8_t, kMostBytes> plain;
  ByteWriter writer(plain.data(), plain.size());
  writer.u8(static_cast<std::uint8_t>(frame.kind));
  writer.u16(frame.number);
  writer.text({reinterpret_cast<const char*>(frame.payload), frame.size});
  writer.u32(crc32<kMostBytes>(plain.data(), writer.size()));
  return stuff(plain.data(), writer.size(), out);
}

bool FrameReader::take(std::uint8_t byte) {
  if (byte == 0) return finish();
  if (size_ < bytes_.size()) bytes_[size_] = byte;
  if (size_ <= bytes_.size()) ++size_;
  return false;
}

bool FrameReader::finish() {
  const bool empty = size_ == 0, whole = size_ <= bytes_.size() && unstuff();
  if (empty) return false;  // zeros between frames are no frames
  const std::size_t size = size_;
  size_ = 0;
  if (!whole || size < kHead + kTail) {
    ++health_.malformed;
    return false;
  }
  ByteReader reader(bytes_.data(), size);
  frame_.kind = static_cast<Kind>(reader.u8());
  frame_.number = reader.u16();
  frame_.payload = bytes_.data() + kHead;
  frame_.size = size - kHead - kTail;
  ByteReader tail(frame_.payload + frame_.size, kTail);
  const bool right = tail.u32() == crc32<kMostBytes>(bytes_.data(), size - kTail);
  right ? ++health_.frames : ++health_.corrupted;
  return right;
}

/// Writes the zeros back, in place: what is written is never ahead of what is read. False: a code
/// points beyond the end.
bool FrameReader::unstuff() {
  std::size_t from = 0, to = 0;
  LoopBound<kMaxFrame> codes;
  while (from < size_) {
    codes.tick();
    const std::size_t code = bytes_[from++];
    if (code - 1 > size_ - from) return false;
    std::memmove(bytes_.data() + to, bytes_.data() + from, code - 1);
    from += code - 1;
    to += code - 1;
    if (code != kLongest && from < size_) bytes_[to++] = 0;
  }
  size_ = to;
  return size_ <= kMostBytes;
}

}  // namespace tactus::serial
