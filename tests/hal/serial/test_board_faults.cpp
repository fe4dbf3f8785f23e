// Faults of a board and of its link, each in motionless and in moving arms: the drives are
// disabled, the board keeps why, and the arm can be armed again.
#include "tests/hal/serial/board_bench.hpp"

namespace tactus::pil {
namespace {

using serial::FaultCause;
using serial::Provocation;

struct Row {
  const char* name;
  Provocation provocation;
  FaultCause cause;
  std::uint32_t cfsr;  ///< bits of which one is set [DDI 0403E, B3.2.15; DDI 0553B, D1.2]
};

constexpr Row kRows[] = {
    {"an access to nowhere", Provocation::kHardFault, FaultCause::kFault, 0x8000},   // BFARVALID
    {"a division by zero", Provocation::kDivision, FaultCause::kFault, 0x02000000},  // DIVBYZERO
    {"a full stack", Provocation::kStackOverflow, FaultCause::kStack, 0x100002},  // STKOF, DACCVIOL
    {"background work that hangs", Provocation::kStuckBackground, FaultCause::kBackground, 0},
    {"a cycle that hangs", Provocation::kStuckCycle, FaultCause::kWatchdog, 0},
};

/// Lets the board run until it has answered for its fault and started again, and counts the cycles
/// in which its drives were still to follow.
void run_into_fault(BoardBench& bench, const Row& row) {
  const std::uint8_t payload[] = {static_cast<std::uint8_t>(row.provocation)};
  std::uint8_t bytes[serial::kMaxFrame];
  const std::size_t size = serial::write_frame({Kind::kProvoke, 999, payload, 1}, bytes);
  ASSERT_OK(bench.board.turn(bytes, size));
  for (int i = 0; i < 2500 && !bench.disabled(); ++i)
    if (bench.turn(Order::kArmed) == Status::kBusTimeout) break;
  print_message("  %s: disabled in cycle %u\n", row.name, bench.board.result().cycle);
  assert_true(bench.disabled());
}

void assert_recorded(BoardBench& bench, const Row& row, std::uint32_t count) {
  serial::FaultRecord fault;
  ASSERT_OK(ask_fault(bench.board, fault));
  print_message("    %s\n", fault_text(bench.board).c_str());
  assert_true(fault.cause == row.cause);
  assert_int_equal(fault.count, count);
  if (row.cfsr != 0) assert_true((fault.cfsr & row.cfsr) != 0);
  assert_true(fault.cycle > 0);
  if (row.cause != FaultCause::kStack) assert_true(fault.pc != 0);
}

// Proves BRD-1, BRD-2.
void a_fault_disables_the_drives_is_recorded_and_the_arm_can_be_armed_again(void**) {
  BoardBench& bench = fresh();
  std::uint32_t count = 0;
  for (const Row& row : kRows) {
    bench.start(Pace::kTimer);
    bench.arm(Pace::kTimer);
    run_into_fault(bench, row);
    assert_recorded(bench, row, ++count);
    ASSERT_OK(bench.board.request(Kind::kForget));
    serial::FaultRecord fault;
    ASSERT_OK(ask_fault(bench.board, fault));
    assert_true(fault.cause == FaultCause::kNone);
  }
  bench.start(Pace::kTimer);
  bench.arm(Pace::kTimer);
}

struct LinkRow {
  const char* name;
  Fate fate;
  int cycles;      ///< in which it happens
  bool tolerated;  ///< the arm goes on
};

constexpr LinkRow kLinkRows[] = {
    {"one state is lost", Fate::kIsLost, 1, true},
    {"one state is corrupted", Fate::kIsCorrupted, 1, true},
    {"states are lost for good", Fate::kIsLost, 2000, false},
    {"states are corrupted for good", Fate::kIsCorrupted, 2000, false},
};

// Proves BRD-3.
void a_plant_that_is_not_heard_stops_the_arm_and_it_can_be_armed_again(void**) {
  for (const LinkRow& row : kLinkRows) {
    BoardBench& bench = fresh();
    bench.start(Pace::kTimer);
    bench.arm(Pace::kTimer);
    Status status = Status::kOk;
    int cycles = 0;
    for (; cycles < row.cycles && !bench.disabled(); ++cycles) {
      const Status now = bench.turn(Order::kArmed, row.fate);
      if (status == Status::kOk) status = now;
    }
    bench.turns(100, Order::kArmed);
    print_message("  %s: %s after %d cycles\n", row.name, name(status), cycles);
    assert_true(bench.disabled() != row.tolerated);
    if (row.tolerated) continue;
    ASSERT_STATUS(status, Status::kStateStale);
    ASSERT_STATUS(bench.board.result().status, Status::kStateStale);  // it is latched
    bench.turns(10, Order::kDisabled);
    assert_true(bench.disabled());
    bench.arm(Pace::kTimer);
  }
}

// Proves BRD-4.
void a_halt_brakes_and_disables_and_only_a_new_order_arms(void**) {
  BoardBench& bench = fresh();
  bench.start(Pace::kTimer);
  bench.arm(Pace::kTimer);
  for (int i = 0; i < 2000 && !bench.disabled(); ++i) bench.turns(1, Order::kDisabled);
  assert_true(bench.disabled());
  for (int i = 0; i < 200; ++i) {
    bench.turns(1, Order::kDisabled);
    assert_true(bench.disabled());
  }
  bench.arm(Pace::kTimer);
}

void a_stop_disables_the_drives_at_once(void**) {
  for (const Pace pace : {Pace::kTimer, Pace::kLockStep}) {
    BoardBench& bench = fresh();
    bench.start(pace);
    bench.arm(pace);
    assert_false(bench.disabled());
    ASSERT_OK(bench.board.request(Kind::kStop));
    for (int i = 0; i < 3; ++i) ASSERT_OK(bench.board.turn(nullptr, 0));
    assert_true(bench.disabled());
    bench.start(pace);  // the same text again
    bench.arm(pace);
  }
}

void an_order_from_before_the_start_arms_nothing(void**) {
  BoardBench& bench = fresh();
  std::uint8_t bytes[2 * serial::kMaxFrame];
  RobotState old;
  old.stamp_ns = 5'000'000'000;
  std::size_t size = bench.board.put_state(Order::kArmed, old, bytes);
  const std::uint8_t stamp[8] = {0, 0, 0, 1, 42, 5, 242, 0};
  size += serial::write_frame({Kind::kTick, 0, stamp, 8}, bytes + size);
  ASSERT_OK(bench.board.turn(bytes, size));
  bench.start(Pace::kTimer);
  for (int i = 0; i < 50; ++i) {
    bench.turns(1, Order::kDisabled);
    assert_true(bench.disabled());
  }
  bench.arm(Pace::kTimer);
}

void a_state_far_ahead_of_the_cycles_is_not_taken(void**) {
  BoardBench& bench = fresh();
  bench.start(Pace::kTimer);
  bench.arm(Pace::kTimer);
  std::uint8_t bytes[serial::kMaxFrame];
  RobotState ahead = bench.state;
  ahead.stamp_ns = INT64_MAX;
  const std::size_t size = bench.board.put_state(Order::kArmed, ahead, bytes);
  ASSERT_OK(bench.board.turn(bytes, size));
  for (int i = 0; i < 50; ++i) ASSERT_OK(bench.turn(Order::kArmed));
}

}  // namespace
}  // namespace tactus::pil

int main() {
  using namespace tactus::pil;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_fault_disables_the_drives_is_recorded_and_the_arm_can_be_armed_again),
      cmocka_unit_test(a_plant_that_is_not_heard_stops_the_arm_and_it_can_be_armed_again),
      cmocka_unit_test(a_halt_brakes_and_disables_and_only_a_new_order_arms),
      cmocka_unit_test(a_stop_disables_the_drives_at_once),
      cmocka_unit_test(an_order_from_before_the_start_arms_nothing),
      cmocka_unit_test(a_state_far_ahead_of_the_cycles_is_not_taken),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
