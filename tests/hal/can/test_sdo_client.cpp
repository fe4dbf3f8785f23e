// SDO transfers that succeed, byte for byte as in CiA 301, 7.2.4.3.
#include <cstring>

#include "tests/hal/can/sdo_bench.hpp"

namespace tactus::can {
namespace {

// Proves CAN-4.
// A trace of other implementations: master and slave of python-canopen.
void reading_the_device_type_is_the_known_trace(void**) {
  SdoBench bench;
  bench.ask_type();
  bench.expect_silence();
  bench.assert_progress(Progress::kBusy);
  bench.answer("581 43 00 10 00 92 01 02 00");
  bench.assert_progress(Progress::kDone);
  assert_int_equal(bench.client.value(), 0x00020192);
  assert_int_equal(bench.client.size(), 4);
  bench.expect_silence();
}

void writing_the_mode_is_the_known_trace(void**) {
  SdoBench bench;
  bench.write_mode();
  bench.answer("581 60 60 60 00 00 00 00 00");
  bench.assert_progress(Progress::kDone);
}

void one_to_four_bytes_are_written_in_one_frame(void**) {
  SdoBench bench;
  bench.client.download(127, 0x1017, 2, 0x44332211, 4, 0);
  bench.expect("67F 23 17 10 02 11 22 33 44");
  bench.answer("5FF 60 17 10 02 00 00 00 00");
  bench.client.download(127, 0x1017, 2, 0x332211, 3, 0);
  bench.expect("67F 27 17 10 02 11 22 33 00");
  bench.answer("5FF 60 17 10 02 00 00 00 00");
  bench.client.download(127, 0x1017, 2, 0x44332211, 2, 0);
  bench.expect("67F 2B 17 10 02 11 22 00 00");
  bench.answer("5FF 60 17 10 02 00 00 00 00");
  bench.assert_progress(Progress::kDone);
}

void one_to_four_bytes_are_read_from_one_frame(void**) {
  struct Row {
    const char* answer;
    std::size_t size;
    std::uint32_t value;
  };
  for (const Row& row :
       {Row{"583 4F 41 60 00 11 22 33 44", 1, 0x11}, Row{"583 4B 41 60 00 11 22 33 44", 2, 0x2211},
        Row{"583 47 41 60 00 11 22 33 44", 3, 0x332211},
        Row{"583 43 41 60 00 11 22 33 44", 4, 0x44332211},
        Row{"583 42 41 60 00 11 22 33 44", 4, 0x44332211},
        Row{"583 4E 41 60 00 11 22 33 44", 4, 0x44332211}}) {
    SdoBench bench;
    bench.client.upload(3, 0x6041, 0, 0);
    bench.expect("603 40 41 60 00 00 00 00 00");
    bench.answer(row.answer);
    bench.assert_progress(Progress::kDone);
    assert_int_equal(bench.client.size(), row.size);
    assert_int_equal(bench.client.value(), row.value);
  }
}

void bytes_of_an_earlier_object_are_forgotten(void**) {
  SdoBench bench;
  bench.client.upload(3, 0x6041, 0, 0);
  bench.expect("603 40 41 60 00 00 00 00 00");
  bench.answer("583 43 41 60 00 11 22 33 44");
  bench.client.upload(3, 0x6061, 0, 0);
  bench.expect("603 40 61 60 00 00 00 00 00");
  bench.answer("583 4F 61 60 00 0A 00 00 00");
  assert_int_equal(bench.client.value(), 10);
}

void a_text_is_read_in_segments(void**) {
  SdoBench bench;
  bench.ask_name();
  bench.answer("582 41 08 10 00 10 00 00 00");
  bench.expect("602 60 00 00 00 00 00 00 00");
  bench.answer("582 00 54 69 6E 79 20 4E 6F");
  bench.expect("602 70 00 00 00 00 00 00 00");
  bench.answer("582 10 64 65 20 2D 20 4D 65");
  bench.expect("602 60 00 00 00 00 00 00 00");
  bench.answer("582 0B 67 61 00 00 00 00 00");
  bench.assert_progress(Progress::kDone);
  assert_int_equal(bench.client.size(), 16);
  assert_memory_equal(bench.client.data(), "Tiny Node - Mega", 16);
  bench.expect_silence();
}

void a_text_is_read_without_its_size_too(void**) {
  SdoBench bench;
  bench.ask_name();
  bench.answer("582 40 08 10 00 00 00 00 00");
  bench.expect("602 60 00 00 00 00 00 00 00");
  bench.answer("582 09 41 42 43 00 00 00 00");
  bench.assert_progress(Progress::kDone);
  assert_int_equal(bench.client.size(), 3);
  assert_memory_equal(bench.client.data(), "ABC", 3);
}

void more_than_four_bytes_are_written_in_segments(void**) {
  SdoBench bench;
  bench.client.download_bytes(4, 0x2000, 1,
                              reinterpret_cast<const std::uint8_t*>("0123456789ABCDEF"), 16, 0);
  bench.expect("604 21 00 20 01 10 00 00 00");
  bench.answer("584 60 00 20 01 00 00 00 00");
  bench.expect("604 00 30 31 32 33 34 35 36");
  bench.answer("584 20 00 00 00 00 00 00 00");
  bench.expect("604 10 37 38 39 41 42 43 44");
  bench.answer("584 30 00 00 00 00 00 00 00");
  bench.expect("604 0B 45 46 00 00 00 00 00");
  bench.assert_progress(Progress::kBusy);
  bench.answer("584 20 00 00 00 00 00 00 00");
  bench.assert_progress(Progress::kDone);
  bench.expect_silence();
}

void fourteen_bytes_are_two_whole_segments(void**) {
  SdoBench bench;
  bench.write_fourteen_bytes();
  bench.answer("584 30 00 00 00 00 00 00 00");
  bench.assert_progress(Progress::kDone);
}

void an_empty_text_is_written_as_one_empty_segment(void**) {
  SdoBench bench;
  bench.client.download_bytes(4, 0x2000, 1, nullptr, 0, 0);
  bench.expect("604 21 00 20 01 00 00 00 00");
  bench.answer("584 60 00 20 01 00 00 00 00");
  bench.expect("604 0F 00 00 00 00 00 00 00");
  bench.answer("584 20 00 00 00 00 00 00 00");
  bench.assert_progress(Progress::kDone);
}

void an_object_as_long_as_the_buffer_is_read(void**) {
  SdoBench bench;
  bench.ask_name();
  bench.answer("582 41 08 10 00 80 00 00 00");
  bench.take_segments(18);
  bench.expect("602 60 00 00 00 00 00 00 00");
  bench.answer("582 0B 38 39 00 00 00 00 00");
  bench.assert_progress(Progress::kDone);
  assert_int_equal(bench.client.size(), 128);
  assert_int_equal(bench.client.data()[127], 0x39);
}

void frames_that_are_not_for_the_client_are_ignored(void**) {
  SdoBench bench;
  bench.answer("581 43 00 10 00 92 01 02 00");
  bench.assert_progress(Progress::kIdle);
  bench.client.upload(1, 0x1000, 0, 0);
  bench.answer("581 80 00 10 00 00 00 02 06");  // an answer of before the question
  bench.expect("601 40 00 10 00 00 00 00 00");
  for (const char* other : {"582 80 00 10 00 00 00 02 06", "601 80 00 10 00 00 00 02 06",
                            "181 80 00 10 00 00 00 02 06", "581 80 00 10 00 00 00 02"})
    bench.answer(other);
  CanFrame remote = SdoBench::frame_of("581 80 00 10 00 00 00 02 06");
  remote.remote = true;
  bench.client.receive(remote, 0);
  bench.assert_progress(Progress::kBusy);
  bench.answer("581 43 00 10 00 92 01 02 00");
  bench.assert_progress(Progress::kDone);
  bench.answer("581 80 00 10 00 00 00 02 06");
  bench.assert_progress(Progress::kDone);
}

/// A frame whose end one node did not see as the others did is sent again (ISO 11898-1).
void an_answer_that_the_bus_repeats_belongs_to_no_later_transfer(void**) {
  SdoBench bench;
  bench.ask_type();
  bench.answer("581 43 00 10 00 92 01 02 00");
  bench.assert_progress(Progress::kDone);
  bench.write_mode();
  bench.answer("581 43 00 10 00 92 01 02 00");
  bench.assert_progress(Progress::kBusy);
  bench.answer("581 60 60 60 00 00 00 00 00");
  bench.assert_progress(Progress::kDone);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(reading_the_device_type_is_the_known_trace),
      cmocka_unit_test(writing_the_mode_is_the_known_trace),
      cmocka_unit_test(one_to_four_bytes_are_written_in_one_frame),
      cmocka_unit_test(one_to_four_bytes_are_read_from_one_frame),
      cmocka_unit_test(bytes_of_an_earlier_object_are_forgotten),
      cmocka_unit_test(a_text_is_read_in_segments),
      cmocka_unit_test(a_text_is_read_without_its_size_too),
      cmocka_unit_test(more_than_four_bytes_are_written_in_segments),
      cmocka_unit_test(fourteen_bytes_are_two_whole_segments),
      cmocka_unit_test(an_empty_text_is_written_as_one_empty_segment),
      cmocka_unit_test(an_object_as_long_as_the_buffer_is_read),
      cmocka_unit_test(an_answer_that_the_bus_repeats_belongs_to_no_later_transfer),
      cmocka_unit_test(frames_that_are_not_for_the_client_are_ignored),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
