// Faults that tests inject into emulated drives, one by one, and their repeatability.
#include "sim_plant/drives/server/fault_text.hpp"
#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

/// Node 2 has the fault; all drives are operational with the brakes open.
DrivesBench& with_fault(const char* text) {
  DriveArmSettings settings = one_bus();
  settings.gravity_by_drive = true;
  settings.brake_release_s = 0.01;
  DrivesBench& bench = fresh(settings);
  bench.configure(10);
  bench.enable();
  bench.cycles(97);
  Fault fault;
  assert_null(parse_fault(text, fault));
  assert_true(bench.arm.add(fault));
  return bench;
}
std::int64_t tpdos(DrivesBench& bench, int cycles) {
  const std::int64_t before = bench.feedback[1].count;
  bench.cycles(cycles);
  return bench.feedback[1].count - before;
}

// Proves DRV-6.
void feedback_is_dropped_duplicated_delayed_or_cut(void**) {
  assert_int_equal(tpdos(with_fault("node=2 kind=drop_tpdo at=103 until=106"), 10), 7);
  assert_int_equal(tpdos(with_fault("node=2 kind=duplicate_tpdo at=103 until=106"), 10), 13);
  DrivesBench& bench = with_fault("node=2 kind=delay_tpdo at=103 until=104");
  assert_int_equal(tpdos(bench, 2), 2);
  assert_int_equal(tpdos(bench, 1), 0);
  assert_int_equal(tpdos(bench, 1), 2);
  DrivesBench& cut = with_fault("node=2 kind=truncate_tpdo");
  cut.send(0x080, {});
  assert_true(cut.take(0x182));
  assert_int_equal(cut.frame.size, 7);
}

void a_fault_concerns_its_node_only(void**) {
  DrivesBench& bench = with_fault("node=2 kind=drop_tpdo");
  const std::int64_t before = bench.feedback[2].count;
  assert_int_equal(tpdos(bench, 10), 0);
  assert_int_equal(bench.feedback[2].count - before, 10);
}

void the_heartbeat_stops(void**) {
  DrivesBench& bench = with_fault("node=2 kind=stop_heartbeat at=110");
  bench.put(2, 0x1017, 0, 5, 2);
  bench.cycles(5);
  bench.run_ms(30);
  assert_true(bench.take(0x702));
  bench.cycles(10);
  bench.run_ms(30);
  bench.expect_nothing(0x702);
}

void a_drive_faults_with_the_code_that_is_asked_for(void**) {
  DrivesBench& bench = with_fault("node=2 kind=emergency value=0x3210 at=101");
  bench.send(0x080, {});
  bench.expect(0x082, {0x10, 0x32, 0x05, 0, 0, 0, 0, 0});
  bench.cycles(100);
  assert_int_equal(bench.feedback[1].status & 0x4F, 0x08);
  assert_int_equal(bench.get(2, 0x603F, 0), 0x3210);
}

void a_drive_drops_into_switch_on_disabled(void**) {
  DrivesBench& bench = with_fault("node=2 kind=switch_on_disabled at=101");
  bench.cycle();
  assert_int_equal(bench.feedback[1].status, 0x0250);
  assert_int_equal(bench.feedback[0].status, 0x1237);
}

void a_brake_that_sticks_blocks_the_motor(void**) {
  DrivesBench& bench = with_fault("node=2 kind=brake_stuck");
  bench.controlword[1] = 0x0006;
  bench.cycle();
  bench.controlword[1] = 0x000F;
  bench.cycles(500);
  assert_int_equal(bench.feedback[1].status, 0x0237);
  bench.cycles(5);
  assert_int_equal(bench.feedback[1].status & 0x4F, 0x08);
  assert_int_equal(bench.get(2, 0x603F, 0), 0x7121);
}

void objects_read_what_the_fault_says(void**) {
  struct Row {
    const char* text;
    unsigned index, sub, value;
  };
  for (const Row& row : {Row{"node=2 kind=wrong_mode value=9", 0x6061, 0, 9},
                         Row{"node=2 kind=wrong_identity value=7", 0x1018, 2, 7},
                         Row{"node=2 kind=wrong_mapping value=0x60400010", 0x1A00, 1, 0x60400010},
                         Row{"node=2 kind=nonsense_status value=0x6C", 0x6041, 0, 0x127F},
                         Row{"node=2 kind=warning", 0x6041, 0, 0x12B7},
                         Row{"node=2 kind=warning value=0x4210", 0x603F, 0, 0x4210},
                         Row{"node=2 kind=saturated_torque", 0x6077, 0, 32767}}) {
    DrivesBench& bench = with_fault(row.text);
    assert_int_equal(bench.get(2, row.index, row.sub), row.value);
    assert_int_not_equal(bench.get(1, row.index, row.sub), row.value);
  }
  DrivesBench& bench = with_fault("node=2 kind=saturated_torque");
  bench.cycle();
  assert_int_equal(bench.feedback[1].torque, 32767);
}

void sdo_is_refused_or_silent_at_an_index(void**) {
  DrivesBench& bench = with_fault("node=2 kind=sdo_abort value=0x6076");
  assert_int_equal(bench.read(2, 0x6076, 0), 0x08000000);
  assert_int_equal(bench.read(2, 0x6075, 0), 0);
  DrivesBench& silent = with_fault("node=2 kind=sdo_silence value=0x6076");
  assert_int_equal(silent.read(2, 0x6076, 0), 0xFFFFFFFF);
  assert_int_equal(silent.read(2, 0x6075, 0), 0);
}

void a_drive_reboots(void**) {
  DrivesBench& bench = with_fault("node=2 kind=reboot at=101");
  bench.send(0x080, {});
  bench.run_ms(15);
  bench.expect(0x702, {0x00});
  assert_int_equal(bench.get(2, 0x6041, 0), 0x0250);
  assert_int_equal(tpdos(bench, 10), 0);
}

void the_same_seed_gives_the_same_bytes(void**) {
  std::uint64_t sums[3] = {};
  for (int run = 0; run < 3; ++run) {
    DriveArmSettings settings = one_bus();
    settings.seed = run < 2 ? 5 : 6;
    DrivesBench& bench = fresh(settings);
    Fault fault;
    assert_null(parse_fault("kind=drop_tpdo p=0.1", fault));
    assert_true(bench.arm.add(fault));
    bench.configure(10);
    bench.enable();
    for (int k = 0; k < 300; ++k) {
      bench.torque.fill(static_cast<std::int16_t>(10 * k));
      bench.cycle();
    }
    sums[run] = bench.checksum;
  }
  assert_true(sums[0] == sums[1]);
  assert_true(sums[0] != sums[2]);
}

void a_text_that_is_no_fault_is_refused_with_a_reason(void**) {
  Fault fault;
  for (const char* text :
       {"", "node=2", "node=128 kind=reboot", "kind=nothing", "kind", "kind=", "kind=reboot at=-1",
        "kind=reboot at=1.5", "kind=reboot p=0", "kind=reboot p=nan", "kind=reboot p=1.1",
        "kind=reboot value=4294967296", "kind=reboot when=3", "kind=reboot node=2x"})
    assert_non_null(parse_fault(text, fault));
  fault = {};
  assert_null(parse_fault("  kind=emergency  node=7 value=0x2310 at=1000 until=1010 p=0.5", fault));
  assert_int_equal(fault.node, 7);
  assert_int_equal(fault.value, 0x2310);
  assert_int_equal(fault.at, 1000);
  assert_int_equal(fault.until, 1010);
  ASSERT_NEAR(fault.probability, 0.5, 0.0);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(feedback_is_dropped_duplicated_delayed_or_cut),
      cmocka_unit_test(a_fault_concerns_its_node_only),
      cmocka_unit_test(the_heartbeat_stops),
      cmocka_unit_test(a_drive_faults_with_the_code_that_is_asked_for),
      cmocka_unit_test(a_drive_drops_into_switch_on_disabled),
      cmocka_unit_test(a_brake_that_sticks_blocks_the_motor),
      cmocka_unit_test(objects_read_what_the_fault_says),
      cmocka_unit_test(sdo_is_refused_or_silent_at_an_index),
      cmocka_unit_test(a_drive_reboots),
      cmocka_unit_test(the_same_seed_gives_the_same_bytes),
      cmocka_unit_test(a_text_that_is_no_fault_is_refused_with_a_reason),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
