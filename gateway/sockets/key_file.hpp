// The key that a server and its clients have in common: 32 bytes in a file, as 64 hexadecimal
// digits, that no other user may read.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/core/text.hpp"

namespace tactus {

using Key = std::array<std::uint8_t, 32>;

/// Reads a key file. False: `why` names place and remedy, and nothing of the key. [init]
bool read_key(const char* path, Key& key, Message& why);

}  // namespace tactus
