// Searches for the tape with the longest cycle: a target of libFuzzer that rewards new paths and
// the amount of code that one cycle executes. It counts bytes of code per basic block, which
// approximates instructions and needs no emulator; the M7 then counts the instructions of the tapes
// found.
#include <algorithm>
#include <array>
#include <new>

#include "tests/wcet/pipeline_text.hpp"
#include "tests/wcet/player.hpp"

// Symbols that the compiler's coverage adds to the program. [Clang, SanitizerCoverage: inline 8-bit
// counters, PC table]
struct Block {
  std::uintptr_t address, flags;
};
extern "C" {
extern std::uint8_t counters_begin[] asm("__start___sancov_cntrs");
extern std::uint8_t counters_end[] asm("__stop___sancov_cntrs");
extern const Block blocks_begin[] asm("__start___sancov_pcs");
}

namespace {

using namespace tactus;

constexpr std::size_t kMostBlocks = 1 << 17, kSlices = 32, kLevels = 512;
constexpr int kMaxCycles = 400;  // of a tape: longer tapes only slow the search down

// Levels reached, of the whole and of parts: libFuzzer keeps a tape that reaches a new one.
[[gnu::section(
    "__libfuzzer_extra_counters")]] std::array<std::array<std::uint8_t, kLevels>, kSlices + 1>
    reached;

std::array<std::uint32_t, kMostBlocks> bytes_of;  // of code, in every block
std::array<std::uint8_t, kMostBlocks> ever;       // the counters of all cycles, libFuzzer's own
std::size_t block_count = 0;

/// A block's code extends to the beginning of the next one.
void measure_blocks() {
  static std::array<std::uintptr_t, kMostBlocks> sorted;
  block_count =
      std::min<std::size_t>(static_cast<std::size_t>(counters_end - counters_begin), kMostBlocks);
  for (std::size_t i = 0; i < block_count; ++i) sorted[i] = blocks_begin[i].address;
  std::sort(sorted.begin(), sorted.begin() + block_count);
  for (std::size_t i = 0; i < block_count; ++i) {
    const std::uintptr_t* const next =
        std::upper_bound(sorted.data(), sorted.data() + block_count, blocks_begin[i].address);
    const bool last = next == sorted.data() + block_count;
    bytes_of[i] = last ? 16
                       : static_cast<std::uint32_t>(
                             std::min<std::uintptr_t>(*next - blocks_begin[i].address, 4096));
  }
}

/// The level grows with the logarithm of the count, by `per_doubling`.
void note_level(std::size_t slice, std::uint64_t count, std::size_t per_doubling) {
  if (count == 0) return;
  std::size_t doubling = 0;
  while ((count >> doubling) > 1) ++doubling;
  const std::uint64_t rest = ((count << 8) >> doubling) - 256;  // 0..255
  const std::size_t level = doubling * per_doubling + rest * per_doubling / 256;
  reached[slice][std::min(level, kLevels - 1)] = 1;
}

/// Notes the levels of the cycle just run; the counters restart.
void weigh() {
  std::array<std::uint64_t, kSlices> parts{};
  for (std::size_t i = 0; i < block_count; ++i) {
    const std::uint8_t times = counters_begin[i];
    parts[i * kSlices / block_count] += std::uint64_t{bytes_of[i]} * times;
    ever[i] = std::max(ever[i], times);
    counters_begin[i] = 0;
  }
  std::uint64_t sum = 0;
  for (std::size_t slice = 0; slice < kSlices; ++slice) {
    note_level(slice, parts[slice], 4);
    sum += parts[slice];
  }
  note_level(kSlices, sum, 16);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alignas(Player) static unsigned char bytes[sizeof(Player)];
  static LoadError error;
  if (block_count == 0) measure_blocks();
  Player& player = *new (bytes) Player;
  if (player.load(pipeline_file(), error) != Status::kOk) __builtin_trap();
  player.insert({data, size});
  ever.fill(0);
  for (int k = 0; k < kMaxCycles && player.prepare(); ++k) {
    std::fill(counters_begin, counters_end, std::uint8_t{0});
    static_cast<void>(player.cycle());
    weigh();
  }
  std::copy(ever.begin(), ever.begin() + block_count, counters_begin);
  return 0;
}
