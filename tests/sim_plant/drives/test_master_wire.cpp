// Faults of the buses themselves: others that send, cycles that are late, stops that are lost,
// statuswords that no drive may show, and a bus that goes down.
#include "tests/sim_plant/drives/fault_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus::can {
namespace {

constexpr Buses kLayouts[] = {Buses::kFdPacked, Buses::kClassicPlain, Buses::kClassicPacked};

MasterBench& following(Buses buses = Buses::kFdPacked) {
  MasterBench& bench = fresh_bench(buses);
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(50));
  return bench;
}

/// The drives are off within `most` cycles, stay off, and only a new start leads back.
void assert_needs_start(MasterBench& bench, Status reason, int most) {
  SafetyWatch watch(bench);
  for (int i = 0; i < 300; ++i) ASSERT_STATUS(watch.cycle(), reason);
  assert_in_range(watch.longest_off(), 0, most);
  assert_false(powered(bench));
  heal(bench);
  ASSERT_STATUS(bench.arm(), reason);
  for (int i = 0; i < 20; ++i) (void)watch.cycle();
  ASSERT_STATUS(bench.arm(), reason);
  const JointVector before = bench.hal.arm.arm().q();
  ASSERT_OK(bench.start());
  for (int i = 0; i < 200; ++i) ASSERT_OK(watch.cycle());
  assert_true((bench.hal.arm.arm().q() - before).cwiseAbs().maxCoeff() < 1e-3);
}

// Proves CAN-11.
void somebody_else_who_commands_the_drives_is_a_conflict(void**) {
  for (const Buses buses : kLayouts) {
    const CanFrame frames[] = {
        foreign(0x080, {}),                     // SYNC
        foreign(0x000, {0x01, 0x00}),           // NMT start
        foreign(0x201, {0x0F, 0x00, 0x10, 0}),  // commands
        foreign(0x77F, {0x05}),                 // our heartbeat
    };
    for (const CanFrame& frame : frames) {
      MasterBench& bench = following(buses);
      bench.hal.strange = {frame};
      ASSERT_STATUS(bench.cycle(), Status::kBusConflict);
      assert_false(enables(bench));
      assert_false(pushes(bench));
      assert_needs_start(bench, Status::kBusConflict, 3);
    }
  }
}

/// It hears no quick stop; heartbeats tell of it, at the latest after 50 ms, and NMT stop reaches
/// it.
void a_drive_that_is_taken_to_pre_operational_is_stopped(void**) {
  int longest = 0;
  for (const Buses buses : kLayouts) {
    for (int at = 0; at < 50; at += 7) {
      MasterBench& bench = following(buses);
      ASSERT_OK(bench.cycles(at));
      bench.hal.strange = {foreign(0x000, {0x80, at % 2 == 0 ? 0x00 : 1 + at / 8})};
      ASSERT_STATUS(bench.cycle(), Status::kBusConflict);
      SafetyWatch watch(bench);
      for (int i = 0; i < 300; ++i) ASSERT_STATUS(watch.cycle(), Status::kBusConflict);
      assert_false(powered(bench));
      longest = std::max(longest, watch.longest_off());
    }
  }
  print_message("without power after %d cycles\n", longest);
  assert_in_range(longest, 1, 120);
}

void feedback_of_a_second_node_with_the_number_of_a_drive_is_a_conflict(void**) {
  MasterBench& bench = following();
  CanFrame frame = foreign(0x183, {0x37, 0x12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  frame.fd = true;
  bench.hal.strange = {frame, frame};
  ASSERT_STATUS(bench.cycle(), Status::kBusConflict);
  assert_needs_start(bench, Status::kBusConflict, 3);
}

void a_flood_of_frames_that_concern_nobody_changes_nothing(void**) {
  MasterBench& bench = following();
  const JointVector before = bench.hal.arm.arm().q();
  for (int i = 0; i < 100; ++i) {
    for (int id = 1; id < 0x800; ++id) {
      const int base = id & ~0x7F, node = id & 0x7F;
      const bool ours = id == 0x080 || id == 0x201 || id == 0x77F || (node >= 1 && node <= 7);
      if (!ours || base == 0x280)
        bench.hal.strange.push_back(foreign(id, {1, 2, 3, 4, 5, 6, 7, 8}));
    }
    ASSERT_OK(bench.cycle());
  }
  assert_true((bench.hal.arm.arm().q() - before).cwiseAbs().maxCoeff() < 1e-3);
}

// A drive of its kind sends 12 bytes; the others are of somebody else, or of a lost mapping.
void feedback_of_every_other_length_is_none(void**) {
  MasterBench& bench = following();
  for (std::uint8_t size = 0; size <= 64; ++size) {
    CanFrame frame = foreign(0x183, {0x08, 0x00});
    frame.size = size;
    frame.fd = size != 12;
    bench.hal.strange = {frame};
    ASSERT_OK(bench.cycle());
  }
}

void a_statusword_that_is_none_of_the_standard_stops_all_drives(void**) {
  MasterBench& bench = following();
  SafetyWatch watch(bench);
  int patterns = 0;
  for (int bits = 0; bits < 128; ++bits) {
    const auto word = static_cast<std::uint16_t>(0x1200 | bits);
    if (cia402::is_standard(word)) continue;
    ++patterns;
    disturb(bench, Wire::kRewords, false, 0x183, 1);
    bench.hal.disturbance.word = word;
    ASSERT_STATUS(watch.cycle(), Status::kDriveFault);
    assert_false(enables(bench) || pushes(bench));
    for (int i = 0; i < 10; ++i) (void)watch.cycle();
    assert_false(powered(bench));
    heal(bench);
    ASSERT_OK(bench.arm());
    ASSERT_OK(bench.cycle());
  }
  assert_int_equal(patterns, 104);
}

void a_drive_whose_statuswords_stay_nonsense_is_not_armed(void**) {
  for (const int bits : {0x01, 0x06, 0x2F, 0x67, 0x7F, 0x61}) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.executive.start());
    bench.now_ns = -bench.hal.period_ns;
    disturb(bench, Wire::kRewords, false, 0x183, 1 << 30);
    bench.hal.disturbance.word = static_cast<std::uint16_t>(bits);
    ASSERT_STATUS(bench.arm(), Status::kDriveFault);
    assert_false(powered(bench));
    heal(bench);
    (void)bench.settle();
    ASSERT_OK(bench.arm());
  }
}

// The controlwords of the stop, and of the next two cycles, do not arrive. Where torques have a
// frame of their own the arm is without torque until then, and the drive's ramp takes the longer.
void a_stop_whose_first_frames_are_lost_arrives_with_the_next(void**) {
  for (const Buses buses : kLayouts)
    for (const int joint : {0, 6}) {
      MasterBench& bench = following(buses);
      SafetyWatch watch(bench);
      inject(bench, joint, drives::FaultKind::kSwitchOnDisabled);
      (void)watch.cycle();
      disturb(bench, Wire::kLoses, true, command_id(bench, joint, true), 3);
      for (int i = 0; i < 4; ++i) (void)watch.cycle();
      for (int j = 0; j < kDof; ++j)
        assert_true(bench.hal.arm.node(j).axis().state() != cia402::State::kOperationEnabled);
      for (int i = 0; i < 250; ++i) (void)watch.cycle();
      assert_false(powered(bench));
      heal(bench);
      ASSERT_OK(bench.arm());
    }
}

// Cycles whose begin is late by up to half a period, so that up to 1.5 lie between two SYNCs.
void late_cycles_are_no_reason_to_stop(void**) {
  for (const Buses buses : kLayouts) {
    MasterBench& bench = following(buses);
    SafetyWatch watch(bench);
    const JointVector before = bench.hal.arm.arm().q();
    const std::int64_t base_ns = bench.now_ns, period_ns = bench.hal.period_ns;
    Random random{7};
    for (int i = 1; i <= 3000; ++i) {
      const auto late_ns = static_cast<std::int64_t>(random.uniform(0.0, 0.49e6));
      bench.now_ns = base_ns + (i - 1) * period_ns + (i % 2 == 0 ? late_ns : 0);
      ASSERT_OK(watch.cycle());
    }
    assert_true((bench.hal.arm.arm().q() - before).cwiseAbs().maxCoeff() < 1e-3);
  }
}

void a_bus_that_goes_down_and_up_again_needs_a_new_connection(void**) {
  for (const Buses buses : kLayouts)
    for (const int cycles : {1, 5, 50}) {
      MasterBench& bench = following(buses);
      SafetyWatch watch(bench);
      bench.hal.down = true;
      for (int i = 0; i < cycles; ++i) {
        ASSERT_STATUS(watch.cycle(), Status::kConnectionLost);
        assert_false(enables(bench) || pushes(bench));
      }
      bench.hal.down = false;
      assert_needs_start(bench, Status::kConnectionLost, 14);
    }
}

void drives_hear_our_heartbeat_after_a_fault_of_the_wire(void**) {
  MasterBench& bench = following();
  bench.hal.logs = true;
  bench.hal.strange = {foreign(0x080, {})};
  for (int i = 0; i < 500; ++i) (void)bench.cycle();
  int ours = 0;
  for (const CanFrame& frame : bench.hal.log) {
    ours += frame.id == 0x77F;
    assert_false(frame.id > 0x080 && frame.id < 0x088 && load<std::uint16_t>(frame.data, 0) != 0);
  }
  assert_in_range(ours, 9, 11);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(somebody_else_who_commands_the_drives_is_a_conflict),
      cmocka_unit_test(a_drive_that_is_taken_to_pre_operational_is_stopped),
      cmocka_unit_test(feedback_of_a_second_node_with_the_number_of_a_drive_is_a_conflict),
      cmocka_unit_test(a_flood_of_frames_that_concern_nobody_changes_nothing),
      cmocka_unit_test(feedback_of_every_other_length_is_none),
      cmocka_unit_test(a_statusword_that_is_none_of_the_standard_stops_all_drives),
      cmocka_unit_test(a_drive_whose_statuswords_stay_nonsense_is_not_armed),
      cmocka_unit_test(a_stop_whose_first_frames_are_lost_arrives_with_the_next),
      cmocka_unit_test(late_cycles_are_no_reason_to_stop),
      cmocka_unit_test(a_bus_that_goes_down_and_up_again_needs_a_new_connection),
      cmocka_unit_test(drives_hear_our_heartbeat_after_a_fault_of_the_wire),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
