// The state machine of an emulated drive against the table of CiA 402, typed here again.
#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

constexpr unsigned kNode = 4;  // carries much gravity

DrivesBench& in_torque_mode() {
  DrivesBench& bench = booted();
  bench.put(kNode, 0x6060, 0, 10, 1);
  return bench;
}
void control(DrivesBench& bench, unsigned word) {
  bench.put(kNode, 0x6040, 0, word, 2);
}
/// The statusword without bits 11 to 13.
unsigned status(DrivesBench& bench) {
  return bench.get(kNode, 0x6041, 0) & ~0x3800U;
}
void trip(DrivesBench& bench) {
  bench.arm.node(kNode - 1).axis().trip();
}
/// From a drive that has just booted.
void bring(DrivesBench& bench, const char* words) {
  for (const char* at = words; *at != '\0'; ++at) {
    if (*at == 'f') {
      trip(bench);
      bench.run_ms(1);
    }
    if (*at == '6') control(bench, 0x0006);
    if (*at == '7') control(bench, 0x0007);
    if (*at == 'F') control(bench, 0x000F);
    if (*at == 'q') {
      bench.put(kNode, 0x605A, 0, 6, 2);
      control(bench, 0x0002);
    }
  }
}

constexpr unsigned kDisabled = 0x0250, kReady = 0x0231, kOn = 0x0233, kEnabled = 0x0237,
                   kQuick = 0x0217, kFaulty = 0x0218;

// Proves DRV-2.
void every_state_has_its_statusword(void**) {
  struct Row {
    const char* way;
    unsigned word;
  };
  for (const Row& row : {Row{"", kDisabled}, Row{"6", kReady}, Row{"67", kOn}, Row{"67F", kEnabled},
                         Row{"67Fq", kQuick}, Row{"f", kFaulty}}) {
    DrivesBench& bench = in_torque_mode();
    bring(bench, row.way);
    assert_int_equal(status(bench), row.word);
  }
}

/// Rows: a state, and where each controlword leads from it. Empty cells of the standard stay.
void every_command_leads_where_the_standard_says(void**) {
  struct Row {
    const char* way;
    unsigned disable_voltage, quick_stop, shutdown, switch_on, enable, reset;
  };
  const Row rows[] = {
      {"", kDisabled, kDisabled, kReady, kDisabled, kDisabled, kDisabled},
      {"6", kDisabled, kDisabled, kReady, kOn, kEnabled, kReady},
      {"67", kDisabled, kDisabled, kReady, kOn, kEnabled, kOn},
      {"67F", kDisabled, kQuick, kReady, kOn, kEnabled, kEnabled},
      {"67Fq", kDisabled, kQuick, kQuick, kQuick, kEnabled, kQuick},
      {"f", kFaulty, kFaulty, kFaulty, kFaulty, kFaulty, kDisabled},
  };
  for (const Row& row : rows) {
    const unsigned words[] = {0x0000, 0x0002, 0x0006, 0x0007, 0x000F, 0x0080};
    const unsigned expected[] = {row.disable_voltage, row.quick_stop, row.shutdown,
                                 row.switch_on,       row.enable,     row.reset};
    for (int i = 0; i < 6; ++i) {
      DrivesBench& bench = in_torque_mode();
      bring(bench, row.way);
      bench.put(kNode, 0x605A, 0, 6, 2);
      control(bench, words[i]);
      if (status(bench) != expected[i])
        print_error("from \"%s\" by %04X: %04X\n", row.way, words[i], status(bench));
      assert_int_equal(status(bench), expected[i]);
    }
  }
}

void bits_that_do_not_matter_do_not_matter(void**) {
  DrivesBench& bench = in_torque_mode();
  control(bench, 0xFF5E);  // shutdown with every free bit set: x 1 1 0, and bit 7 clear
  assert_int_equal(status(bench), kReady);
  control(bench, 0x0087);  // switch on with fault reset set: no command
  assert_int_equal(status(bench), kReady);
  control(bench, 0x000D);  // voltage off
  assert_int_equal(status(bench), kDisabled);
}

void a_fault_is_reset_by_a_rising_edge_only(void**) {
  DrivesBench& bench = in_torque_mode();
  control(bench, 0x0080);
  trip(bench);
  control(bench, 0x0080);  // it has been set all the time
  assert_int_equal(status(bench), kFaulty);
  control(bench, 0x0000);
  control(bench, 0x0080);
  assert_int_equal(status(bench), kDisabled);
}

void the_mode_changes_only_while_operation_is_not_enabled(void**) {
  DrivesBench& bench = in_torque_mode();
  bring(bench, "67F");
  bench.put(kNode, 0x6060, 0, 9, 1);
  assert_int_equal(bench.get(kNode, 0x6061, 0), 10);
  control(bench, 0x0007);
  bench.run_ms(1);
  assert_int_equal(bench.get(kNode, 0x6061, 0), 9);
}

void bit_12_and_the_brake_object_show_when_the_brake_is_open(void**) {
  DrivesBench& bench = in_torque_mode();
  bring(bench, "67F");
  bench.run_ms(148);
  assert_int_equal(bench.get(kNode, 0x6041, 0) & 0x1000, 0);
  assert_int_equal(bench.get(kNode, 0x60FE, 1) & 1, 1);
  bench.run_ms(5);
  assert_int_equal(bench.get(kNode, 0x6041, 0) & 0x1000, 0x1000);
  assert_int_equal(bench.get(kNode, 0x60FE, 1) & 1, 0);
}

/// The joint falls for 50 ms; then a stop by each option ends in the state of the standard.
void every_option_of_a_stop_is_honoured(void**) {
  struct Row {
    unsigned object, option, word;
    unsigned at_once, later;
  };
  for (const Row& row :
       {Row{0x605A, 0, 0x02, kDisabled, kDisabled}, Row{0x605A, 1, 0x02, kQuick, kDisabled},
        Row{0x605A, 2, 0x02, kQuick, kDisabled}, Row{0x605A, 4, 0x02, kQuick, kDisabled},
        Row{0x605A, 5, 0x02, kQuick, kQuick}, Row{0x605A, 6, 0x02, kQuick, kQuick},
        Row{0x605B, 0, 0x06, kReady, kReady}, Row{0x605B, 1, 0x06, kEnabled, kReady},
        Row{0x605C, 0, 0x07, kOn, kOn}, Row{0x605C, 1, 0x07, kEnabled, kOn}}) {
    DrivesBench& bench = in_torque_mode();
    bench.put(kNode, row.object, 0, row.option, 2);
    bring(bench, "67F");
    bench.run_ms(200);
    control(bench, row.word);
    if (status(bench) != row.at_once) print_error("%04X = %u\n", row.object, row.option);
    assert_int_equal(status(bench), row.at_once);
    bench.run_ms(400);
    assert_int_equal(status(bench), row.later);
    ASSERT_NEAR(bench.arm.arm().dq().cwiseAbs().maxCoeff(), 0.0, 1e-3);
  }
}

void a_stop_that_leads_out_can_be_taken_back(void**) {
  DrivesBench& bench = in_torque_mode();
  bring(bench, "67F");
  bench.run_ms(200);
  control(bench, 0x0007);
  assert_int_equal(bench.get(kNode, 0x6041, 0) & 0x1000, 0);
  control(bench, 0x000F);
  assert_int_equal(bench.get(kNode, 0x6041, 0) & 0x127F, 0x1237);
}

void a_fault_in_motion_brakes_before_the_power_goes(void**) {
  DrivesBench& bench = in_torque_mode();
  bring(bench, "67F");
  bench.run_ms(200);
  trip(bench);
  bench.run_ms(1);
  assert_int_equal(status(bench), 0x021F);
  bench.run_ms(400);
  assert_int_equal(status(bench), kFaulty);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_state_has_its_statusword),
      cmocka_unit_test(every_command_leads_where_the_standard_says),
      cmocka_unit_test(bits_that_do_not_matter_do_not_matter),
      cmocka_unit_test(a_fault_is_reset_by_a_rising_edge_only),
      cmocka_unit_test(the_mode_changes_only_while_operation_is_not_enabled),
      cmocka_unit_test(bit_12_and_the_brake_object_show_when_the_brake_is_open),
      cmocka_unit_test(every_option_of_a_stop_is_honoured),
      cmocka_unit_test(a_stop_that_leads_out_can_be_taken_back),
      cmocka_unit_test(a_fault_in_motion_brakes_before_the_power_goes),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
