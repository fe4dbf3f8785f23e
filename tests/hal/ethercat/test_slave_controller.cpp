// The emulated slave controller: addressing, working counters, sync managers, FMMUs.
#include "tests/hal/ethercat/segment_bench.hpp"

namespace tactus::segment {
namespace {

// Proves ECAT-2.
void a_broadcast_counts_the_slaves_and_joins_what_they_read(void**) {
  SegmentBench& bench = fresh_segment(5);
  assert_int_equal(bench.send(Command::kBrd, 0, nullptr, 1), 5);
  assert_int_equal(bench.data[0], 0x11);
  assert_int_equal(bench.position, 5);
  const std::uint16_t init = 0x11;
  assert_int_equal(bench.send(Command::kBwr, address_of(0, kAlControlReg), &init, 2), 5);
  assert_int_equal(bench.send(Command::kBrw, address_of(0, kAlControlReg), &init, 2), 15);
}

void a_position_addresses_one_slave_and_is_counted_up_by_all(void**) {
  SegmentBench& bench = fresh_segment();
  bench.give_stations();
  for (int i = 0; i < kDof; ++i) {
    assert_int_equal(
        bench.send(Command::kAprd, address_of(position_field(i), kStationReg), nullptr, 2), 1);
    assert_int_equal(bench.word(), 0x1001 + i);
    assert_int_equal(bench.position, static_cast<std::uint16_t>(kDof - i));
    assert_int_equal(bench.read(i, kStationReg, 2), 1);
  }
  assert_int_equal(
      bench.send(Command::kAprd, address_of(position_field(kDof), kStationReg), nullptr, 2), 0);
  assert_int_equal(bench.send(Command::kFprd, address_of(0x2000, kStationReg), nullptr, 2), 0);
}

void reading_and_writing_counts_three(void**) {
  SegmentBench& bench = fresh_segment();
  bench.give_stations();
  const std::uint16_t value = 0x1234;
  const std::uint32_t at = address_of(0x1002, kRam + 0x800);
  assert_int_equal(bench.send(Command::kFprw, at, &value, 2), 3);
  assert_int_equal(bench.word(), 0);  // what was there before
  assert_int_equal(bench.send(Command::kFprd, at, nullptr, 2), 1);
  assert_int_equal(bench.word(), 0x1234);
}

void one_slave_reads_and_the_others_write(void**) {
  SegmentBench& bench = fresh_segment();
  bench.give_stations();
  assert_int_equal(bench.write<std::uint16_t>(2, kRam + 0x800, 77), 1);
  assert_int_equal(bench.send(Command::kFrmw, address_of(0x1003, kRam + 0x800), nullptr, 2), kDof);
  assert_int_equal(bench.word(), 77);
  assert_int_equal(bench.read(6, kRam + 0x800, 2), 1);
  assert_int_equal(bench.word(), 77);  // behind it
  assert_int_equal(bench.read(0, kRam + 0x800, 2), 1);
  assert_int_equal(bench.word(), 0);  // before it the datagram still had zeros
}

void registers_of_the_controller_are_not_written(void**) {
  SegmentBench& bench = fresh_segment();
  bench.give_stations();
  bench.write<std::uint8_t>(0, 0x0000, 0x99);
  bench.write<std::uint16_t>(0, kAlStatusReg, 0x0008);
  assert_int_equal(bench.read(0, 0x0000, 1), 1);
  assert_int_equal(bench.data[0], 0x11);
  assert_int_equal(bench.read(0, kAlStatusReg, 2), 1);
  assert_int_equal(bench.word(), 1);
  assert_int_equal(bench.read(0, 0x2FFF, 2), 0);  // beyond the memory
}

void a_mailbox_takes_one_message_at_a_time_and_only_in_its_direction(void**) {
  SegmentBench& bench = fresh_segment(1);
  bench.give_stations();
  bench.write_sm(0, 0, 0x1000, 16, kMailboxOutControl);
  std::uint8_t message[16] = {};
  const std::uint32_t at = address_of(0x1001, 0x1000);
  assert_int_equal(bench.send(Command::kFprd, at, nullptr, 16), 0);  // not for reading
  assert_int_equal(bench.send(Command::kFpwr, at, message, 8), 1);   // not to its end
  assert_int_equal(bench.read(0, kSmReg + 5, 1), 1);
  assert_int_equal(bench.data[0] & kSmFull, 0);
  assert_int_equal(bench.send(Command::kFpwr, at, message, 16), 1);
  assert_int_equal(bench.read(0, kSmReg + 5, 1), 1);
  assert_int_equal(bench.data[0] & kSmFull, kSmFull);
  assert_int_equal(bench.send(Command::kFpwr, at, message, 16), 0);  // full
  bench.write_sm(0, 1, 0x1100, 16, kMailboxInControl);
  bench.line.slave(0).esc().set_full(1, true);
  assert_int_equal(bench.read(0, 0x1108, 8), 0);  // not from its first byte on
  assert_int_equal(bench.read(0, 0x1100, 8), 1);
  assert_int_equal(bench.read(0, 0x110F, 1), 1);
  assert_int_equal(bench.read(0, 0x1100, 8), 0);        // empty with its last byte
  bench.write_sm(0, 0, 0x1000, 0, kMailboxOutControl);  // disabling empties it
  assert_int_equal(bench.read(0, kSmReg + 5, 1), 1);
  assert_int_equal(bench.data[0] & kSmFull, 0);
}

void an_enabled_sync_manager_keeps_its_place(void**) {
  SegmentBench& bench = fresh_segment(1);
  bench.give_stations();
  bench.write_sm(0, 2, 0x1200, 8, kOutputsControl);
  bench.write<std::uint16_t>(0, kSmReg + 16, 0x1500);
  assert_int_equal(bench.read(0, kSmReg + 16, 2), 1);
  assert_int_equal(bench.word(), 0x1200);
}

/// The image of two slaves, each with 2 bytes of outputs and 4 of inputs.
SegmentBench& mapped() {
  SegmentBench& bench = fresh_segment(2);
  bench.give_stations();
  for (int i = 0; i < 2; ++i) {
    bench.write_fmmu(i, 0, 0x10000U + 2U * static_cast<unsigned>(i), 2, 0x1800, kFmmuWrite);
    bench.write_fmmu(i, 1, 0x10004U + 4U * static_cast<unsigned>(i), 4, 0x1900, kFmmuRead);
    bench.write<std::uint32_t>(i, 0x1900, 0xAAAA0000U + static_cast<unsigned>(i));
  }
  return bench;
}

void logical_addresses_count_three_for_each_slave(void**) {
  SegmentBench& bench = mapped();
  std::uint8_t image[12] = {1, 2, 3, 4};
  assert_int_equal(bench.send(Command::kLrw, 0x10000, image, 12), 6);
  assert_int_equal(get<std::uint32_t>(bench.data.data() + 4), 0xAAAA0000);
  assert_int_equal(get<std::uint32_t>(bench.data.data() + 8), 0xAAAA0001);
  assert_int_equal(bench.read(1, 0x1800, 2), 1);
  assert_int_equal(bench.word(), 0x0403);
  assert_int_equal(bench.send(Command::kLrd, 0x10000, image, 12), 2);
  assert_int_equal(bench.send(Command::kLwr, 0x10000, image, 12), 2);
  assert_int_equal(bench.send(Command::kLrw, 0x20000, image, 12), 0);
}

/// The trap: what a missing slave would have read is what was sent.
void inputs_of_a_missing_slave_are_the_bytes_that_were_sent(void**) {
  SegmentBench& bench = mapped();
  std::uint8_t image[12];
  std::memset(image, 0x5A, sizeof image);
  LineFault fault;
  fault.kind = LineFaultKind::kBreak;
  fault.slave = 1;
  bench.line.add(fault);
  assert_int_equal(bench.send(Command::kLrw, 0x10000, image, 12), 3);
  assert_int_equal(get<std::uint32_t>(bench.data.data() + 4), 0xAAAA0000);
  assert_int_equal(get<std::uint32_t>(bench.data.data() + 8), 0x5A5A5A5A);
}

void overlapping_areas_write_what_was_received(void**) {
  SegmentBench& bench = fresh_segment(1);
  bench.give_stations();
  bench.write_fmmu(0, 0, 0x100, 2, 0x1800, kFmmuRead);
  bench.write_fmmu(0, 1, 0x100, 2, 0x1900, kFmmuWrite);
  bench.write<std::uint16_t>(0, 0x1800, 0x1111);
  const std::uint16_t sent = 0x2222;
  assert_int_equal(bench.send(Command::kLrw, 0x100, &sent, 2), 3);
  assert_int_equal(bench.word(), 0x1111);
  assert_int_equal(bench.read(0, 0x1900, 2), 1);
  assert_int_equal(bench.word(), 0x2222);
}

void a_bit_of_a_register_is_mapped(void**) {
  SegmentBench& bench = fresh_segment(1);
  bench.give_stations();
  bench.write_sm(0, 0, 0x1000, 8, kMailboxOutControl);
  std::uint8_t fmmu[kFmmuBytes] = {};
  put<std::uint32_t>(fmmu, 0x300);
  put<std::uint16_t>(fmmu + 4, 1);
  fmmu[6] = fmmu[7] = 2;  // bit 2 of the logical byte
  put<std::uint16_t>(fmmu + 8, kSmReg + 5);
  fmmu[10] = 3;  // bit 3 of the status
  fmmu[11] = kFmmuRead;
  fmmu[12] = 1;
  assert_int_equal(bench.send(Command::kFpwr, address_of(0x1001, kFmmuReg), fmmu, sizeof fmmu), 1);
  assert_int_equal(bench.send(Command::kLrd, 0x300, nullptr, 1), 1);
  assert_int_equal(bench.data[0], 0);
  std::uint8_t message[8] = {};
  bench.send(Command::kFpwr, address_of(0x1001, 0x1000), message, 8);
  assert_int_equal(bench.send(Command::kLrd, 0x300, nullptr, 1), 1);
  assert_int_equal(bench.data[0], 0x04);
}

}  // namespace
}  // namespace tactus::segment

int main() {
  using namespace tactus::segment;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_broadcast_counts_the_slaves_and_joins_what_they_read),
      cmocka_unit_test(a_position_addresses_one_slave_and_is_counted_up_by_all),
      cmocka_unit_test(reading_and_writing_counts_three),
      cmocka_unit_test(one_slave_reads_and_the_others_write),
      cmocka_unit_test(registers_of_the_controller_are_not_written),
      cmocka_unit_test(a_mailbox_takes_one_message_at_a_time_and_only_in_its_direction),
      cmocka_unit_test(an_enabled_sync_manager_keeps_its_place),
      cmocka_unit_test(logical_addresses_count_three_for_each_slave),
      cmocka_unit_test(inputs_of_a_missing_slave_are_the_bytes_that_were_sent),
      cmocka_unit_test(overlapping_areas_write_what_was_received),
      cmocka_unit_test(a_bit_of_a_register_is_mapped),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
