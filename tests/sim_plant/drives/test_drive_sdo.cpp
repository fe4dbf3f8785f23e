// SDO of an emulated drive, byte by byte, and every abort code.
#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

// Proves DRV-1.
void the_device_type_reads_as_in_the_worked_trace(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0});
  bench.expect(0x581, {0x43, 0x00, 0x10, 0x00, 0x92, 0x01, 0x02, 0x00});
}

void the_mode_is_written_as_in_the_worked_trace(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x2F, 0x60, 0x60, 0x00, 0x0A, 0, 0, 0});
  bench.expect(0x581, {0x60, 0x60, 0x60, 0x00, 0, 0, 0, 0});
  bench.send(0x601, {0x40, 0x61, 0x60, 0x00, 0, 0, 0, 0});
  bench.expect(0x581, {0x4F, 0x61, 0x60, 0x00, 0x0A, 0, 0, 0});
}

void every_size_of_object_has_its_command_byte(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x40, 0x41, 0x60, 0x00, 0, 0, 0, 0});
  bench.expect(0x581, {0x4B, 0x41, 0x60, 0x00, 0x50, 0x02, 0, 0});
  bench.send(0x603, {0x40, 0x00, 0x12, 0x02, 0, 0, 0, 0});
  bench.expect(0x583, {0x43, 0x00, 0x12, 0x02, 0x83, 0x05, 0, 0});
  bench.send(0x601, {0x2B, 0x17, 0x10, 0x00, 0x0A, 0x00, 0, 0});
  bench.expect(0x581, {0x60, 0x17, 0x10, 0x00, 0, 0, 0, 0});
}

void a_write_without_a_size_takes_that_of_the_object(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x22, 0x17, 0x10, 0x00, 0xE8, 0x03, 0, 0});
  bench.expect(0x581, {0x60, 0x17, 0x10, 0x00, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x1017, 0), 1000);
}

void a_text_comes_in_segments(void**) {
  DrivesBench& bench = booted();
  static char text[64];
  std::memset(text, 0, sizeof text);
  bench.send(0x601, {0x40, 0x08, 0x10, 0x00, 0, 0, 0, 0});
  bench.expect(0x581, {0x41, 0x08, 0x10, 0x00, 27, 0, 0, 0});
  std::size_t size = 0;
  for (unsigned n = 0; n < 4; ++n) {
    bench.send(0x601, {0x60 | (n % 2) << 4, 0, 0, 0, 0, 0, 0, 0});
    assert_true(bench.take(0x581));
    const bool last = n == 3;
    assert_int_equal(bench.frame.data[0], (n % 2) << 4 | (last ? 0x03 : 0x00));
    for (std::size_t i = 0; i < (last ? 6U : 7U); ++i)
      text[size++] = static_cast<char>(bench.frame.data[1 + i]);
  }
  assert_string_equal(text, "Tactus emulated servo drive");
}

void a_value_goes_in_segments(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x21, 0x85, 0x60, 0x00, 4, 0, 0, 0});
  bench.expect(0x581, {0x60, 0x85, 0x60, 0x00, 0, 0, 0, 0});
  bench.send(0x601, {0x0A, 0x78, 0x56, 0, 0, 0, 0, 0});  // two bytes, not the last
  bench.expect(0x581, {0x20, 0, 0, 0, 0, 0, 0, 0});
  bench.send(0x601, {0x1B, 0x34, 0x12, 0, 0, 0, 0, 0});  // two bytes, the last
  bench.expect(0x581, {0x30, 0, 0, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x6085, 0), 0x12345678);
}

void a_toggle_that_does_not_alternate_is_aborted(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x40, 0x08, 0x10, 0x00, 0, 0, 0, 0});
  bench.send(0x601, {0x70, 0, 0, 0, 0, 0, 0, 0});
  assert_true(bench.take(0x581));
  bench.expect(0x581, {0x80, 0x08, 0x10, 0x00, 0x00, 0x00, 0x03, 0x05});
  bench.send(0x601, {0x60, 0, 0, 0, 0, 0, 0, 0});  // the transfer is over
  bench.expect(0x581, {0x80, 0, 0, 0, 0x01, 0x00, 0x04, 0x05});
}

void a_client_may_abort(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x40, 0x08, 0x10, 0x00, 0, 0, 0, 0});
  assert_true(bench.take(0x581));
  bench.send(0x601, {0x80, 0x08, 0x10, 0x00, 0, 0, 4, 5});
  bench.expect_nothing(0x581);
  assert_int_equal(bench.get(1, 0x1000, 0), 0x00020192);
}

void a_transfer_that_pauses_is_aborted(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x40, 0x08, 0x10, 0x00, 0, 0, 0, 0});
  assert_true(bench.take(0x581));
  bench.run_ms(999);
  bench.expect_nothing(0x581);
  bench.run_ms(2);
  bench.expect(0x581, {0x80, 0x08, 0x10, 0x00, 0x00, 0x00, 0x04, 0x05});
}

void block_transfers_are_aborted_as_unknown(void**) {
  DrivesBench& bench = booted();
  for (const unsigned command : {0xA0U, 0xC2U, 0xE0U}) {
    bench.send(0x601, {command, 0x08, 0x10, 0x00, 0x7F, 0, 0, 0});
    bench.expect(0x581, {0x80, 0x08, 0x10, 0x00, 0x01, 0x00, 0x04, 0x05});
  }
}

void every_mistake_has_the_abort_code_of_the_standard(void**) {
  struct Mistake {
    unsigned index, sub;
    std::int64_t value;
    unsigned bytes;
    std::uint32_t abort;
  };
  DrivesBench& bench = booted();
  for (const Mistake& row : {
           Mistake{0x5FFF, 0, 0, 4, 0x06020000},  // no such object
           Mistake{0x1018, 5, 0, 4, 0x06090011},  // no such sub-index
           Mistake{0x1400, 4, 0, 1, 0x06090011},  // the one that is reserved
           Mistake{0x1000, 0, 0, 4, 0x06010002},  // read-only
           Mistake{0x6041, 0, 0, 2, 0x06010002},
           Mistake{0x1018, 0, 4, 1, 0x06010002},
           Mistake{0x6040, 0, 0, 4, 0x06070012},   // too long
           Mistake{0x6040, 0, 0, 1, 0x06070013},   // too short
           Mistake{0x605A, 0, 9, 2, 0x06090031},   // too high
           Mistake{0x605A, 0, -1, 2, 0x06090032},  // too low
           Mistake{0x608F, 1, 0, 4, 0x06090032},   // a division by zero
           Mistake{0x6060, 0, 1, 1, 0x06090030},   // a mode it does not have
           Mistake{0x6060, 0, -3, 1, 0x06090030},
           Mistake{0x1003, 0, 1, 1, 0x06090031},           // only 0 clears the history
           Mistake{0x1005, 0, 0x40000080, 4, 0x06090030},  // it does not produce SYNC
           Mistake{0x1019, 0, 1, 1, 0x06090030},           // 0 or 2 to 240
           Mistake{0x1019, 0, 241, 1, 0x06090031},
           Mistake{0x1014, 0, 0x82, 4, 0x08000022},  // while it is valid
           Mistake{0x1029, 1, 3, 1, 0x06090031},
       }) {
    const std::uint32_t abort = bench.write(1, row.index, row.sub, row.value, row.bytes);
    if (abort != row.abort) print_error("%04X:%u: %08X\n", row.index, row.sub, abort);
    assert_int_equal(abort, row.abort);
  }
  assert_int_equal(bench.read(1, 0x2000, 0), 0x06020000);
  assert_int_equal(bench.read(1, 0x6076, 1), 0x06090011);
  assert_int_equal(bench.read(1, 0x1003, 1), 0x08000024);  // no error has happened
}

void a_node_is_watched_by_one_entry_only(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1016, 1, 0x007F0064, 4);
  assert_int_equal(bench.write(1, 0x1016, 2, 0x007F0032, 4), 0x06040043);
  bench.put(1, 0x1016, 1, 0x007F0032, 4);
}

void the_sync_counter_is_fixed_while_sync_has_a_period(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1006, 0, 1000, 4);
  assert_int_equal(bench.write(1, 0x1019, 0, 4, 1), 0x08000022);
}

void a_segment_that_is_too_long_or_too_short_changes_nothing(void**) {
  DrivesBench& bench = booted();
  const std::uint32_t before = bench.get(1, 0x6085, 0);
  bench.send(0x601, {0x21, 0x85, 0x60, 0x00, 5, 0, 0, 0});
  bench.expect(0x581, {0x80, 0x85, 0x60, 0x00, 0x12, 0x00, 0x07, 0x06});
  bench.send(0x601, {0x21, 0x85, 0x60, 0x00, 4, 0, 0, 0});
  bench.expect(0x581, {0x60, 0x85, 0x60, 0x00, 0, 0, 0, 0});
  bench.send(0x601, {0x01, 1, 2, 3, 4, 5, 6, 7});
  bench.expect(0x581, {0x80, 0x85, 0x60, 0x00, 0x12, 0x00, 0x07, 0x06});
  bench.send(0x601, {0x20, 0x85, 0x60, 0x00, 0, 0, 0, 0});
  bench.expect(0x581, {0x60, 0x85, 0x60, 0x00, 0, 0, 0, 0});
  bench.send(0x601, {0x09, 1, 2, 3, 0, 0, 0, 0});
  bench.expect(0x581, {0x80, 0x85, 0x60, 0x00, 0x13, 0x00, 0x07, 0x06});
  assert_int_equal(bench.get(1, 0x6085, 0), before);
}

void a_request_that_is_too_short_gets_no_answer(void**) {
  DrivesBench& bench = booted();
  bench.send(0x601, {0x40, 0x00, 0x10, 0x00});
  bench.expect_nothing(0x581);
}

void there_is_no_sdo_before_boot_up_or_when_stopped(void**) {
  DrivesBench& bench = fresh();
  assert_int_equal(bench.read(1, 0x1000, 0), 0xFFFFFFFF);
  bench.boot();
  bench.send(0x000, {0x02, 0x01});
  assert_int_equal(bench.read(1, 0x1000, 0), 0xFFFFFFFF);
  assert_int_equal(bench.read(2, 0x1000, 0), 0);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_device_type_reads_as_in_the_worked_trace),
      cmocka_unit_test(the_mode_is_written_as_in_the_worked_trace),
      cmocka_unit_test(every_size_of_object_has_its_command_byte),
      cmocka_unit_test(a_write_without_a_size_takes_that_of_the_object),
      cmocka_unit_test(a_text_comes_in_segments),
      cmocka_unit_test(a_value_goes_in_segments),
      cmocka_unit_test(a_toggle_that_does_not_alternate_is_aborted),
      cmocka_unit_test(a_client_may_abort),
      cmocka_unit_test(a_transfer_that_pauses_is_aborted),
      cmocka_unit_test(block_transfers_are_aborted_as_unknown),
      cmocka_unit_test(every_mistake_has_the_abort_code_of_the_standard),
      cmocka_unit_test(a_node_is_watched_by_one_entry_only),
      cmocka_unit_test(the_sync_counter_is_fixed_while_sync_has_a_period),
      cmocka_unit_test(a_segment_that_is_too_long_or_too_short_changes_nothing),
      cmocka_unit_test(a_request_that_is_too_short_gets_no_answer),
      cmocka_unit_test(there_is_no_sdo_before_boot_up_or_when_stopped),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
