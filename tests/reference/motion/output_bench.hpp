// What the tests of digital outputs send: chunks of random outputs, and of a line.
#pragma once

#include "tests/reference/motion/chunk_bench.hpp"

namespace tactus {

/// A motion that tells its time.
inline double line(double t) {
  return 0.3 * t * t / (0.5 + t);
}

/// Gives the chunk that is sent next random outputs.
template <class Space>
void set_outputs(ChunkBench<Space>& bench, Dice& dice, std::uint32_t mask, double lead_s) {
  bench.chunk.outputs_mask = mask;
  bench.chunk.outputs_lead_s = lead_s;
  for (std::uint32_t& outputs : bench.chunk.outputs)
    outputs = static_cast<std::uint32_t>(dice.bits());
}

template <class Space>
void write_targets(ChunkBench<Space>& bench, double first_s, double spacing_s, int count,
                   double shift) {
  bench.chunk.count = count;
  ++bench.chunk.sequence;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    bench.chunk.time_s[k] = first_s + i * spacing_s;
    bench.chunk.targets[k] =
        moved_by(bench.home, 0.1 * bench.signal(first_s + i * spacing_s) + shift);
  }
}

}  // namespace tactus
