// Faults while connecting: the start-up is refused with the node and the object, never wrongly
// accepted, and the next start() succeeds once the cause has gone.
#include <string_view>

#include "hal/can/node_setup.hpp"
#include "hal/cia402/hex.hpp"
#include "tests/sim_plant/drives/fault_bench.hpp"

namespace tactus::can {
namespace {

using drives::FaultKind;
constexpr int kJoints[] = {0, 3, 6};
constexpr std::uint32_t kNoObject = 0x06020000, kGeneralError = 0x08000000;

bool says(const MasterBench& bench, const char* part) {
  const Message message = bench.hal.master.trouble();
  const std::string_view text = message;
  if (text.find(part) != std::string_view::npos) return true;
  print_error("'%s' is not in: %s\n", part, message.c_str());
  return false;
}

/// What is written and read at the start-up of a drive.
NodeSetup steps_of(const MasterBench& bench, int joint) {
  const PdoLayout layout(CommandMode::kEffort, bench.can.frames, bench.can.commands);
  Slot slot;
  slot.index = joint;
  slot.count = kDof;
  slot.node = static_cast<std::uint8_t>(joint + 1);
  NodeSetup setup;
  setup.begin(bench.can, layout, slot, CommandMode::kEffort, 1000);
  return setup;
}

/// test_master_lines.cpp tests them.
bool needs_lines(const SetupStep& step) {
  return step.kind == SetupStep::Kind::kLines || step.kind == SetupStep::Kind::kStore;
}

void refuse_object(MasterBench& bench, int joint, FaultKind kind, std::uint32_t index,
                   std::uint32_t abort) {
  drives::Fault fault;
  fault.kind = kind;
  fault.value = index;
  fault.abort = abort;
  assert_true(bench.hal.arm.node(joint).faults().add(fault));
}

void assert_refused(MasterBench& bench, int joint, Status expected) {
  ASSERT_STATUS(bench.executive.start(), expected);
  const Text<15> node = Text<15>("(node ") << joint + 1 << ")";
  assert_true(says(bench, node.c_str()));
  for (const CanFrame& frame : bench.hal.log)
    if (frame.id == 0x201) assert_int_equal(load<std::uint16_t>(frame.data, 0) & 0x0008, 0);
  assert_false(powered(bench));
  heal(bench);
}

/// A fault at any step of any drive refuses the start and names the object; then the arm starts.
void assert_every_step_refuses(FaultKind kind, std::uint32_t code, Status expected) {
  MasterBench& bench = fresh_bench();
  bench.hal.logs = true;
  ASSERT_OK(bench.load());
  for (const int joint : kJoints) {
    const NodeSetup setup = steps_of(bench, joint);
    std::uint32_t last = 0;
    for (int i = 0; i < setup.count(); ++i) {
      const std::uint32_t index = setup.step(i).index;
      if (index == last || needs_lines(setup.step(i))) continue;
      last = index;
      bench.hal.log.clear();
      refuse_object(bench, joint, kind, index, code);
      assert_refused(bench, joint, expected);
      assert_true(says(bench, cia402::hex(index).c_str()));
    }
  }
  ASSERT_OK(bench.start());
}

// Proves CAN-9.
void an_abort_of_any_step_refuses_the_start_and_names_the_object(void**) {
  assert_every_step_refuses(FaultKind::kSdoAbort, kGeneralError, Status::kRefusedByRobot);
}

void the_serial_numbers_of_a_bus_are_told_until_the_file_has_them(void**) {
  cia402::assert_serials_are_told_until_stated([]() -> MasterBench& { return fresh_bench(); });
}

int downloads(const std::vector<CanFrame>& log) {
  int count = 0;
  for (const CanFrame& frame : log)
    count += frame.id > 0x600 && frame.id <= 0x67F && (frame.data[0] & 0xE0) == 0x20;
  return count;
}

/// Wrong drives are found, whatever is wrong, before a byte is written to any drive of any bus.
void no_drive_is_written_to_before_all_have_said_who_they_are(void**) {
  for (const Buses buses : {Buses::kFdPacked, Buses::kClassicPlain})
    for (const int joint : kJoints)
      for (const bool serial : {true, false}) {
        MasterBench& bench = fresh_bench(buses);
        bench.hal.logs = true;
        bench.can.product = 402;
        bench.drive.serial << 1001, 1002, 1003, 1004, 1005, 1006, 1007;
        if (serial) bench.drive.serial[joint] = 1008;
        ASSERT_OK(bench.load());
        if (!serial) inject(bench, joint, FaultKind::kWrongIdentity, 403);
        assert_refused(bench, joint, Status::kRefusedByRobot);
        assert_true(says(bench, serial ? "[cia402] serial is 1008" : "product (1018h:2) is 403"));
        assert_int_equal(downloads(bench.hal.log), 0);
        bench.drive.serial[joint] = 1001 + joint;
        ASSERT_OK(bench.start());
        assert_true(downloads(bench.hal.log) > 7 * 20);
      }
}

void a_drive_that_answers_no_request_is_a_time_out(void**) {
  assert_every_step_refuses(FaultKind::kSdoSilence, 0, Status::kBusTimeout);
}

// Those that only add a time-out or a reaction: what a drive does without them is its own. Those of
// scaling: what it does not say is compared with nothing.
void objects_that_a_drive_need_not_have_may_be_absent(void**) {
  const std::vector<std::uint32_t> kOptional[] = {{0x1016, 0x6007, 0x605A, 0x605E, 0x1005, 0x1006,
                                                   0x60C2, 0x1401, 0x1402, 0x1403, 0x1801, 0x1802},
                                                  {0x6072, 0x6076, 0x608F, 0x6091, 0x60A8, 0x603F}};
  for (const std::vector<std::uint32_t>& optional : kOptional) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    for (const std::uint32_t index : optional)
      refuse_object(bench, 2, FaultKind::kSdoAbort, index, kNoObject);
    ASSERT_OK(bench.start());
    ASSERT_OK(bench.cycles(100));
  }
}

// CiA 302-2: operational after boot-up, where a drive takes no mapping.
void drives_that_start_by_themselves_are_set_up(void**) {
  for (const Buses buses : {Buses::kFdPlain, Buses::kClassicPlain}) {
    MasterBench& bench = fresh_bench(buses);
    bench.plant.start = true;
    ASSERT_OK(bench.load());
    const Status status = bench.start();
    if (status != Status::kOk) print_error("%s\n", bench.hal.master.trouble().c_str());
    ASSERT_OK(status);
    ASSERT_OK(bench.cycles(100));
  }
}

void objects_that_a_drive_must_have_may_not_be_absent(void**) {
  constexpr std::uint32_t kNeeded[] = {0x1000, 0x6502, 0x60A9, 0x1017, 0x1400,
                                       0x1600, 0x1800, 0x1A00, 0x6060, 0x6061};
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  for (const std::uint32_t index : kNeeded) {
    refuse_object(bench, 2, FaultKind::kSdoAbort, index, kNoObject);
    assert_refused(bench, 2, Status::kRefusedByRobot);
  }
}

struct Lie {
  FaultKind kind;
  std::uint32_t value;
  const char* says;
};

void a_drive_that_is_not_the_one_of_the_settings_is_refused(void**) {
  constexpr Lie kLies[] = {{FaultKind::kWrongIdentity, 403, "product (1018h:2) is 403"},
                           {FaultKind::kWrongMapping, 0x60770010, "mapped object"},
                           {FaultKind::kWrongMode, 8, "6061h:0) is 8"}};
  for (const Lie& lie : kLies)
    for (const int joint : kJoints) {
      MasterBench& bench = fresh_bench();
      bench.can.product = 402;
      ASSERT_OK(bench.load());
      inject(bench, joint, lie.kind, lie.value);
      assert_refused(bench, joint, Status::kRefusedByRobot);
      assert_true(says(bench, lie.says));
      ASSERT_OK(bench.start());
    }
}

// Another number of the rated torque would be a torque that is wrong by its factor.
void a_scaling_that_differs_from_the_settings_is_refused(void**) {
  MasterBench& bench = fresh_bench();
  bench.drive.rated_torque[4] = 0.501;
  ASSERT_OK(bench.load());
  assert_refused(bench, 4, Status::kRefusedByRobot);
  assert_true(says(bench, "rated torque in mN m (6076h:0) is 500, expected 501"));
}

void a_torque_limit_of_the_drives_below_the_joints_is_refused(void**) {
  for (const double share : {0.5, 0.0}) {
    MasterBench& bench = fresh_bench();
    bench.plant.torque_share = share;
    ASSERT_OK(bench.load());
    assert_refused(bench, 0, Status::kRefusedByRobot);
    assert_true(says(bench, share > 0.0 ? "6072h:0) is 14500 permille of the rated torque, 43.5 N m"
                                        : "6072h:0) is 0 permille of the rated torque, 0 N m"));
  }
  MasterBench& bench = fresh_bench();
  bench.plant.torque_share = 0.5;
  bench.drive.torque_limit = 0.5 * JointLimits{}.tau_max;
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
}

void a_drive_that_is_missing_or_sends_no_feedback_is_a_time_out(void**) {
  for (const int joint : kJoints) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    const int ids[] = {0x701 + joint, 0x181 + joint};
    const char* const kSays[] = {"no boot-up message", "no steady feedback"};
    for (std::size_t i = 0; i < 2; ++i) {
      disturb(bench, Wire::kLoses, false, ids[i], 1 << 30);
      assert_refused(bench, joint, Status::kBusTimeout);
      assert_true(says(bench, kSays[i]));
    }
    inject(bench, joint, FaultKind::kStopHeartbeat);
    assert_refused(bench, joint, Status::kBusTimeout);
    assert_true(says(bench, "no heartbeat"));
    ASSERT_OK(bench.start());
  }
}

void a_bus_on_which_nobody_is_heard_is_named_with_its_remedy(void**) {
  MasterBench& bench = fresh_bench();
  bench.can.interfaces = Value("vcan0 vcan1");
  bench.can.bus[6] = 2;
  ASSERT_OK(bench.load());
  disturb(bench, Wire::kLoses, false, 0x707, 1 << 30);
  assert_refused(bench, 6, Status::kBusTimeout);
  assert_true(says(bench, "bus vcan1: no drive is heard: joint 7 (node 7): no boot-up message"));
  assert_true(says(bench, "cabling, termination, bit rate and [can] interfaces"));
  disturb(bench, Wire::kLoses, false, 0x703, 1 << 30);
  assert_refused(bench, 2, Status::kBusTimeout);
  assert_true(says(bench, "bus vcan0: joint 3 (node 3): no boot-up message"));
}

// A drive that restarts has lost what was written to it.
void a_drive_that_restarts_between_connecting_and_arming_is_not_armed(void**) {
  for (const int joint : kJoints) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.executive.start());
    bench.now_ns = -bench.hal.period_ns;
    inject(bench, joint, FaultKind::kReboot);
    (void)bench.cycles(1);
    for (int i = 0; i < 50; ++i) (void)bench.cycle();
    ASSERT_STATUS(bench.arm(), Status::kConnectionLost);
    assert_true(says(bench, "connect again"));
    ASSERT_OK(bench.start());
  }
}

void a_bus_that_is_down_is_refused_until_it_is_up(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  bench.hal.down = true;
  ASSERT_STATUS(bench.executive.start(), Status::kConnectionLost);
  heal(bench);
  ASSERT_OK(bench.start());
}

/// Numbers are those of a bus: another may have them too.
void drives_of_two_buses_may_have_the_same_numbers(void**) {
  MasterBench* bench = new MasterBench;
  bench->can.interfaces = Value("vcan0 vcan1");
  bench->can.bus << 1, 1, 1, 1, 2, 2, 2;
  bench->can.node << 1, 2, 3, 4, 1, 2, 3;
  ASSERT_OK(bench->load());
  ASSERT_OK(bench->start());
  ASSERT_OK(bench->cycles(300));
  delete bench;
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_abort_of_any_step_refuses_the_start_and_names_the_object),
      cmocka_unit_test(the_serial_numbers_of_a_bus_are_told_until_the_file_has_them),
      cmocka_unit_test(no_drive_is_written_to_before_all_have_said_who_they_are),
      cmocka_unit_test(a_drive_that_answers_no_request_is_a_time_out),
      cmocka_unit_test(objects_that_a_drive_need_not_have_may_be_absent),
      cmocka_unit_test(drives_that_start_by_themselves_are_set_up),
      cmocka_unit_test(objects_that_a_drive_must_have_may_not_be_absent),
      cmocka_unit_test(a_drive_that_is_not_the_one_of_the_settings_is_refused),
      cmocka_unit_test(a_scaling_that_differs_from_the_settings_is_refused),
      cmocka_unit_test(a_torque_limit_of_the_drives_below_the_joints_is_refused),
      cmocka_unit_test(a_drive_that_is_missing_or_sends_no_feedback_is_a_time_out),
      cmocka_unit_test(a_bus_on_which_nobody_is_heard_is_named_with_its_remedy),
      cmocka_unit_test(a_drive_that_restarts_between_connecting_and_arming_is_not_armed),
      cmocka_unit_test(drives_of_two_buses_may_have_the_same_numbers),
      cmocka_unit_test(a_bus_that_is_down_is_refused_until_it_is_up),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
