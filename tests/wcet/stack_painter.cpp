// Paints a thread's stack, plays tapes and prints the depth of the cycles: "Executive::cycle
// bytes". scripts/certificate compares it with the bound of the same compilation, which must be
// larger.
#include <pthread.h>

#include <cstdio>
#include <cstring>
#include <new>

#include "tests/wcet/pipeline_text.hpp"
#include "tests/wcet/player.hpp"

namespace {

using namespace tactus;

constexpr std::size_t kStackBytes = std::size_t{1} << 20, kPaintedBytes = std::size_t{1} << 18;
constexpr std::size_t kRedZone = 256;  // below the painting frame, which is not touched
constexpr unsigned char kPaint = 0xa5;
constexpr int kTapes = 200;

alignas(4096) unsigned char stack[kStackBytes];
alignas(Player) unsigned char player_bytes[sizeof(Player)];
std::size_t deepest = 0;

using Call = void (*)(Player&);

/// Number of bytes below this frame that a call touches, its own frame included.
[[gnu::noinline]] std::size_t painted(Call call, Player& player) {
  auto* const top = static_cast<unsigned char*>(__builtin_frame_address(0));
  volatile unsigned char* const bottom = top - kPaintedBytes;
  for (std::size_t i = 0; i < kPaintedBytes - kRedZone; ++i) bottom[i] = kPaint;
  call(player);
  std::size_t clean = 0;
  while (clean < kPaintedBytes && bottom[clean] == kPaint) ++clean;
  return kPaintedBytes - clean;
}

/// Touches as little as possible at a known depth, to measure what painted() itself adds.
[[gnu::noinline]] void known(Player&) {
  volatile unsigned char frame[4 * kRedZone];
  for (volatile unsigned char& byte : frame) byte = 0;
}

void one_cycle(Player& player) {
  static_cast<void>(player.cycle());
}

/// The bytes of a random tape, with a fixed seed.
Bytes made_up(std::uint32_t seed) {
  static std::uint8_t bytes[2048];
  for (std::uint8_t& byte : bytes) {
    seed = seed * 1664525U + 1013904223U;  // Numerical Recipes, 7.1
    byte = static_cast<std::uint8_t>(seed >> 24);
  }
  return {bytes, sizeof bytes};
}

void* play(void*) {
  std::size_t own = 0;
  for (std::uint32_t k = 0; k < kTapes; ++k) {
    Player& player = *new (player_bytes) Player;
    LoadError error;
    if (player.load(pipeline_file(), error) != Status::kOk) return nullptr;
    if (k == 0) own = painted(known, player) - 4 * kRedZone;
    player.insert(made_up(k));
    while (player.prepare()) {
      const std::size_t depth = painted(one_cycle, player);
      if (depth > deepest) deepest = depth;
    }
  }
  deepest = deepest > own ? deepest - own : 0;
  return nullptr;
}

}  // namespace

int main() {
  pthread_attr_t attributes;
  pthread_t thread;
  pthread_attr_init(&attributes);
  if (pthread_attr_setstack(&attributes, stack, sizeof stack) != 0) return 1;
  if (pthread_create(&thread, &attributes, play, nullptr) != 0) return 1;
  pthread_join(thread, nullptr);
  std::printf("Executive::cycle %zu\n", deepest);
  return deepest > 0 ? 0 : 1;
}
