// Shared by the targets of libFuzzer. A target takes the bytes that one side of a wire may send,
// and traps where the parser violates its contract.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

/// A condition that must hold for all bytes.
#define MUST(condition)                                                               \
  do {                                                                                \
    if (!(condition)) {                                                               \
      std::fprintf(stderr, "%s:%d: must hold: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                   \
    }                                                                                 \
  } while (false)

namespace tactus::fuzz {

/// The input; its first byte determines how the rest is cut.
struct Tape {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
  std::size_t piece = 0;  ///< bytes that come at once
  bool hangs = false;     ///< ends in silence, not in a closed connection

  Tape(const std::uint8_t* bytes, std::size_t count) {
    if (count == 0) return;
    data = bytes + 1;
    size = count - 1;
    const std::size_t cut = bytes[0] & 0x7f;
    piece = cut == 0 ? std::max<std::size_t>(size, 1) : cut;
    hangs = (bytes[0] & 0x80) != 0;
  }
  std::string_view text() const { return {reinterpret_cast<const char*>(data), size}; }
  /// Calls `take(data, size)` for every piece.
  template <class Take>
  void deal(Take&& take) const {
    for (std::size_t at = 0; at < size; at += piece) take(data + at, std::min(piece, size - at));
  }
};

}  // namespace tactus::fuzz
