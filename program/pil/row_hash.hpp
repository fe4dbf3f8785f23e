// row_hash: what is recorded of a cycle in one number, by which two machines compare what they have
// computed. It is of the bits: zeros of both signs differ.
#pragma once

#include "gateway/fnv1a.hpp"
#include "kernel/pipeline/recorder.hpp"

namespace tactus {

/// Returns the hash of the present values of the recorded outputs. [cyclic]
inline std::uint64_t row_hash(const Recording& recording) {
  std::uint64_t hash = fnv1a({});
  double numbers[16];
  for (int i = 0; i < recording.signal_count; ++i) {
    const int count = flatten(*recording.signals[static_cast<std::size_t>(i)], numbers);
    hash = fnv1a(
        {reinterpret_cast<const char*>(numbers), sizeof(double) * static_cast<std::size_t>(count)},
        hash);
  }
  return hash;
}

}  // namespace tactus
