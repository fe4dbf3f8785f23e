// ChunkRun: one random run of chunks, velocities, points, cancels and stops, checked in every
// cycle.
#pragma once

#include <cstring>

#include "tests/reference/motion/motion_oracle.hpp"
#include "tests/streams/chunk_sender.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr double kRun_s = 6.0;
inline constexpr std::size_t kMostIds = 8192;

/// Counts of what became of the messages of one run.
struct ReportCounts {
  int sent = 0, finals = 0, executed = 0, superseded = 0, refused = 0, starved = 0;
};

/// A generator, a policy, disturbances, and the checks of every cycle.
template <class Space>
class ChunkRun {
 public:
  using Point = typename Space::Point;

  explicit ChunkRun(std::uint64_t seed)
      : seed_(seed), dice_{seed}, bench_(period(dice_)), sender_(dice_) {
    bench_.channel.settings.limits = MotionCases<Space>::limits(dice_);
    static_cast<void>(bench_.start(bench_.home));
    oracle_.begin(bench_.channel.settings.limits, bench_.period_s, Smoothness::kAcceleration, 0.0);
    disturbs_ = dice_.chance(0.7);
  }
  /// Returns what was violated; null if nothing.
  const char* pass() {
    const int cycles = bench_.cycles(kRun_s);
    for (int k = 0; k < cycles; ++k) {
      send();
      if (disturbs_ && dice_.chance(0.4 * bench_.period_s)) disturb();
      if (!cycle()) return what_;
    }
    return settles();
  }
  const ReportCounts& told() const { return told_; }
  std::uint64_t sum() const { return sum_; }
  void print() const {
    print_error("TACTUS_SEED=%llu, %g ms, %.4f s, %s, track %d: %s: %.17g, limit %.17g\n",
                static_cast<unsigned long long>(seed_), 1e3 * bench_.period_s,
                bench_.generator.time_s(), name(bench_.generator.phase()), track_, what_, value_,
                limit_);
  }

 private:
  static double period(Dice& dice) {
    static constexpr std::array<double, 3> kPeriods_s = {1e-3, 2e-3, 8e-3};
    return kPeriods_s[static_cast<std::size_t>(dice.below(3))];
  }
  void note_sent(const Verdict& verdict, std::uint32_t id) {
    if (!verdict.ok()) return;
    ++told_.sent;
    finals_[id % kMostIds] = 0;
  }
  void send() {
    const double now_s = bench_.generator.time_s();
    const typename Space::Limits& limits = bench_.channel.settings.limits;
    sender_.observe(now_s, limits, bench_.out());
    SentChunk<Space> arrived;
    while (sender_.take(now_s, arrived)) {
      arrived.write(chunk_, limits);
      std::uint32_t id = 0;
      const Verdict verdict = bench_.client.send(chunk_, id);
      note_sent(verdict, id);
    }
  }
  void disturb() {
    std::uint32_t id = 0;
    switch (dice_.below(5)) {
      case 0: {
        const Verdict verdict = bench_.client.cancel(id);
        note_sent(verdict, id);
        if (dice_.chance(0.7)) sender_.begin_epoch(0);
        break;
      }
      case 1: {
        const Point to = MotionCases<Space>::somewhere(dice_, bench_.channel.settings.limits,
                                                       bench_.out().at_rest(), 0.3);
        const Verdict verdict = bench_.client.send(to, id);
        note_sent(verdict, id);
        break;
      }
      case 2: drive(); break;
      case 3: braking_ = 1 + dice_.below(bench_.cycles(0.3)); break;
      case 4: sender_.begin_epoch(0); break;
    }
  }
  void drive() {
    Velocity<Space> velocity;
    velocity.rates = MotionCases<Space>::direction(dice_, bench_.channel.settings.limits);
    velocity.timeout_s = dice_.uniform(0.02, 0.5);
    velocity.in_tool = dice_.chance(0.5);
    if (dice_.chance(0.5)) velocity.acceleration = dice_.uniform(0.2, 1.0);
    if (dice_.chance(0.5)) velocity.jerk = dice_.uniform(0.2, 1.0);
    std::uint32_t id = 0;
    const Verdict verdict = bench_.client.send(velocity, id);
    note_sent(verdict, id);
  }
  bool cycle() {
    if (bench_.step() != Status::kOk) return complain("status");
    if (braking_ > 0) {
      bench_.brake(Status::kCollision);
      if (--braking_ == 0) {
        const Point now = bench_.out();
        static_cast<void>(bench_.start(now));
        oracle_.forget();
        sender_.restart();
        sender_.begin_epoch(bench_.client.stream().epoch);
      }
    }
    const Excess excess = oracle_.check(bench_.out());
    if (excess.what != nullptr) {
      track_ = excess.track;
      value_ = excess.value;
      limit_ = excess.limit;
      return complain(excess.what);
    }
    add(bench_.out());
    return listen();
  }
  bool listen() {
    Report report;
    while (bench_.client.poll(report)) {
      if (report.id == 0) return complain("a report of nothing that was sent");
      int& finals = finals_[report.id % kMostIds];
      switch (report.outcome) {
        case Outcome::kStarved:
          ++told_.starved;
          if (finals != 1) return complain("starved before it was executed");
          continue;
        case Outcome::kExecuted: ++told_.executed; break;
        case Outcome::kSuperseded: ++told_.superseded; break;
        case Outcome::kRefused: ++told_.refused; break;
        default: return complain("an outcome of another kind");
      }
      ++told_.finals;
      if (++finals != 1) return complain("told twice");
    }
    return true;
  }
  /// Without more chunks everything is told and the arm comes to rest, with all stores free.
  const char* settles() {
    const double rest_s = 4.0 + 7.0 * stopping_time_s<Space>(bench_.channel.settings.limits) +
                          crossing_time_s<Space>(bench_.channel.settings.limits);
    for (int k = bench_.cycles(rest_s); k > 0; --k) {
      if (!cycle()) return what_;
    }
    std::uint32_t id = 0;
    const Verdict verdict = bench_.client.cancel(id);
    note_sent(verdict, id);
    for (int k = bench_.cycles(7.0 * stopping_time_s<Space>(bench_.channel.settings.limits)) + 20;
         k > 0; --k) {
      if (!cycle()) return what_;
    }
    if (told_.finals != told_.sent) complain("not every message was answered");
    if (!bench_.out().standing()) complain("not at rest");
    for (const ChunkCurve<Space>& chunk : bench_.channel.chunks) {
      if (!chunk.free) complain("a chunk was not released");
    }
    return what_;
  }
  void add(const Point& point) {
    std::array<std::uint64_t, sizeof(Point) / sizeof(std::uint64_t)> bits;
    std::memcpy(bits.data(), &point, sizeof(bits));
    for (const std::uint64_t word : bits) sum_ = (sum_ ^ word) * 1099511628211U;
  }
  bool complain(const char* what) {
    what_ = what;
    return false;
  }

  std::uint64_t seed_;
  Dice dice_;
  MotionBench<Space> bench_;
  ChunkSender<Space> sender_;
  MotionOracle<Space> oracle_;
  static Chunk<Space> chunk_;                // large
  static std::array<int, kMostIds> finals_;  // of each number
  ReportCounts told_;
  bool disturbs_ = false;
  int braking_ = 0, track_ = -1;
  double value_ = 0.0, limit_ = 0.0;
  const char* what_ = nullptr;
  std::uint64_t sum_ = 14695981039346656037U;
};
template <class Space>
Chunk<Space> ChunkRun<Space>::chunk_;
template <class Space>
std::array<int, kMostIds> ChunkRun<Space>::finals_;

}  // namespace tactus
