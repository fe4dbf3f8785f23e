// Properties that the reference generator keeps for any request at any time in any state: requests
// of every kind at random, in both spaces, at 1, 2 and 8 ms, for one robot per build.
//
// TACTUS_TRIALS is the number of requests of all tests together. A failure prints the seed of its
// run: TACTUS_SEED=<seed> TACTUS_TRIALS=1 repeats that run in every test.
#include <cstdlib>

#include "tests/reference/motion/motion_requests.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

constexpr std::uint64_t kSeed = 20261122;
constexpr int kTests = 8;
constexpr int kRequestsPerRun = 40;
/// Least share of the trajectories and points requested that must be executed.
constexpr double kLeastTrajectories = 0.45, kLeastPoints = 0.85;
/// Seeds of runs that failed once: a way too long for a period, a velocity step between two parts
/// of a path, a room too large for its segment, a stop that released its brake or its jerk, a mean
/// acceleration above its limit at 8 ms, a jerk taken from a way in at its own limit.
constexpr std::uint64_t kOnceFailed[] = {
    5837284900634983, 8966911129746203, 3822219617711525, 4532017089412264, 2326809090656525,
    974891226305610,  3896111652972576, 3757579784762086, 4254753371693082, 10046943909538,
    7976923023495404, 3821820824316394, 3874442284727342, 5746173847033107, 2375753774344428,
    8965252895867855, 7496752964883497, 8440048193347518, 4337744664004659, 3773540480588548,
    408396910347955,  8718023624014234, 4477897108905867, 4937169611363109};
/// Longest stop, as a multiple of the time in which the slowest track stops from its fastest.
constexpr double kStopTimes = 6.0;
/// Cycles after the last request in which a full mailbox empties at one request per cycle.
constexpr int kSettling = 64;

int requests() {
  return trials(tries(12000, 1000)) / kTests + 1;
}
std::uint64_t first_seed() {
  const char* wanted = std::getenv("TACTUS_SEED");
  return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : kSeed;
}

/// The treatment of points, and the smoothness that is expected.
struct Kind {
  OnlineMode online;
  Smoothness smoothness;
};

/// A generator, one random client and the oracle.
template <class Space>
class Run {
 public:
  Run(std::uint64_t seed, const Kind& kind, bool shown)
      : seed_(seed),
        kind_(kind),
        shown_(shown),
        dice_{seed},
        bench_(period(dice_), online(dice_, kind)),
        client_(bench_, accounts_, dice_, kind.smoothness) {
    bench_.channel.settings.limits = MotionCases<Space>::limits(dice_);
    if (dice_.chance(0.5)) bench_.params.timeout_s = dice_.uniform(0.02, 0.3);
    static_cast<void>(bench_.start(bench_.home));
    oracle_.begin(bench_.channel.settings.limits, bench_.period_s, kind.smoothness, kRateJerk);
  }
  /// Runs all requests; true if every property held.
  bool pass() {
    for (int i = 0; i < kRequestsPerRun && !accounts_.full(); ++i) {
      client_.ask();
      for (int k = cycles(); k > 0; --k) {
        if (!cycle()) return false;
      }
    }
    return settles();
  }
  int asked() const { return client_.asked(); }
  const MotionAccounts& accounts() const { return accounts_; }

 private:
  static double period(Dice& dice) {
    static constexpr std::array<double, 3> kPeriods_s = {1e-3, 2e-3, 8e-3};
    return kPeriods_s[static_cast<std::size_t>(dice.below(3))];
  }
  /// Points that are not kept within limits are either refused if too far, or forwarded.
  static OnlineMode online(Dice& dice, const Kind& kind) {
    const bool refuses = kind.online == OnlineMode::kForward && dice.chance(0.3);
    return refuses ? OnlineMode::kRefuse : kind.online;
  }
  /// Returns a number of cycles, from none up to 1.5 s, short times more often.
  int cycles() {
    static constexpr std::array<double, 7> kLongest_s = {0.0, 0.0, 0.02, 0.1, 0.3, 0.5, 1.5};
    const int which = dice_.below(7);
    const double time_s = dice_.uniform(0.0, kLongest_s[static_cast<std::size_t>(which)]);
    return which == 0 ? 0 : 1 + bench_.cycles(time_s);
  }
  bool cycle() {
    ++cycle_;
    if (!client_.step()) return complain({"status", -1, 0.0, 0.0});
    if (kind_.online == OnlineMode::kLimit) {
      const Excess excess = oracle_.check(bench_.out());
      if (excess.what != nullptr) return complain(excess);
    } else if (!bench_.out().finite()) {
      return complain({"finite", -1, 0.0, 0.0});
    }
    if (accounts_.wrong() != nullptr) return complain({accounts_.wrong(), -1, 0.0, 0.0});
    if (client_.restarted()) oracle_.forget();
    return true;
  }
  /// Checks that without further requests everything is reported and the arm comes to rest.
  bool settles() {
    client_.calm_down();
    for (int k = 0; k < kSettling; ++k) {
      if (!cycle()) return false;
    }
    const typename Space::Limits& limits = bench_.channel.settings.limits;
    const bool on_path = bench_.executing();
    const double stop_s = kStopTimes * stopping_time_s<Space>(limits);
    const bool brakes = dice_.chance(0.3), goes_on = !brakes && !on_path;  // on to the last point
    const double rest_s = stop_s + (goes_on ? crossing_time_s<Space>(limits) : 0.0);
    const int most = bench_.cycles(rest_s) + 2;
    if (brakes) client_.brake_for(most + 1);
    if (!brakes) client_.finish();
    for (int k = 0; k < most; ++k) {
      if (!cycle()) return false;
    }
    // A point forwarded with a velocity keeps it until a timeout ends it.
    const bool rests =
        brakes || kind_.online == OnlineMode::kLimit || bench_.params.timeout_s > 0.0;
    if (rests && !bench_.out().standing())
      return complain({"not at rest after a stop, cycles", -1, 0.0, 1.0 * most});
    for (int k = 0; k < kSettling; ++k) {
      if (!cycle()) return false;
    }
    if (accounts_.open_requests() != 0)
      return complain({"requests without an end", -1, 1.0 * accounts_.open_requests(), 0.0});
    if (accounts_.stores_away() != 0)
      return complain({"stores that did not come back", -1, 1.0 * accounts_.stores_away(), 0.0});
    return true;
  }
  bool complain(const Excess& excess) {
    if (!shown_) return false;
    std::printf("  TACTUS_SEED=%llu, %g ms, cycle %d, track %d: %s: %.17g, limit %.17g\n",
                static_cast<unsigned long long>(seed_), 1e3 * bench_.period_s, cycle_, excess.track,
                excess.what, excess.value, excess.limit);
    client_.print_log();
    return false;
  }

  std::uint64_t seed_;
  Kind kind_;
  bool shown_;
  Dice dice_;
  MotionBench<Space> bench_;
  static MotionAccounts accounts_;  // large
  RandomClient<Space> client_;
  MotionOracle<Space> oracle_;
  int cycle_ = 0;
};
template <class Space>
MotionAccounts Run<Space>::accounts_;

void add(MotionAccounts::Motions& to, const MotionAccounts::Motions& more) {
  to.asked += more.asked;
  to.executed += more.executed;
}

template <class Space>
void repeat_once_failed(const Kind& kind) {
  for (const std::uint64_t seed : kOnceFailed) {
    Run<Space> run(seed, kind, true);
    assert_true(run.pass());
  }
}

/// Makes runs of one kind until enough requests were made; prints the first runs that fail.
template <class Space>
void check(const Kind& kind) {
  if (std::getenv("TACTUS_SEED") == nullptr) repeat_once_failed<Space>(kind);
  constexpr int kShown = 5;
  Dice seeds{first_seed()};
  std::uint64_t seed = first_seed();
  int asked = 0, runs = 0, failed = 0;
  MotionAccounts::Motions trajectories, points;
  while (asked < requests()) {
    Run<Space> run(seed, kind, failed < kShown);
    failed += run.pass() ? 0 : 1;
    asked += run.asked();
    add(trajectories, run.accounts().trajectories());
    add(points, run.accounts().points());
    ++runs;
    seed = seeds.bits();
  }
  print_message("%d requests in %d runs: %d of %d trajectories, %d of %d points; %d runs failed\n",
                asked, runs, trajectories.executed, trajectories.asked, points.executed,
                points.asked, failed);
  assert_int_equal(failed, 0);
  if (asked < 1000) return;
  assert_true(trajectories.executed > kLeastTrajectories * trajectories.asked);
  const bool limits = kind.online == OnlineMode::kLimit;
  assert_true(!limits || points.executed > kLeastPoints * points.asked);
}

// Proves RG-21.

void joints_asked_for_anything_at_any_time_stay_within_limits(void**) {
  check<JointSpace>({OnlineMode::kLimit, Smoothness::kAcceleration});
}
void joints_asked_for_cubics_too_stay_within_limits(void**) {
  check<JointSpace>({OnlineMode::kLimit, Smoothness::kVelocity});
}
void joints_asked_for_lines_too_stay_within_limits(void**) {
  check<JointSpace>({OnlineMode::kLimit, Smoothness::kPosition});
}
void joints_whose_points_are_forwarded_stay_finite_and_every_request_is_told(void**) {
  check<JointSpace>({OnlineMode::kForward, Smoothness::kPosition});
}
void a_tip_asked_for_anything_at_any_time_stays_within_limits(void**) {
  check<TaskSpace>({OnlineMode::kLimit, Smoothness::kAcceleration});
}
void a_tip_asked_for_cubics_too_stays_within_limits(void**) {
  check<TaskSpace>({OnlineMode::kLimit, Smoothness::kVelocity});
}
void a_tip_asked_for_lines_too_stays_within_limits(void**) {
  check<TaskSpace>({OnlineMode::kLimit, Smoothness::kPosition});
}
void a_tip_whose_points_are_forwarded_stays_finite_and_every_request_is_told(void**) {
  check<TaskSpace>({OnlineMode::kForward, Smoothness::kPosition});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(joints_asked_for_anything_at_any_time_stay_within_limits),
      cmocka_unit_test(joints_asked_for_cubics_too_stay_within_limits),
      cmocka_unit_test(joints_asked_for_lines_too_stay_within_limits),
      cmocka_unit_test(joints_whose_points_are_forwarded_stay_finite_and_every_request_is_told),
      cmocka_unit_test(a_tip_asked_for_anything_at_any_time_stays_within_limits),
      cmocka_unit_test(a_tip_asked_for_cubics_too_stays_within_limits),
      cmocka_unit_test(a_tip_asked_for_lines_too_stays_within_limits),
      cmocka_unit_test(a_tip_whose_points_are_forwarded_stays_finite_and_every_request_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
