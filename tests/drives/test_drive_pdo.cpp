// PDOs of an emulated drive: mapping rules, transmission types, lengths, time-outs.
#include "tests/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

DrivesBench& booted(const DriveArmSettings& settings = one_bus()) {
  DrivesBench& bench = fresh(settings);
  bench.boot();
  return bench;
}
void start(DrivesBench& bench) {
  bench.send(0x000, {0x01, 0x00});
}
/// Passes a millisecond with a SYNC at its end.
void cycle(DrivesBench& bench) {
  bench.now_ns += 1'000'000;
  bench.send(0x080, {});
  bench.arm.advance(bench.now_ns);
}

void a_mapping_is_refused_with_the_code_of_the_standard(void**) {
  struct Row {
    unsigned record, entry, abort;
  };
  DrivesBench& bench = booted();
  bench.put(1, 0x1400, 1, 0x80000201LL, 4);
  bench.put(1, 0x1800, 1, 0x80000181LL, 4);
  bench.put(1, 0x1600, 0, 0, 1);
  bench.put(1, 0x1A00, 0, 0, 1);
  for (const Row& row : {Row{0x1600, 0x5FFF0010, 0x06020000},     // no object
                         Row{0x1600, 0x60400110, 0x06090011},     // no sub-index
                         Row{0x1600, 0x60410010, 0x06040041},     // read-only in an RPDO
                         Row{0x1A00, 0x60720010, 0x06040041},     // not for a TPDO
                         Row{0x1600, 0x10170010, 0x06040041},     // not mappable at all
                         Row{0x1600, 0x60710020, 0x06040041},     // wrong length
                         Row{0x1600, 0x00060008, 0x06040041},     // a dummy of wrong length
                         Row{0x1A00, 0x00060010, 0x06040041}}) {  // a dummy in a TPDO
    const std::uint32_t abort = bench.write(1, row.record, 1, row.entry, 4);
    if (abort != row.abort) print_error("%08X: %08X\n", row.entry, abort);
    assert_int_equal(abort, row.abort);
  }
  bench.put(1, 0x1600, 1, 0x60400010, 4);
  bench.put(1, 0x1600, 2, 0x607A0020, 4);
  bench.put(1, 0x1600, 3, 0x60FF0020, 4);
  assert_int_equal(bench.write(1, 0x1600, 0, 3, 1), 0x06040042);  // ten bytes
  assert_int_equal(bench.write(1, 0x1600, 0, 65, 1), 0x06090031);
  assert_int_equal(bench.write(1, 0x1600, 0, 4, 1), 0x06020000);  // the fourth is empty
  bench.put(1, 0x1600, 0, 2, 1);
  assert_int_equal(bench.write(1, 0x1600, 1, 0x60710010, 4), 0x08000022);  // sub 0 is not 0
}

void a_pdo_changes_only_while_it_is_invalid_and_not_in_operation(void**) {
  DrivesBench& bench = booted();
  assert_int_equal(bench.write(1, 0x1600, 0, 0, 1), 0x08000022);
  assert_int_equal(bench.write(1, 0x1400, 1, 0x222, 4), 0x08000022);
  assert_int_equal(bench.write(1, 0x1800, 3, 10, 2), 0x08000022);
  bench.put(1, 0x1400, 1, 0x80000222LL, 4);
  bench.put(1, 0x1600, 0, 0, 1);
  start(bench);
  assert_int_equal(bench.write(1, 0x1600, 0, 1, 1), 0x08000022);
  assert_int_equal(bench.write(1, 0x1400, 1, 0x222, 4), 0x08000022);
  bench.send(0x000, {0x80, 0x00});
  bench.put(1, 0x1600, 0, 1, 1);
  bench.put(1, 0x1400, 1, 0x222, 4);
}

void reserved_identifiers_and_types_are_refused(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1400, 1, 0x80000201LL, 4);
  for (const unsigned id : {0x000U, 0x07FU, 0x101U, 0x180U, 0x5FFU, 0x67FU, 0x701U, 0x7FFU})
    assert_int_equal(bench.write(1, 0x1400, 1, id, 4), 0x06090030);
  assert_int_equal(bench.write(1, 0x1400, 1, 0x20000201, 4), 0x06090030);  // 29 bits
  for (const unsigned type : {241U, 251U, 252U, 253U})
    assert_int_equal(bench.write(1, 0x1400, 2, type, 1), 0x06090030);
  bench.put(1, 0x1800, 2, 252, 1);
  assert_int_equal(bench.write(1, 0x1800, 2, 251, 1), 0x06090030);
}

void synchronous_commands_act_at_sync_and_others_at_once(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1400, 0x201, 1, {0x60400010});
  bench.map(2, 0x1400, 0x202, 255, {0x60400010});
  start(bench);
  bench.send(0x201, {0x06, 0x00});
  bench.send(0x202, {0x06, 0x00});
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0250);
  assert_int_equal(bench.get(2, 0x6041, 0), 0x0231);
  cycle(bench);
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0231);
}

void there_are_no_pdos_outside_operation(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1400, 0x201, 255, {0x60400010});
  bench.map(1, 0x1800, 0x181, 1, {0x60410010});
  bench.send(0x201, {0x06, 0x00});
  cycle(bench);
  bench.expect_nothing(0x181);
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0250);
}

void a_broadcast_command_is_shared_with_dummies(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1401, 0x220, 1, {0x60710010, 0x00070020, 0x00060010});
  bench.map(2, 0x1401, 0x220, 1, {0x00060010, 0x60710010, 0x00070020});
  bench.map(3, 0x1401, 0x220, 1, {0x00070020, 0x60710010, 0x00060010});
  start(bench);
  bench.send(0x220, {0x11, 0x01, 0x22, 0x02, 0x33, 0x03, 0x44, 0x04});
  cycle(bench);
  assert_int_equal(bench.get(1, 0x6071, 0), 0x0111);
  assert_int_equal(bench.get(2, 0x6071, 0), 0x0222);
  assert_int_equal(bench.get(3, 0x6071, 0), 0x0333);
}

void every_nth_sync_has_its_tpdo(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1800, 0x181, 3, {0x60410010});
  start(bench);
  int count = 0;
  for (int i = 1; i <= 9; ++i) {
    cycle(bench);
    while (bench.take(0x181)) ++count;
    assert_int_equal(count, i / 3);
  }
}

void a_tpdo_of_type_0_is_sent_at_sync_after_a_change(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1800, 0x181, 0, {0x60410010});
  start(bench);
  cycle(bench);
  bench.expect(0x181, {0x50, 0x02});
  cycle(bench);
  bench.expect_nothing(0x181);
  bench.put(1, 0x6040, 0, 6, 2);
  bench.expect_nothing(0x181);
  cycle(bench);
  bench.expect(0x181, {0x31, 0x02});
}

void an_event_is_sent_on_change_not_within_the_inhibit_time(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1800, 1, 0x80000181LL, 4);
  bench.put(1, 0x1800, 3, 100, 2);  // 10 ms
  bench.put(1, 0x1800, 5, 50, 2);
  bench.put(1, 0x1800, 1, 0x181, 4);
  start(bench);
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
  start(bench);
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
  start(bench);
  bench.send(0x201, {0x06, 0x00, 0x01});
  bench.expect(0x081, {0x10, 0x82, 0x11, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0250);
  bench.send(0x201, {0x06, 0x00, 0x01, 0x00, 0xFF});
  bench.expect(0x081, {0x00, 0x00, 0x00, 0, 0, 0, 0, 0});  // no longer too short
  bench.expect(0x081, {0x20, 0x82, 0x11, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0231);
  bench.send(0x201, {0x06, 0x00, 0x01, 0x00});
  bench.expect(0x081, {0x00, 0x00, 0x00, 0, 0, 0, 0, 0});
}

void a_command_that_stays_away_is_a_fault(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1400, 0x201, 255, {0x60400010});
  bench.put(1, 0x1400, 5, 20, 2);
  start(bench);
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
  start(bench);
  for (int i = 0; i < 5; ++i) cycle(bench);
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
  start(bench);
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

void can_fd_carries_long_pdos(void**) {
  DriveArmSettings settings = one_bus();
  settings.fd = true;
  DrivesBench& bench = booted(settings);
  bench.map(1, 0x1800, 0x181, 1, {0x60410010, 0x60640020, 0x606C0020, 0x60770010});
  bench.map(2, 0x1800, 0x182, 1, {0x60410010, 0x60640020, 0x606C0020, 0x60770010, 0x60740010});
  // Controlword and torque of seven drives, 28 bytes in a frame of 32; drive 2 has bytes 4 to 7.
  bench.map(2, 0x1400, 0x200, 1,
            {0x00070020, 0x60400010, 0x60710010, 0x00070020, 0x00070020, 0x00070020, 0x00070020,
             0x00070020});
  start(bench);
  can::CanFrame command = make_frame(0x200, {0, 0, 0, 0, 0x06, 0x00, 0x39, 0x05});
  command.fd = true;
  command.size = 32;
  bench.arm.receive(0, command, bench.now_ns);
  cycle(bench);
  assert_true(bench.take(0x181));
  assert_int_equal(bench.frame.size, 12);
  assert_true(bench.frame.fd);
  assert_true(bench.take(0x182));
  assert_int_equal(bench.frame.size, 16);  // 14 bytes, padded
  assert_int_equal(bench.frame.data[0], 0x31);
  bench.expect_nothing(0x082);
  assert_int_equal(bench.get(2, 0x6071, 0), 0x0539);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_mapping_is_refused_with_the_code_of_the_standard),
      cmocka_unit_test(a_pdo_changes_only_while_it_is_invalid_and_not_in_operation),
      cmocka_unit_test(reserved_identifiers_and_types_are_refused),
      cmocka_unit_test(synchronous_commands_act_at_sync_and_others_at_once),
      cmocka_unit_test(there_are_no_pdos_outside_operation),
      cmocka_unit_test(a_broadcast_command_is_shared_with_dummies),
      cmocka_unit_test(every_nth_sync_has_its_tpdo),
      cmocka_unit_test(a_tpdo_of_type_0_is_sent_at_sync_after_a_change),
      cmocka_unit_test(an_event_is_sent_on_change_not_within_the_inhibit_time),
      cmocka_unit_test(a_tpdo_answers_a_remote_request_where_it_is_allowed),
      cmocka_unit_test(a_command_that_is_too_short_is_ignored_and_one_too_long_is_taken),
      cmocka_unit_test(a_command_that_stays_away_is_a_fault),
      cmocka_unit_test(a_sync_that_stays_away_is_a_fault),
      cmocka_unit_test(the_sync_counter_decides_when_a_tpdo_begins),
      cmocka_unit_test(can_fd_carries_long_pdos),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
