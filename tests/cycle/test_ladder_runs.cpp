// Tests the ladder in a thousand random runs with delays, faults and rearms. Every cycle of every
// run must keep the limits and the largest step of a command, must not catch up after a gap, and
// must leave a log that explains the rung.
#include <array>

#include "tests/cycle/executive_bench.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr std::uint64_t kSeed = 20261121;
constexpr int kRuns = tries(1000, 100), kCycles = 400;
constexpr double kPeriod_s = ExecutiveBench::kPeriod_s;
constexpr auto kPeriod_ns = static_cast<double>(ExecutiveBench::kPeriod_ns);
constexpr double kSpeed = 0.5;  // rad/s, of the line that is sent

constexpr std::string_view kPositions =
    "[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\n"
    "[executive]\nclean_cycles = 20\nstop_ms = 150\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\ndq = robot.dq\n";
constexpr std::string_view kEfforts =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[executive]\nclean_cycles = 20\nstop_ms = 150\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\ndq = robot.dq\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\nkp = 400\nkd = 40\n";

/// Unit inertias under efforts, or drives that reach their command within a period and hold it in a
/// gap.
struct Plant {
  FakeHal& hal;
  bool efforts;

  void pass(double time_s) {
    RobotState& state = hal.state;
    if (!hal.enabled()) {  // brakes engage
      state.dq.setZero();
      state.tau.setZero();
      return;
    }
    if (!efforts) {
      state.dq = (hal.command.value - state.q) / time_s;
      state.q = hal.command.value;
      return;
    }
    state.tau = hal.command.value;
    for (double left_s = time_s; left_s > 0.0; left_s -= 1e-3) {
      const double dt_s = std::min(left_s, 1e-3);
      state.dq += dt_s * state.tau;
      state.q += dt_s * state.dq;
    }
  }
};

class Run {
 public:
  Run(std::uint64_t seed, bool efforts)
      : random_{seed},
        bench_(fresh_bench(efforts ? kEfforts : kPositions)),
        plant_{bench_.hal, efforts},
        efforts_(efforts) {}

  void go() {
    ASSERT_OK(bench_.executive.add(row_.row()));
    ASSERT_OK(bench_.start());
    now_ns_ = bench_.now_ns + ExecutiveBench::kPeriod_ns;
    forget();
    assert_true(bench_.send_line());
    const double often = random_.uniform(0.0, 0.3);
    for (int i = 0; i < kCycles; ++i) {
      inject(random_.uniform(0.0, 1.0) < often);
      cycle();
      if (random_.below(20) == 0) rearm();
    }
  }
  int rungs_seen() const { return seen_; }

 private:
  /// Injects a delay of 0.1 to 20 periods at one stage, and sometimes a fault.
  void inject(bool delayed) {
    bench_.hal.read_ns = bench_.hal.write_ns = row_.takes_ns = 0;
    row_.status = Status::kOk;
    if (!delayed) return;
    const auto delay_ns = static_cast<std::uint64_t>(
        kPeriod_ns * random_.uniform(0.1, random_.below(8) ? 2.0 : 20.0));
    const int stage = random_.below(3);
    (stage == 0 ? bench_.hal.read_ns : stage == 1 ? bench_.hal.write_ns : row_.takes_ns) = delay_ns;
    if (random_.below(40) == 0) row_.status = Status::kWorkspace;
    if (random_.below(40) == 0) bench_.hal.state.tau[3] = std::nan("");
  }

  void cycle() {
    const std::uint64_t begin_ns = g_stopwatch_ns;
    const int writes = bench_.hal.writes;
    const Status status = bench_.executive.cycle({now_ns_});
    const auto took = static_cast<double>(g_stopwatch_ns - begin_ns) / kPeriod_ns;
    const auto periods = static_cast<std::int64_t>(took) + 1;  // the next point of the grid
    now_ns_ += periods * ExecutiveBench::kPeriod_ns;
    assert_true((status == Status::kOk) == !refuses(bench_.executive.rung()));
    assert_true(bench_.hal.writes - writes <= 1);
    check_command(bench_.hal.writes > writes);
    check_reference();
    check_log();
    plant_.pass(static_cast<double>(periods) * kPeriod_s);
    if (!bench_.hal.state.tau.allFinite()) bench_.hal.state.tau.setZero();
    check_plant();
    seen_ |= 1 << static_cast<int>(bench_.executive.rung());
  }

  /// Checks the command against the limits of the robot's table.
  void check_command(bool written) {
    if (!written) return;
    const JointVector step = bench_.hal.command.value - sent_;
    for (int i = 0; i < kDof; ++i) {
      if (efforts_) {
        assert_true(std::abs(step[i]) <= limits_.dtau_max[i] * kPeriod_s + 1e-9);
        assert_true(std::abs(bench_.hal.command.value[i]) <= limits_.tau_max[i]);
      } else {
        const double change = limits_.ddq_max[i] * kPeriod_s * kPeriod_s;
        assert_true(std::abs(step[i]) <= limits_.dq_max[i] * kPeriod_s + 1e-10);
        assert_true(std::abs(step[i] - step_[i]) <= change + 1e-12);
      }
    }
    step_ = step;
    sent_ = bench_.hal.command.value;
  }
  /// Missed motion is never caught up. In a cycle the reference moves no farther than the line
  /// does, or, on its way to a line that is already moving, no farther than its largest step so far
  /// plus the step that a period's acceleration adds. From rest that exceeds the line's speed by at
  /// most its 1 / sqrt(2), and slightly more where jerk is the limit.
  void check_reference() {
    const double reference = bench_.reference(), step = std::abs(reference - reference_);
    const double gained = limits_.ddq_max[0] * kPeriod_s * kPeriod_s * 1.0025;
    if (moving_) {
      assert_true(step <= std::max(1.0001 * kSpeed * kPeriod_s, fastest_ + gained));
      assert_true(step <= 1.8 * kSpeed * kPeriod_s);
      fastest_ = std::max(fastest_, step);
    }
    reference_ = reference;
    moving_ = true;
  }
  void check_plant() const {
    for (int i = 0; i < kDof; ++i) {
      assert_true(bench_.hal.state.q[i] > limits_.q_min[i]);
      assert_true(bench_.hal.state.q[i] < limits_.q_max[i]);
      assert_true(std::abs(bench_.hal.state.dq[i]) < limits_.dq_max[i]);
    }
  }
  /// Every event begins on the rung where the previous one ended, and is a cell of the table.
  void check_log() {
    Event event;
    for (; read_ < bench_.executive.events().count(); ++read_) {
      assert_true(bench_.executive.events().read(read_, event));
      assert_true(event.from == explained_);
      const CommandMode mode = efforts_ ? CommandMode::kEffort : CommandMode::kPosition;
      assert_true(event.to == next(event.from, event.cause, mode));
      assert_true((event.status == Status::kOk) ==
                  (event.cause == Cause::kClean || event.cause == Cause::kRearm));
      explained_ = event.to;
      seen_ |= 1 << static_cast<int>(event.to);
    }
    assert_true(explained_ == bench_.executive.rung());
  }

  void rearm() {
    const bool disabled = bench_.executive.rung() == Rung::kDisabled;
    const bool up = refuses(bench_.executive.rung());
    bench_.hal.read_ns = bench_.hal.write_ns = 0;
    now_ns_ -= ExecutiveBench::kPeriod_ns;  // the next cycle has not begun
    const Status status = armed(bench_.executive, ExecutiveBench::kPeriod_ns, now_ns_);
    now_ns_ += ExecutiveBench::kPeriod_ns;
    if (status != Status::kOk || !up) return;
    check_log();
    if (disabled) {  // the drives start where the arm is
      bench_.hal.stops = 0;
      forget();
    }
    moving_ = false;
    fastest_ = 0.0;
    assert_true(bench_.executive.rung() == Rung::kNominal);
    static_cast<void>(bench_.hal.diary());
    Report report;
    while (bench_.client.poll(report)) {
    }
    static_cast<void>(bench_.send_line());  // may have no store before the next report
  }
  /// The drives take over the present motion of the arm.
  void forget() {
    moving_ = false;
    fastest_ = 0.0;
    step_.setZero();
    sent_ = efforts_ ? bench_.hal.state.tau : bench_.hal.state.q;
  }

  Random random_;
  ExecutiveBench& bench_;
  Plant plant_;
  RowProbe row_{&bench_.hal, '1'};
  bool efforts_;
  const JointLimits limits_;
  std::int64_t now_ns_ = 0;
  JointVector sent_ = JointVector::Zero(), step_ = JointVector::Zero();
  double reference_ = 0.0, fastest_ = 0.0;  // of one motion; its largest step in a period
  bool moving_ = false;
  Rung explained_ = Rung::kDisabled;
  std::uint32_t read_ = 0;
  int seen_ = 0;
};

// Proves LAD-7, LAD-8, EXE-3.

void thousand_runs_with_random_delays_keep_limits_never_burst_and_are_explained(void**) {
  std::array<int, kRungs> seen{};
  for (int i = 0; i < kRuns; ++i) {
    const std::uint64_t seed = kSeed + static_cast<std::uint64_t>(i) * 7919;
    Run run(seed, i % 2 == 1);
    run.go();
    for (std::size_t r = 0; r < kRungs; ++r) seen[r] += run.rungs_seen() >> r & 1;
  }
  print_message("seed %llu, runs on each rung:", static_cast<unsigned long long>(kSeed));
  for (const int runs : seen) print_message(" %d", runs);
  print_message("\n");
  for (const int runs : seen) assert_true(runs > kRuns / 10);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(thousand_runs_with_random_delays_keep_limits_never_burst_and_are_explained),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
