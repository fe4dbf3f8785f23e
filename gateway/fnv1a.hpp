// FNV-1a, 64 bits: the hash by which runs of the same files are recognised. Not cryptographic.
// Fowler, Noll, Vo, Eastlake: The FNV Non-Cryptographic Hash Algorithm.
#pragma once

#include <cstdint>
#include <string_view>

namespace tactus {

/// Returns the hash of a text, continued from `hash`. [any, not cyclic: proportional to its length]
inline std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325U) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

}  // namespace tactus
