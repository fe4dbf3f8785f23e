// Outbox: the bytes that wait for a client to read them. A packet is taken whole or not at all, so
// a slow client loses whole packets and can always read the stream; one that does not read at all
// for too long is disconnected.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tactus::ur {

class Outbox {
 public:
  static constexpr std::size_t kCapacity = 64 * 1024;

  /// Adds a packet. False: it does not fit and is dropped.
  bool put(const std::uint8_t* data, std::size_t size) {
    if (size > kCapacity - (end_ - begin_)) {
      ++dropped_;
      return false;
    }
    if (size > kCapacity - end_) {
      std::memmove(bytes_.data(), bytes_.data() + begin_, end_ - begin_);
      end_ -= begin_;
      begin_ = 0;
    }
    if (size > 0) std::memcpy(bytes_.data() + end_, data, size);
    end_ += size;
    return true;
  }
  bool put(std::string_view text) {
    return put(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }

  const std::uint8_t* data() const { return bytes_.data() + begin_; }
  std::size_t size() const { return end_ - begin_; }
  bool empty() const { return begin_ == end_; }
  /// Removes the first `size` bytes, which the client's socket has taken.
  void sent(std::size_t size) {
    begin_ += size;
    if (begin_ == end_) begin_ = end_ = 0;
  }
  void clear() {
    begin_ = end_ = 0;
    dropped_ = 0;
  }
  std::int64_t dropped() const { return dropped_; }  ///< number of dropped packets

 private:
  std::array<std::uint8_t, kCapacity> bytes_;
  std::size_t begin_ = 0, end_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace tactus::ur
