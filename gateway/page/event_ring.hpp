// EventRing: the stream of server-sent events (WHATWG HTML, 9.2) for all browsers, in a ring of
// fixed size. Each browser reads it at its own pace; one that the writer overtakes has lost events
// and is disconnected.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "gateway/page/limits.hpp"

namespace tactus {

class EventRing {
 public:
  /// Appends an event; `data` has no line breaks and is shorter than the ring. [any, one thread]
  void append(std::string_view event, std::string_view data) {
    for (const std::string_view part :
         {std::string_view("event: "), event, std::string_view("\ndata: "), data,
          std::string_view("\n\n")})
      put(part);
  }
  /// Position from which a new browser reads.
  std::uint64_t end() const { return end_; }
  /// True if nothing behind `from` has been overwritten.
  bool holds(std::uint64_t from) const { return end_ - from <= ring_.size(); }
  /// Copies what is behind `from`, which the ring holds, up to `size` bytes; returns how many.
  std::size_t read(std::uint64_t from, char* to, std::size_t size) const {
    const std::size_t at = from % ring_.size();
    const std::size_t count =
        std::min({size, static_cast<std::size_t>(end_ - from), ring_.size() - at});
    std::memcpy(to, ring_.data() + at, count);
    return count;
  }

 private:
  void put(std::string_view text) {
    while (!text.empty()) {
      const std::size_t at = end_ % ring_.size();
      const std::size_t count = std::min(text.size(), ring_.size() - at);
      std::memcpy(ring_.data() + at, text.data(), count);
      text.remove_prefix(count);
      end_ += count;
    }
  }

  std::array<char, kEventRingBytes> ring_;
  std::uint64_t end_ = 0;
};

}  // namespace tactus
