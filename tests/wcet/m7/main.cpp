// Plays the tapes of a reel, whose path is the emulator's last argument, on a bare Cortex-M7 and
// says of each how many cycles it had and how it ended. What the cycles take is counted from
// outside.
#include <new>

#include "tests/wcet/m7/semihosting.hpp"
#include "tests/wcet/pipeline_text.hpp"
#include "tests/wcet/player.hpp"

namespace {

using namespace tactus;

constexpr std::size_t kReelBytes = std::size_t{15} << 20;
[[gnu::section(".tapes,\"aw\",%nobits@")]] std::uint8_t reel_bytes[kReelBytes];
alignas(Player) unsigned char player_bytes[sizeof(Player)];

/// Every tape finds a player that has never run.
Status play(const Bytes& tape, std::uint32_t& cycles) {
  static LoadError error;
  Player& player = *new (player_bytes) Player;
  TRY(player.load(pipeline_file(), error));
  player.insert(tape);
  while (player.prepare()) {
    ++cycles;
    static_cast<void>(player.cycle());  // on every rung, until the drives are disabled
  }
  return player.executive().latched();
}

}  // namespace

extern "C" int play_reel() {
  static char line[512];
  const char* const path = semihosting::last_argument(line, sizeof line);
  Bytes reel(reel_bytes, semihosting::read_file(path, reel_bytes, sizeof reel_bytes));
  if (reel.empty()) return semihosting::print("no reel\n"), 1;
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
