// wcet-replay: plays the tapes of a reel on the host.
//
//   wcet-replay PIPELINE REEL times OUT             what the executive times, by name in the first
//                                                   line; then a line per cycle, in ns, 0: not run
//   wcet-replay PIPELINE REEL count TAPE:CYCLE...   for valgrind --tool=callgrind
//                                                   --instr-atstart=no: a dump of each of them; the
//                                                   cycles of arming count
//
// Exit code 1 with a message on the error stream.
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

std::uint64_t stopwatch() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::nanoseconds(now).count());
}

/// The stages that are timed, and their counts at the previous cycle.
struct Timed {
  std::string name;
  const Histogram* times;
  std::uint32_t before = 0;
};

std::vector<Timed> timed_of(const Player& player) {
  const CycleTimes& timing = *player.executive().times();
  const Pipeline& pipeline = player.pipeline();
  std::vector<Timed> timed;
  for (const Stage stage : {Stage::kCycle, Stage::kRead, Stage::kGuard, Stage::kWrite})
    timed.push_back({name(stage), &timing.stage(stage)});
  for (int i = 0; i < pipeline.count(); ++i)
    timed.push_back({pipeline.name(i).c_str(), &timing.block(i)});
  for (int i = 0; i < pipeline.schedule.count(); ++i)
    timed.push_back({pipeline.schedule[i].name, &timing.row(i)});
  return timed;
}

/// Plays a tape once; calls `each` to run each cycle.
template <class Each>
void play(const std::string& text, const Bytes& tape, const Timing& timing, Each each) {
  const auto player = std::make_unique<Player>(timing);
  LoadError error;
  if (player->load(text, error) != Status::kOk) {
    std::fprintf(stderr, "wcet-replay: the pipeline is refused\n");
    std::exit(1);
  }
  player->insert(tape);
  for (int k = 0; player->prepare(); ++k) each(*player, k);
}

void time(const std::string& text, Bytes reel, std::FILE* out) {
  for (bool first = true; !reel.empty(); first = false) {
    std::vector<Timed> timed;
    const auto times = std::make_unique<CycleTimes>();
    play(text, next_tape(reel), {stopwatch, *times}, [&](Player& player, int k) {
      if (k == 0) timed = timed_of(player);
      for (const Timed& each : timed)
        if (first && k == 0) std::fprintf(out, "%s ", each.name.c_str());
      if (first && k == 0) std::fprintf(out, "\n");
      static_cast<void>(player.cycle());
      for (Timed& each : timed) {
        const bool ran = each.times->count() != each.before;
        std::fprintf(out, "%u ", ran ? each.times->last() : 0U);
        each.before = each.times->count();
      }
      std::fprintf(out, "\n");
    });
  }
}

void count(const std::string& text, Bytes reel, const std::vector<std::string>& wanted) {
  for (int number = 0; !reel.empty(); ++number) {
    play(text, next_tape(reel), {}, [&](Player& player, int k) {
      const auto cycle = static_cast<unsigned>(k) + player.arming_cycles();
      const std::string here = std::to_string(number) + ":" + std::to_string(cycle);
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
  if (file == nullptr) {
    std::perror(path);
    std::exit(1);
  }
  std::string text;
  char part[65536];
  for (std::size_t size; (size = std::fread(part, 1, sizeof part, file)) > 0;)
    text.append(part, size);
  std::fclose(file);
  return text;
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3) {
    std::fprintf(stderr, "usage: see tests/wcet/replay.cpp\n");
    return 1;
  }
  const std::string text = tactus::read(argv[1]), bytes = tactus::read(argv[2]);
  const tactus::Bytes reel(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (words[2] == "count") {
    tactus::count(text, reel, {words.begin() + 3, words.end()});
    return 0;
  }
  if (words.size() < 4) {
    std::fprintf(stderr, "usage: see tests/wcet/replay.cpp\n");
    return 1;
  }
  std::FILE* const out = std::fopen(words[3].c_str(), "w");
  if (out == nullptr) {
    std::perror(words[3].c_str());
    return 1;
  }
  tactus::time(text, reel, out);
  return std::fclose(out) == 0 ? 0 : 1;
}
