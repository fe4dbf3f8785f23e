// wcet-replay: plays the tapes of a reel on the host.
//
//   wcet-replay PIPELINE REEL times OUT ADDRESS...   a line per cycle: its time in ns, and that of
//                                                    every function at an address meanwhile
//   wcet-replay PIPELINE REEL count TAPE:CYCLE...    for valgrind --tool=callgrind
//                                                    --instr-atstart=no: a dump of each of them
//
// The functions are timed in a second pass, for that takes time itself. They are those that were
// compiled with -finstrument-functions. Exit code 1 with a message on the error stream.
#include <valgrind/callgrind.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/wcet/player.hpp"

namespace tactus {
namespace {

using Clock = std::chrono::steady_clock;

struct Timed {
  std::uintptr_t address;
  std::int64_t ns;
  Clock::time_point begin;
};
std::vector<Timed> timed;
bool timing = false;

std::int64_t ns_since(Clock::time_point begin) {
  return std::chrono::nanoseconds(Clock::now() - begin).count();
}

Timed* find(const void* function) {
  for (Timed& each : timed)
    if (each.address == reinterpret_cast<std::uintptr_t>(function)) return &each;
  return nullptr;
}

/// One play of a tape; `each` is called for every cycle, to run it.
template <class Each>
void play(const std::string& text, const Bytes& tape, Each each) {
  const auto player = std::make_unique<Player>();
  LoadError error;
  if (player->load(text, error) != Status::kOk)
    std::fprintf(stderr, "wcet-replay: the pipeline is refused\n"), std::exit(1);
  player->insert(tape);
  for (int k = 0; player->prepare(); ++k) each(*player, k);
}

void time(const std::string& text, Bytes reel, std::FILE* out) {
  while (!reel.empty()) {
    const Bytes tape = next_tape(reel);
    std::vector<std::int64_t> cycles;
    timing = false;
    play(text, tape, [&](Player& player, int) {
      const Clock::time_point begin = Clock::now();
      static_cast<void>(player.cycle());
      cycles.push_back(ns_since(begin));
    });
    timing = true;
    play(text, tape, [&](Player& player, int k) {
      for (Timed& each : timed) each.ns = 0;
      static_cast<void>(player.cycle());
      std::fprintf(out, "%lld", static_cast<long long>(cycles[static_cast<std::size_t>(k)]));
      for (const Timed& each : timed) std::fprintf(out, " %lld", static_cast<long long>(each.ns));
      std::fprintf(out, "\n");
    });
  }
}

void count(const std::string& text, Bytes reel, const std::vector<std::string>& wanted) {
  for (int number = 0; !reel.empty(); ++number) {
    play(text, next_tape(reel), [&](Player& player, int k) {
      const std::string here = std::to_string(number) + ":" + std::to_string(k);
      bool dump = false;
      for (const std::string& each : wanted) dump = dump || each == here;
      if (!dump) return static_cast<void>(player.cycle());
      CALLGRIND_START_INSTRUMENTATION;
      CALLGRIND_ZERO_STATS;
      static_cast<void>(player.cycle());
      CALLGRIND_DUMP_STATS_AT(here.c_str());
      CALLGRIND_STOP_INSTRUMENTATION;
    });
  }
}

std::string read(const char* path) {
  std::FILE* const file = std::fopen(path, "rb");
  if (file == nullptr) std::perror(path), std::exit(1);
  std::string text;
  char part[65536];
  for (std::size_t size; (size = std::fread(part, 1, sizeof part, file)) > 0;)
    text.append(part, size);
  std::fclose(file);
  return text;
}

}  // namespace
}  // namespace tactus

// Called at the beginning and at the end of every function compiled for it.
extern "C" {
void __cyg_profile_func_enter(void* function, void*) {
  if (!tactus::timing) return;
  if (tactus::Timed* const each = tactus::find(function)) each->begin = tactus::Clock::now();
}
void __cyg_profile_func_exit(void* function, void*) {
  if (!tactus::timing) return;
  const tactus::Clock::time_point end = tactus::Clock::now();
  if (tactus::Timed* const each = tactus::find(function))
    each->ns += std::chrono::nanoseconds(end - each->begin).count();
}
}

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3) return std::fprintf(stderr, "usage: see tests/wcet/replay.cpp\n"), 1;
  const std::string text = tactus::read(argv[1]), bytes = tactus::read(argv[2]);
  const tactus::Bytes reel(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (words[2] == "count") {
    tactus::count(text, reel, {words.begin() + 3, words.end()});
    return 0;
  }
  if (words.size() < 4) return std::fprintf(stderr, "usage: see tests/wcet/replay.cpp\n"), 1;
  std::FILE* const out = std::fopen(words[3].c_str(), "w");
  if (out == nullptr) return std::perror(words[3].c_str()), 1;
  for (std::size_t i = 4; i < words.size(); ++i)
    tactus::timed.push_back({std::stoull(words[i], nullptr, 16), 0, {}});
  tactus::time(text, reel, out);
  return std::fclose(out) == 0 ? 0 : 1;
}
