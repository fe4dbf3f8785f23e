// Random faults at random times in every phase, several per run, with random requests of the
// executive; what must hold in every cycle is judged by SafetyWatch and here.
#include <cstdlib>

#include "tests/ethercat/fault_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus::ethercat {
namespace {

constexpr int kCycles = 1000;
// A quick stop of a drive ends after [cia402] stop_ms by cutting the voltage; before it, a frame
// may be missing until the drive's watchdog. A few cycles to see and to send it.
constexpr int kMostOff = 2000 + 10 + 5;
constexpr FaultKind kKinds[] = {
    FaultKind::kEmergency,      FaultKind::kSwitchOnDisabled, FaultKind::kWrongMode,
    FaultKind::kBrakeStuck,     FaultKind::kSdoAbort,         FaultKind::kSdoSilence,
    FaultKind::kNonsenseStatus, FaultKind::kSaturatedTorque,  FaultKind::kReboot};
constexpr LineFaultKind kLines[] = {LineFaultKind::kBreak, LineFaultKind::kLose,
                                    LineFaultKind::kDelay, LineFaultKind::kCounter,
                                    LineFaultKind::kFall};

std::uint64_t number(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

struct Account {
  int takeovers = 0, refused = 0, stops = 0, longest_off = 0;
  double fastest = 0.0, farthest = 0.0;
};

class RandomRun {
 public:
  RandomRun(std::uint64_t seed, Account& account)
      : random_{seed}, bench_(fresh_bench()), watch_(bench_), account_(account) {}

  void go() {
    bench_.ethercat.state_ms = 300;
    bench_.ethercat.sdo_ms = 50;
    ASSERT_OK(bench_.load());
    connect();
    for (int i = 0; i < kCycles; ++i) {
      if (random_.below(250) == 0) begin_fault();
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
    if (bench_.executive.start() != Status::kOk) ++account_.refused;
    bench_.now_ns = -bench_.hal.period_ns;
  }
  void begin_fault() {
    if (random_.below(2) == 0) {
      const LineFaultKind kind = kLines[random_.below(5)];
      segment::LineFault fault;
      fault.kind = kind;
      fault.slave = random_.below(kDof + 1);
      fault.at = bench_.hal.line.arm().periods();
      fault.until = fault.at + 1 + random_.below(20);
      fault.probability = random_.below(2) == 0 ? 1.0 : 0.2;
      fault.value = static_cast<std::uint16_t>(random_.below(65536));
      static_cast<void>(bench_.hal.line.add(fault));  // no room: no fault
      return;
    }
    drives::Fault fault;
    fault.kind = kKinds[random_.below(static_cast<int>(std::size(kKinds)))];
    fault.probability = random_.below(2) == 0 ? 1.0 : 0.1;
    if (fault.kind == FaultKind::kNonsenseStatus)
      fault.value = static_cast<std::uint32_t>(random_.below(65536));
    static_cast<void>(bench_.hal.line.slave(random_.below(kDof)).faults().add(fault));
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
      point.q =
          bench_.hal.line.arm().arm().q() + JointVector::Constant(random_.uniform(-0.02, 0.02));
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
    const JointVector error = bench_.pipeline.robot.q.value - bench_.hal.line.arm().arm().q();
    account_.farthest = std::max(account_.farthest, error.cwiseAbs().maxCoeff());
    assert_true(error.cwiseAbs().maxCoeff() < 1e-3);
  }

  Random random_;
  MasterBench& bench_;
  SafetyWatch watch_;
  Account& account_;
};

// Proves ECAT-8.
void no_fault_leads_to_a_command_that_is_not_allowed(void**) {
  const auto runs = static_cast<int>(number("TACTUS_TRIALS", 100));
  const std::uint64_t seed = number("TACTUS_SEED", 20270101);
  Account account;
  for (int i = 0; i < runs; ++i) {
    static std::uint64_t now = 0;
    now = seed + static_cast<std::uint64_t>(i);
    if (std::getenv("TACTUS_VERBOSE") != nullptr)
      print_message("seed %llu\n", static_cast<unsigned long long>(now));
    RandomRun run(now, account);
    run.go();
  }
  print_message(
      "%d runs: %d takeovers, %d stops, %d connections refused, off after %d cycles at most, "
      "fastest joint %.2f of its limit, takeover within %.1e rad\n",
      runs, account.takeovers, account.stops, account.refused, account.longest_off, account.fastest,
      account.farthest);
  assert_true(account.takeovers > runs / 2);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_fault_leads_to_a_command_that_is_not_allowed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
