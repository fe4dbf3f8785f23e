// Plays the tapes of a reel on a bare Cortex-M7 and prints each tape's cycles and end. The reel's
// path is the emulator's last argument. The emulator counts the instructions of the cycles.
#include <new>

#include "tests/wcet/m7/console.hpp"
#include "tests/wcet/pipeline_text.hpp"
#include "tests/wcet/player.hpp"

namespace {

using namespace tactus;

constexpr std::size_t kReelBytes = std::size_t{15} << 20;
[[gnu::section(".tapes,\"aw\",%nobits@")]] std::uint8_t reel_bytes[kReelBytes];
alignas(Player) unsigned char player_bytes[sizeof(Player)];

/// Every tape gets a player that has never run.
Status play(const Bytes& tape, std::uint32_t& cycles) {
  static LoadError error;
  Player& player = *new (player_bytes) Player;
  TRY(player.load(pipeline_file(), error));
  player.insert(tape);
  while (player.prepare()) {
    ++cycles;
    static_cast<void>(player.cycle());  // on every rung, until the drives are disabled
  }
  cycles += player.arming_cycles();
  return player.executive().latched();
}

}  // namespace

extern "C" int measure() {
  static char line[512];
  const char* const path = semihosting::last_argument(line, sizeof line);
  Bytes reel(reel_bytes, semihosting::read_file(path, reel_bytes, sizeof reel_bytes));
  if (reel.empty()) {
    semihosting::print("no reel\n");
    return 1;
  }
  while (!reel.empty()) {
    std::uint32_t cycles = 0;
    const Status status = play(next_tape(reel), cycles);
    semihosting::print(cycles);
    semihosting::print(" ");
    semihosting::print(name(status));
    semihosting::print("\n");
  }
  return 0;
}
