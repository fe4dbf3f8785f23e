// The chunks as they are: through client, generator and motion of one space, in lock-step.
#include <cstdio>

#include "gateway/chunk.hpp"
#include "tests/bench/policies/recording.hpp"
#include "tests/bench/policies/replay.hpp"
#include "tests/bench/policies/space_points.hpp"
#include "tests/reference/motion/motion_bench.hpp"

namespace tactus {
namespace {

/// Turns a message into what a client sends. False if it has too many points.
template <class Space>
bool fill(Chunk<Space>& chunk, const ChunkMessage& message, const Replay& replay) {
  chunk.sequence = message.number + 1;
  chunk.fade_s = replay.fade_s;
  chunk.smoothing_s = replay.smoothing_s;
  chunk.count = 0;
  for (const ChunkPoint& point : message.points)
    if (!chunk.add(1e-9 * static_cast<double>(point.t_target_ns), point_of<Space>(point)))
      return false;
  return true;
}

/// What became of the chunks, by their reports.
struct Account {
  int executed = 0, superseded = 0, starved = 0, refused = 0;
  Status why = Status::kOk;  // of the last that was refused

  void add(const Report& report) {
    switch (report.outcome) {
      case Outcome::kExecuted: ++executed; return;
      case Outcome::kSuperseded: ++superseded; return;
      case Outcome::kStarved: ++starved; return;
      default: ++refused; why = report.verdict.status;
    }
  }
};

void print(const Account& account, const StreamState& stream) {
  std::printf(
      "{\"executed\": %d, \"superseded\": %d, \"starved\": %d, \"refused\": %d, "
      "\"status\": %d, \"trimmed\": %u, \"late\": %u, \"dropped\": %u, \"shaped\": %u}\n",
      account.executed, account.superseded, account.starved, account.refused,
      static_cast<int>(account.why), +stream.trimmed, +stream.late, +stream.dropped,
      +stream.shaped);
}

}  // namespace

template <class Space>
bool replay_chunks(const std::vector<ChunkMessage>& messages, const Replay& replay) {
  static Chunk<Space> chunk;
  static MotionBench<Space> bench(replay.period_s());
  Recording recording(replay.out);
  if (!recording.open()) return false;
  if (bench.start(point_of<Space>(messages.front().points.front())) != Status::kOk) return false;
  Account account;
  std::size_t next = 0;
  for (int cycle = 0; cycle < replay.cycles(); ++cycle) {
    const bool starving = bench.generator.phase() == MotionPhase::kExpiring;
    recording.add(replay.time_s(cycle), bench.out(), bench.home, starving);
    for (; next < messages.size(); ++next) {
      if (messages[next].t_arrival_ns > replay.time_ns(cycle)) break;
      std::uint32_t id = 0;
      if (!fill(chunk, messages[next], replay)) return false;
      const Verdict verdict = bench.client.send(chunk, id);
      if (!verdict.ok()) account.add({0, Outcome::kRefused, -1, verdict});
    }
    if (bench.step() != Status::kOk) return false;
    for (Report report; bench.client.poll(report);) account.add(report);
  }
  print(account, bench.client.stream());
  return true;
}

template bool replay_chunks<JointSpace>(const std::vector<ChunkMessage>&, const Replay&);
template bool replay_chunks<TaskSpace>(const std::vector<ChunkMessage>&, const Replay&);

}  // namespace tactus
