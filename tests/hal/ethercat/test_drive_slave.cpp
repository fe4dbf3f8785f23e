// The emulated drive behind the slave controller: AL states, mailbox, process data, watchdog.
#include "tests/hal/ethercat/segment_bench.hpp"

namespace tactus::segment {
namespace {

SegmentBench& fresh(int slaves = 1, int mailbox_bytes = 128) {
  static SegmentBench bench;
  bench.settings = {};
  bench.settings.slaves = slaves;
  bench.settings.places.fill(SmPlaces::with_mailboxes(mailbox_bytes, mailbox_bytes));
  bench.now_ns = 0;
  bench.load();
  return bench;
}

// Proves ECAT-3.
void states_are_entered_step_by_step(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  bench.set_process_data(0);
  bench.request(0, 4, 4);
  bench.request(0, 8, 4);  // waits for outputs
  const std::uint64_t outputs = 0;
  assert_int_equal(bench.send(Command::kFpwr, address_of(0x1001, 0x1200), &outputs, 8), 1);
  assert_int_equal(bench.read(0, kAlStatusReg, 2), 1);
  assert_int_equal(bench.word(), 8);
  bench.request(0, 2, 2);
  bench.request(0, 1, 1);
}

void wrong_requests_are_refused_with_a_code(void**) {
  SegmentBench& bench = fresh();
  bench.give_stations();
  bench.request(0, 2, 0x11, kAlMailboxSetup);
  bench.request(0, 1, 0x11, kAlMailboxSetup);  // not acknowledged
  bench.request(0, 0x11, 1);
  bench.request(0, 4, 0x11, kAlInvalidChange);
  bench.request(0, 0x11, 1);
  bench.request(0, 5, 0x11, kAlUnknownState);
  bench.request(0, 0x11, 1);
  bench.request(0, 3, 0x11, 0x0013);
  bench.request(0, 0x11, 1);
  bench.set_mailboxes(0);
  bench.request(0, 2, 2);
  bench.request(0, 4, 0x12, kAlOutputSetup);
  bench.request(0, 0x12, 2);
  bench.set_process_data(0, 8, 12);
  bench.request(0, 4, 0x12, kAlInputSetup);
  bench.request(0, 0x12, 2);
}

void operation_without_outputs_is_refused_in_time(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  bench.set_process_data(0);
  bench.request(0, 4, 4);
  bench.request(0, 8, 4);
  bench.now_ns += DriveSlave::kOutputs_ns + SegmentBench::kMs_ns;
  bench.line.advance(bench.now_ns);
  assert_int_equal(bench.read(0, kAlStatusReg, 6), 1);
  assert_int_equal(bench.word(), 0x14);
  assert_int_equal(get<std::uint16_t>(bench.data.data() + 4), kAlNoOutputs);
}

void outputs_that_stay_away_end_operation_with_a_fault(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  bench.set_process_data(0);
  bench.write<std::uint16_t>(0, kDataWatchdogReg, 50);  // 5 ms
  bench.request(0, 4, 4);
  const std::uint64_t outputs = 0;
  bench.send(Command::kFpwr, address_of(0x1001, 0x1200), &outputs, 8);
  bench.request(0, 8, 8);
  for (int i = 0; i < 10; ++i) {
    bench.now_ns += 4 * SegmentBench::kMs_ns;
    bench.send(Command::kFpwr, address_of(0x1001, 0x1200), &outputs, 8);
  }
  assert_int_equal(bench.read(0, kAlStatusReg, 2), 1);
  assert_int_equal(bench.word(), 8);
  bench.now_ns += 6 * SegmentBench::kMs_ns;
  bench.line.advance(bench.now_ns);
  assert_int_equal(bench.read(0, kAlStatusReg, 6), 1);
  assert_int_equal(bench.word(), 0x14);
  assert_int_equal(get<std::uint16_t>(bench.data.data() + 4), kAlWatchdog);
  assert_int_equal(bench.read(0, kWatchdogCounterReg, 1), 1);
  assert_int_equal(bench.data[0], 1);
  assert_int_equal(bench.sdo(0, 0x40, 0x603F, 0), 0x00);  // the emergency comes first
  assert_int_equal(get<std::uint16_t>(bench.data.data() + 6), kCoeEmergency << 12);
  assert_int_equal(bench.answer(0), 10);
  assert_int_equal(bench.sdo_value(), 0x8100);
}

// Proves ECAT-4.
/// The trace of the device type over CoE: header, service, then the bytes of CiA 301.
void the_device_type_is_read_byte_for_byte(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  const std::uint8_t request[] = {0x00, 0x20, 0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0};
  assert_int_equal(bench.mailbox(0, request, sizeof request), 10);
  const std::uint8_t expected[] = {0x0A, 0,    0,    0,    0,    0x13, 0x00, 0x30,
                                   0x43, 0x00, 0x10, 0x00, 0x92, 0x01, 0x02, 0x00};
  assert_memory_equal(bench.data.data(), expected, sizeof expected);
}

void objects_that_only_can_has_are_not_there(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  for (const unsigned index : {0x1005U, 0x1016U, 0x1200U, 0x1400U, 0x1800U}) {
    assert_int_equal(bench.sdo(0, 0x40, index, 1), can::kAbort);
    assert_int_equal(bench.sdo_value(), static_cast<int>(can::SdoAbort::kNoObject));
  }
  assert_int_equal(bench.sdo(0, 0x40, 0x1C00, 4), 0x4F);
  assert_int_equal(bench.sdo_value(), 4);
  assert_int_equal(bench.sdo(0, 0x40, 0x1018, 4), 0x43);
  assert_int_equal(bench.sdo_value(), 1001);
}

void pdos_are_changed_in_the_order_of_the_standard_and_only_in_preop(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  assert_int_equal(bench.sdo(0, 0x2F, 0x1600, 0, 0), can::kAbort);  // it is assigned
  assert_int_equal(bench.sdo(0, 0x2F, 0x1C12, 0, 0), 0x60);
  assert_int_equal(bench.sdo(0, 0x23, 0x1600, 1, 0x60400010), can::kAbort);  // it has entries
  assert_int_equal(bench.sdo(0, 0x2F, 0x1600, 0, 0), 0x60);
  assert_int_equal(bench.sdo(0, 0x23, 0x1600, 1, 0x60400010), 0x60);
  assert_int_equal(bench.sdo(0, 0x23, 0x1600, 2, 0x60410010), can::kAbort);  // of the other way
  assert_int_equal(bench.sdo(0, 0x23, 0x1600, 2, 0x607A0020), 0x60);
  assert_int_equal(bench.sdo(0, 0x2F, 0x1600, 0, 2), 0x60);
  assert_int_equal(bench.sdo(0, 0x2B, 0x1C12, 1, 0x1A00), can::kAbort);
  assert_int_equal(bench.sdo(0, 0x2B, 0x1C12, 1, 0x1600), 0x60);
  assert_int_equal(bench.sdo(0, 0x2F, 0x1C12, 0, 1), 0x60);
  bench.set_process_data(0, 6, 16);
  bench.request(0, 4, 4);
  assert_int_equal(bench.sdo(0, 0x2F, 0x1C12, 0, 0), can::kAbort);
  assert_int_equal(bench.sdo_value(), static_cast<int>(can::SdoAbort::kDeviceState));
}

void a_text_comes_whole_or_in_segments(void**) {
  constexpr const char* kName = "Tactus emulated servo drive";
  SegmentBench& bench = fresh();
  bench.to_preop();
  assert_int_equal(bench.sdo(0, 0x40, 0x1008, 0), 0x41);
  assert_int_equal(bench.sdo_value(), 27);
  assert_memory_equal(bench.data.data() + 16, kName, 27);
  SegmentBench& small = fresh(1, 28);
  small.to_preop();
  char text[28] = {};
  assert_int_equal(small.sdo(0, 0x40, 0x1008, 0), 0x41);
  std::memcpy(text, small.data.data() + 16, 12);
  const std::uint8_t first[] = {0x00, 0x20, 0x60, 0, 0, 0, 0, 0, 0, 0};
  assert_int_equal(small.mailbox(0, first, sizeof first), 2 + 1 + 15);
  assert_int_equal(small.data[8], 0x01);  // the last, no byte unused
  std::memcpy(text + 12, small.data.data() + 9, 15);
  assert_string_equal(text, kName);
  assert_int_equal(small.mailbox(0, first, sizeof first), 10);
  assert_int_equal(small.data[8], can::kAbort);
}

void a_write_in_segments_is_one_write(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  const std::uint8_t begin[] = {0x00, 0x20, 0x21, 0x80, 0x60, 0x00, 4, 0, 0, 0};
  const std::uint8_t first[] = {0x00, 0x20, 0x08, 20, 0, 0, 0, 0, 0, 0};  // 3 bytes
  const std::uint8_t second[] = {0x00, 0x20, 0x1D, 0, 0, 0, 0, 0, 0, 0};  // the last one
  assert_int_equal(bench.mailbox(0, begin, sizeof begin), 10);
  assert_int_equal(bench.data[8], 0x60);
  assert_int_equal(bench.mailbox(0, first, sizeof first), 10);
  assert_int_equal(bench.data[8], 0x20);
  assert_int_equal(bench.mailbox(0, second, sizeof second), 10);
  assert_int_equal(bench.data[8], 0x30);
  assert_int_equal(bench.sdo(0, 0x40, 0x6080, 0), 0x43);
  assert_int_equal(bench.sdo_value(), 20);
}

void what_is_no_coe_message_is_answered_as_an_error(void**) {
  SegmentBench& bench = fresh();
  bench.to_preop();
  struct Row {
    std::uint8_t length, type, service, code;
  };
  for (const Row& row : {Row{10, 0x14, 0x20, 0x02},      // FoE: unsupported protocol
                         Row{10, 0x03, 0x10, 0x04},      // an emergency: service not supported
                         Row{10, 0x03, 0x30, 0x04},      // an SDO answer
                         Row{10, 0x03, 0x00, 0x05},      // no service: invalid header
                         Row{10, 0x03, 0x90, 0x05},      //
                         Row{1, 0x03, 0x20, 0x06},       // too short
                         Row{9, 0x03, 0x20, 0x06},       //
                         Row{123, 0x03, 0x20, 0x08}}) {  // longer than the mailbox: invalid size
    std::array<std::uint8_t, 128> message{};
    message[0] = row.length;
    message[5] = row.type;
    message[7] = row.service;
    message[8] = 0x40;
    const std::uint32_t box = address_of(0x1001, 0x1000);
    assert_int_equal(bench.send(Command::kFpwr, box, message.data(), message.size()), 1);
    assert_int_equal(bench.answer(0), 4);
    assert_int_equal(bench.data[5] & 0x0F, 0);
    assert_int_equal(get<std::uint16_t>(bench.data.data() + 6), 1);
    assert_int_equal(get<std::uint16_t>(bench.data.data() + 8), row.code);
  }
}

}  // namespace
}  // namespace tactus::segment

int main() {
  using namespace tactus::segment;
  const CMUnitTest tests[] = {
      cmocka_unit_test(states_are_entered_step_by_step),
      cmocka_unit_test(wrong_requests_are_refused_with_a_code),
      cmocka_unit_test(operation_without_outputs_is_refused_in_time),
      cmocka_unit_test(outputs_that_stay_away_end_operation_with_a_fault),
      cmocka_unit_test(the_device_type_is_read_byte_for_byte),
      cmocka_unit_test(objects_that_only_can_has_are_not_there),
      cmocka_unit_test(pdos_are_changed_in_the_order_of_the_standard_and_only_in_preop),
      cmocka_unit_test(a_text_comes_whole_or_in_segments),
      cmocka_unit_test(a_write_in_segments_is_one_write),
      cmocka_unit_test(what_is_no_coe_message_is_answered_as_an_error),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
