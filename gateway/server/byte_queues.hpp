// The bytes of a connection on their way in and out, in fixed memory.
#pragma once

#include <array>
#include <cstring>

#include "gateway/server/limits.hpp"

namespace tactus {

struct Bytes {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};
struct ByteSpace {
  std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// Bytes that have arrived; cuts them into messages by the lengths before them.
class InputBytes {
 public:
  /// Where further bytes go; of size 0: a whole message waits.
  ByteSpace space() {
    if (first_ > 0) std::memmove(bytes_.data(), bytes_.data() + first_, size_);
    first_ = 0;
    return {bytes_.data() + size_, bytes_.size() - size_};
  }
  void added(std::size_t count) { size_ += count; }

  /// True if the length in front exceeds that of the longest message.
  bool malformed() const { return size_ >= kLengthBytes && length() > kLongestMessage; }
  /// True if a whole message waits.
  bool whole() const {
    return size_ >= kLengthBytes && !malformed() && size_ - kLengthBytes >= length();
  }
  /// Takes the next message, whose bytes last until the next space(). False: none is whole.
  bool next(Bytes& message) {
    if (!whole()) return false;
    message = {bytes_.data() + first_ + kLengthBytes, length()};
    first_ += kLengthBytes + message.size;
    size_ -= kLengthBytes + message.size;
    return true;
  }
  void clear() { first_ = size_ = 0; }

 private:
  std::size_t length() const {
    std::size_t length = 0;
    for (std::size_t i = kLengthBytes; i > 0; --i) length = length << 8 | bytes_[first_ + i - 1];
    return length;
  }

  std::array<std::uint8_t, kLengthBytes + kLongestMessage> bytes_;
  std::size_t first_ = 0, size_ = 0;
};

/// Messages that wait to be sent, each behind its length.
class OutputBytes {
 public:
  std::size_t free() const { return bytes_.size() - size_; }
  /// Appends a message. False, without effect: there is no space for it.
  bool put(const std::uint8_t* message, std::size_t count) {
    if (free() < kLengthBytes + count) return false;
    if (first_ + size_ + kLengthBytes + count > bytes_.size()) {
      std::memmove(bytes_.data(), bytes_.data() + first_, size_);
      first_ = 0;
    }
    std::uint8_t* const to = bytes_.data() + first_ + size_;
    for (std::size_t i = 0; i < kLengthBytes; ++i)
      to[i] = static_cast<std::uint8_t>(count >> (8 * i));
    std::memcpy(to + kLengthBytes, message, count);
    size_ += kLengthBytes + count;
    return true;
  }
  Bytes waiting() const { return {bytes_.data() + first_, size_}; }
  void sent(std::size_t count) {
    first_ = count < size_ ? first_ + count : 0;
    size_ -= count;
  }
  void clear() { first_ = size_ = 0; }

 private:
  std::array<std::uint8_t, kOutputBytes> bytes_;
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace tactus
