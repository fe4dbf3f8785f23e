// The text of a peer, made fit for a terminal.
#pragma once

#include <string_view>

#include "kernel/core/text.hpp"

namespace tactus {

/// Returns the text with a question mark for every byte that is not printable ASCII: escape
/// sequences of a peer must not reach a terminal. [any]
inline Message printable(std::string_view text) {
  Message safe;
  for (const char& character : text) {
    const bool prints = character >= ' ' && character <= '~';
    safe << (prints ? std::string_view(&character, 1) : "?");
  }
  return safe;
}

}  // namespace tactus
