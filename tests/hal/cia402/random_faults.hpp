// Random faults at random times in every phase, several per run, with random requests of the
// executive; what must hold in every cycle is judged by SafetyWatch and here.
#pragma once

#include <cstdlib>

#include "tests/hal/cia402/safety_watch.hpp"
#include "tests/support/random.hpp"

namespace tactus::cia402 {

inline std::uint64_t number(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

struct Account {
  int takeovers = 0, refused = 0, stops = 0, longest_off = 0;
  double fastest = 0.0, farthest = 0.0;
};

template <class Bench>
class RandomRun {
 public:
  RandomRun(Random& random, Bench& bench, Account& account)
      : random_(random), bench_(bench), watch_(bench), account_(account) {}

  void go(void (*begin_fault)(Bench& bench, Random& random)) {
    constexpr int kCycles = 1400;
    // A quick stop of a drive ends after [cia402] stop_ms by cutting the voltage; before it, frames
    // may be missing until the drive's time-out. A few cycles to see and to send it.
    constexpr int kMostOff = 2000 + 10 + 5;
    ASSERT_OK(bench_.load());
    connect();
    for (int i = 0; i < kCycles; ++i) {
      if (random_.below(250) == 0) begin_fault(bench_, random_);
      if (random_.below(80) == 0) heal(bench_);
      request();
      const Rung before = bench_.executive.rung();
      const Status status = watch_.cycle();
      if (before != Rung::kDisabled && bench_.executive.rung() == Rung::kDisabled) ++account_.stops;
      assert_in_range(watch_.longest_off(), 0, kMostOff);
      if (status == Status::kArming && bench_.executive.arm() == Status::kOk) judge_takeover();
    }
    account_.longest_off = std::max(account_.longest_off, watch_.longest_off());
    account_.fastest = std::max(account_.fastest, watch_.fastest());
  }

 private:
  void connect() {
    if (bench_.connect() != Status::kOk) ++account_.refused;
  }
  void request() {
    if (bench_.executive.rung() == Rung::kDisabled && random_.below(10) == 0) {
      const Status status = bench_.executive.arm();
      assert_true(status != Status::kOk);
      if (status != Status::kArming && status != Status::kNotAtRest && random_.below(3) == 0)
        connect();
    }
    if (random_.below(200) == 0) bench_.executive.halt();
    if (random_.below(1000) == 0) static_cast<void>(bench_.executive.stop());
    if (random_.below(20) == 0) {
      JointSpace::Point point;
      point.q = bench_.plant_q() + JointVector::Constant(random_.uniform(-0.02, 0.02));
      std::uint32_t id = 0;
      static_cast<void>(bench_.client.send(point, id));
    }
    Report report;
    while (bench_.client.poll(report)) {
    }
  }
  /// The first reference is where the arm is: what was measured a cycle ago, to within what a joint
  /// at rest moves in a few cycles.
  void judge_takeover() {
    ++account_.takeovers;
    const JointVector error = bench_.pipeline.robot.q.value - bench_.plant_q();
    account_.farthest = std::max(account_.farthest, error.cwiseAbs().maxCoeff());
    assert_true(error.cwiseAbs().maxCoeff() < 1e-3);
  }

  Random& random_;
  Bench& bench_;
  SafetyWatch<Bench> watch_;
  Account& account_;
};

/// TACTUS_TRIALS runs, each on a fresh bench.
template <class Bench>
void survive_random_faults(Bench& (*fresh)(Random& random),
                           void (*begin_fault)(Bench& bench, Random& random)) {
  const auto runs = static_cast<int>(number("TACTUS_TRIALS", 100));
  const std::uint64_t seed = number("TACTUS_SEED", 20270101);
  Account account;
  for (int i = 0; i < runs; ++i) {
    const std::uint64_t now = seed + static_cast<std::uint64_t>(i);
    if (std::getenv("TACTUS_VERBOSE") != nullptr)
      print_message("seed %llu\n", static_cast<unsigned long long>(now));
    Random random{now};
    RandomRun<Bench>(random, fresh(random), account).go(begin_fault);
  }
  print_message(
      "%d runs: %d takeovers, %d stops, %d connections refused, off after %d cycles at most, "
      "fastest joint %.2f of its limit, takeover within %.1e rad\n",
      runs, account.takeovers, account.stops, account.refused, account.longest_off, account.fastest,
      account.farthest);
  assert_true(account.takeovers > runs / 2);
}

}  // namespace tactus::cia402
