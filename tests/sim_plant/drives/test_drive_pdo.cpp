// PDOs of an emulated drive: transmission types, lengths, time-outs.
#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

// Proves DRV-4.
void synchronous_commands_act_at_sync_and_others_at_once(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1400, 0x201, 1, {0x60400010});
  bench.map(2, 0x1400, 0x202, 255, {0x60400010});
  bench.start();
  bench.send(0x201, {0x06, 0x00});
  bench.send(0x202, {0x06, 0x00});
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0250);
  assert_int_equal(bench.get(2, 0x6041, 0), 0x0231);
  bench.sync_cycle();
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0231);
}

void there_are_no_pdos_outside_operation(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1400, 0x201, 255, {0x60400010});
  bench.map(1, 0x1800, 0x181, 1, {0x60410010});
  bench.send(0x201, {0x06, 0x00});
  bench.sync_cycle();
  bench.expect_nothing(0x181);
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0250);
}

void every_nth_sync_has_its_tpdo(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1800, 0x181, 3, {0x60410010});
  bench.start();
  int count = 0;
  for (int i = 1; i <= 9; ++i) {
    bench.sync_cycle();
    while (bench.take(0x181)) ++count;
    assert_int_equal(count, i / 3);
  }
}

void a_tpdo_of_type_0_is_sent_at_sync_after_a_change(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1800, 0x181, 0, {0x60410010});
  bench.start();
  bench.sync_cycle();
  bench.expect(0x181, {0x50, 0x02});
  bench.sync_cycle();
  bench.expect_nothing(0x181);
  bench.put(1, 0x6040, 0, 6, 2);
  bench.expect_nothing(0x181);
  bench.sync_cycle();
  bench.expect(0x181, {0x31, 0x02});
}

void an_event_is_sent_on_change_not_within_the_inhibit_time(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1800, 1, 0x80000181LL, 4);
  bench.put(1, 0x1800, 3, 100, 2);  // 10 ms
  bench.put(1, 0x1800, 5, 50, 2);
  bench.put(1, 0x1800, 1, 0x181, 4);
  bench.start();
  bench.run_ms(1);
  bench.expect(0x181, {0x50, 0x02});
  bench.put(1, 0x6040, 0, 6, 2);
  bench.run_ms(9);
  bench.expect_nothing(0x181);
  bench.run_ms(1);
  bench.expect(0x181, {0x31, 0x02});
  bench.run_ms(49);
  bench.expect_nothing(0x181);
  bench.run_ms(1);
  bench.expect(0x181, {0x31, 0x02});  // by the event timer
}

void a_tpdo_answers_a_remote_request_where_it_is_allowed(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1800, 0x181, 253, {0x60410010});
  bench.map(2, 0x1800, 0x182, 253, {0x60410010});
  bench.put(2, 0x1800, 1, 0x40000182, 4);
  bench.start();
  for (const unsigned id : {0x181U, 0x182U}) {
    can::CanFrame request = make_frame(id, {});
    request.remote = true;
    bench.arm.receive(0, request, bench.now_ns);
  }
  bench.expect(0x181, {0x50, 0x02});
  bench.expect_nothing(0x182);
}

void a_command_that_is_too_short_is_ignored_and_one_too_long_is_taken(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1400, 0x201, 255, {0x60400010, 0x60710010});
  bench.start();
  bench.send(0x201, {0x06, 0x00, 0x01});
  bench.expect(0x081, {0x10, 0x82, 0x11, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6041, 0), 0x02D0);  // with a warning
  bench.send(0x201, {0x06, 0x00, 0x01, 0x00, 0xFF});
  bench.expect(0x081, {0x00, 0x00, 0x00, 0, 0, 0, 0, 0});  // no longer too short
  bench.expect(0x081, {0x20, 0x82, 0x11, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6041, 0), 0x02B1);
  bench.send(0x201, {0x06, 0x00, 0x01, 0x00});
  bench.expect(0x081, {0x00, 0x00, 0x00, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0231);
}

void a_command_that_stays_away_is_a_fault(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1400, 0x201, 255, {0x60400010});
  bench.put(1, 0x1400, 5, 20, 2);
  bench.start();
  bench.run_ms(100);
  bench.expect_nothing(0x081);  // the first one begins the watch
  bench.send(0x201, {0x06, 0x00});
  bench.run_ms(19);
  bench.expect_nothing(0x081);
  bench.run_ms(1);
  bench.expect(0x081, {0x50, 0x82, 0x11, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6041, 0) & 0x4F, 0x08);
}

void a_sync_that_stays_away_is_a_fault(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1006, 0, 1000, 4);
  bench.put(1, 0x1007, 0, 3000, 4);
  bench.start();
  for (int i = 0; i < 5; ++i) bench.sync_cycle();
  bench.run_ms(3);
  bench.expect_nothing(0x081);
  bench.run_ms(1);
  bench.expect(0x081, {0x00, 0x87, 0x11, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6041, 0) & 0x4F, 0x08);
}

void the_sync_counter_decides_when_a_tpdo_begins(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1019, 0, 4, 1);
  bench.put(1, 0x1800, 1, 0x80000181LL, 4);
  bench.put(1, 0x1800, 6, 3, 1);
  bench.map(1, 0x1800, 0x181, 1, {0x60410010});
  bench.start();
  for (unsigned counter = 1; counter <= 4; ++counter) {
    bench.send(0x080, {counter});
    if (counter < 3)
      bench.expect_nothing(0x181);
    else
      bench.expect(0x181, {0x50, 0x02});
  }
  bench.send(0x080, {});  // without its counter it is none
  bench.expect(0x081, {0x40, 0x82, 0x11, 0, 0, 0, 0, 0});
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(synchronous_commands_act_at_sync_and_others_at_once),
      cmocka_unit_test(there_are_no_pdos_outside_operation),
      cmocka_unit_test(every_nth_sync_has_its_tpdo),
      cmocka_unit_test(a_tpdo_of_type_0_is_sent_at_sync_after_a_change),
      cmocka_unit_test(an_event_is_sent_on_change_not_within_the_inhibit_time),
      cmocka_unit_test(a_tpdo_answers_a_remote_request_where_it_is_allowed),
      cmocka_unit_test(a_command_that_is_too_short_is_ignored_and_one_too_long_is_taken),
      cmocka_unit_test(a_command_that_stays_away_is_a_fault),
      cmocka_unit_test(a_sync_that_stays_away_is_a_fault),
      cmocka_unit_test(the_sync_counter_decides_when_a_tpdo_begins),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
