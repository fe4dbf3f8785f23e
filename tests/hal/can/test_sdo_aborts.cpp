// SDO transfers that fail: aborts of the node, answers that break the protocol, silence.
#include <cstring>

#include "tests/hal/can/sdo_bench.hpp"

namespace tactus::can {
namespace {

// Proves CAN-4.
void an_abort_of_the_node_is_named_with_its_object(void**) {
  SdoBench bench;
  bench.client.download(3, 0x6060, 0, 99, 1, 0);
  bench.expect("603 2F 60 60 00 63 00 00 00");
  bench.answer("583 80 60 60 00 30 00 09 06");
  bench.assert_aborted(SdoAbort::kRange, "node 3: object 6060h:0: value out of range (06090030h)");
  bench.expect_silence();
}

void an_unknown_abort_code_is_shown(void**) {
  SdoBench bench;
  bench.client.upload(3, 0x1018, 4, 0);
  bench.expect("603 40 18 10 04 00 00 00 00");
  bench.answer("583 80 18 10 04 EF BE AD DE");
  bench.assert_aborted(static_cast<SdoAbort>(0xDEADBEEF),
                       "node 3: object 1018h:4: unknown abort code (DEADBEEFh)");
}

void silence_ends_a_transfer_with_an_abort(void**) {
  SdoBench bench;
  bench.client.upload(3, 0x1018, 1, 1000);
  bench.expect("603 40 18 10 01 00 00 00 00");
  bench.client.advance(1000 + 500 * SdoBench::kMs_ns - 1);
  bench.assert_progress(Progress::kBusy);
  bench.client.advance(1000 + 500 * SdoBench::kMs_ns);
  bench.expect("603 80 18 10 01 00 00 04 05");
  bench.assert_aborted(SdoAbort::kTimeout,
                       "node 3: object 1018h:1: no answer within 500 ms (05040000h)");
  bench.answer("583 43 18 10 01 01 00 00 00");
  bench.assert_progress(Progress::kAborted);
}

void every_answer_has_its_own_time(void**) {
  SdoBench bench;
  bench.ask_name();
  bench.now_ns = 400 * SdoBench::kMs_ns;
  bench.answer("582 41 08 10 00 03 00 00 00");
  bench.expect("602 60 00 00 00 00 00 00 00");
  bench.now_ns = 800 * SdoBench::kMs_ns;
  bench.answer("582 09 41 42 43 00 00 00 00");
  bench.assert_progress(Progress::kDone);
}

void the_whole_transfer_has_a_time_too(void**) {
  SdoBench bench;
  bench.client.set_times({500 * SdoBench::kMs_ns, 1000 * SdoBench::kMs_ns});
  bench.ask_name();
  bench.answer("582 40 08 10 00 00 00 00 00");
  for (int i = 0; i < 9; ++i) {  // segments without data, which would never end
    bench.now_ns += 100 * SdoBench::kMs_ns;
    bench.expect(i % 2 == 0 ? "602 60 00 00 00 00 00 00 00" : "602 70 00 00 00 00 00 00 00");
    bench.answer(i % 2 == 0 ? "582 0E 00 00 00 00 00 00 00" : "582 1E 00 00 00 00 00 00 00");
  }
  bench.assert_progress(Progress::kBusy);
  bench.expect("602 70 00 00 00 00 00 00 00");
  bench.client.advance(1000 * SdoBench::kMs_ns);
  bench.expect("602 80 08 10 00 00 00 04 05");
  bench.assert_aborted(SdoAbort::kTimeout,
                       "node 2: object 1008h:0: not complete within 1000 ms (05040000h)");
}

/// Begins to read 1008h of node 2, takes the answers, and asserts that the last is aborted.
struct Refusal {
  const char* first;
  const char* second;
  SdoAbort abort;
  const char* abort_frame;
  const char* meaning;
};
void assert_refused(const Refusal& row) {
  SdoBench bench;
  bench.ask_name();
  bench.answer(row.first);
  if (row.second != nullptr) {
    bench.expect("602 60 00 00 00 00 00 00 00");
    bench.answer(row.second);
  }
  bench.expect(row.abort_frame);
  bench.expect_silence();
  Message said;
  said << "node 2: object 1008h:0: the answer is wrong: " << row.meaning;
  bench.assert_aborted(row.abort, said);
}

void an_answer_that_breaks_the_protocol_is_aborted(void**) {
  constexpr Refusal kRows[] = {
      {"582 60 08 10 00 00 00 00 00", nullptr, SdoAbort::kCommand, "602 80 08 10 00 01 00 04 05",
       "unknown command (05040001h)"},
      {"582 C3 08 10 00 00 00 00 00", nullptr, SdoAbort::kCommand, "602 80 08 10 00 01 00 04 05",
       "unknown command (05040001h)"},
      {"582 41 08 10 00 81 00 00 00", nullptr, SdoAbort::kOutOfMemory,
       "602 80 08 10 00 05 00 04 05", "out of memory (05040005h)"},
      {"582 41 08 10 00 FF FF FF FF", nullptr, SdoAbort::kOutOfMemory,
       "602 80 08 10 00 05 00 04 05", "out of memory (05040005h)"},
      {"582 41 08 10 00 08 00 00 00", "582 10 00 00 00 00 00 00 00", SdoAbort::kToggle,
       "602 80 08 10 00 00 00 03 05", "toggle bit not alternated (05030000h)"},
      {"582 41 08 10 00 08 00 00 00", "582 20 00 00 00 00 00 00 00", SdoAbort::kCommand,
       "602 80 08 10 00 01 00 04 05", "unknown command (05040001h)"},
      {"582 41 08 10 00 06 00 00 00", "582 01 00 00 00 00 00 00 00", SdoAbort::kTooLong,
       "602 80 08 10 00 12 00 07 06", "too long (06070012h)"},
      {"582 41 08 10 00 08 00 00 00", "582 01 00 00 00 00 00 00 00", SdoAbort::kTooShort,
       "602 80 08 10 00 13 00 07 06", "too short (06070013h)"}};
  for (const Refusal& row : kRows) assert_refused(row);
}

void an_object_longer_than_the_buffer_is_aborted(void**) {
  SdoBench bench;
  bench.ask_name();
  bench.answer("582 40 08 10 00 00 00 00 00");
  bench.take_segments(19);
  bench.expect("602 80 08 10 00 05 00 04 05");
  bench.assert_progress(Progress::kAborted);
}

void answers_to_a_write_are_checked_likewise(void**) {
  SdoBench bench;
  bench.write_mode();
  bench.answer("581 40 60 60 00 00 00 00 00");
  bench.expect("601 80 60 60 00 01 00 04 05");
  bench.assert_progress(Progress::kAborted);
  bench.write_mode();
  bench.answer("581 43 60 60 00 00 00 00 00");
  bench.expect("601 80 60 60 00 01 00 04 05");
}

void acknowledged_segments_must_alternate(void**) {
  SdoBench bench;
  bench.write_fourteen_bytes();
  bench.answer("584 20 00 00 00 00 00 00 00");
  bench.expect("604 80 00 20 01 00 00 03 05");
  bench.assert_aborted(
      SdoAbort::kToggle,
      "node 4: object 2000h:1: the answer is wrong: toggle bit not alternated (05030000h)");
}

void what_does_not_fit_is_not_written(void**) {
  static constexpr std::uint8_t kLong[SdoClient::kCapacity + 1] = {};
  SdoBench bench;
  bench.client.download_bytes(4, 0x2000, 1, kLong, sizeof kLong, 0);
  bench.assert_aborted(SdoAbort::kTooLong,
                       "node 4: object 2000h:1: the value to write is too long (06070012h)");
  bench.expect_silence();
}

void a_transfer_that_is_given_up_is_aborted_before_the_next_begins(void**) {
  SdoBench bench;
  bench.ask_type();
  bench.client.upload(2, 0x1008, 0, 0);
  bench.expect("601 80 00 10 00 00 00 00 08");
  bench.expect("602 40 08 10 00 00 00 00 00");
  bench.answer("582 4F 08 10 00 41 00 00 00");
  bench.assert_progress(Progress::kDone);
}

/// Whatever it says: late answers, and those to another master, are no answers.
void answers_on_other_objects_are_ignored_until_the_time_is_over_which_names_them(void**) {
  constexpr const char* kOthers[] = {"581 43 18 10 01 92 01 02 00", "581 43 00 10 01 92 01 02 00",
                                     "581 60 00 10 02 00 00 00 00", "581 80 18 10 00 00 00 02 06",
                                     "581 00 54 69 6E 79 20 4E 6F", "581 20 00 00 00 00 00 00 00",
                                     "581 80 60 60 00 00 00 02 06"};
  SdoBench bench;
  bench.ask_type();
  for (const char* other : kOthers) bench.answer(other);
  bench.assert_progress(Progress::kBusy);
  bench.expect_silence();
  bench.answer("581 41 00 10 00 09 00 00 00");
  bench.expect("601 60 00 00 00 00 00 00 00");
  bench.answer("581 80 60 60 00 00 00 02 06");  // while segments travel
  bench.answer("581 43 60 60 00 00 00 02 06");
  bench.assert_progress(Progress::kBusy);
  bench.now_ns += 500 * SdoBench::kMs_ns;
  bench.answer("581 43 61 60 07 00 00 02 06");
  bench.assert_aborted(SdoAbort::kTimeout,
                       "node 1: object 1000h:0: no answer within 500 ms, but one on 6061h:7 "
                       "(05040000h)");
  bench.expect("601 80 00 10 00 00 00 04 05");
  bench.client.download(1, 0x6060, 0, 10, 1, bench.now_ns);
  bench.expect("601 2F 60 60 00 0A 00 00 00");
  for (const char* other : {"581 60 61 60 00 00 00 00 00", "581 80 00 10 00 00 00 02 06"})
    bench.answer(other);
  bench.assert_progress(Progress::kBusy);
  bench.answer("581 80 60 60 00 30 00 09 06");
  bench.assert_aborted(SdoAbort::kRange, "node 1: object 6060h:0: value out of range (06090030h)");
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_abort_of_the_node_is_named_with_its_object),
      cmocka_unit_test(an_unknown_abort_code_is_shown),
      cmocka_unit_test(silence_ends_a_transfer_with_an_abort),
      cmocka_unit_test(every_answer_has_its_own_time),
      cmocka_unit_test(the_whole_transfer_has_a_time_too),
      cmocka_unit_test(an_answer_that_breaks_the_protocol_is_aborted),
      cmocka_unit_test(an_object_longer_than_the_buffer_is_aborted),
      cmocka_unit_test(answers_to_a_write_are_checked_likewise),
      cmocka_unit_test(acknowledged_segments_must_alternate),
      cmocka_unit_test(what_does_not_fit_is_not_written),
      cmocka_unit_test(a_transfer_that_is_given_up_is_aborted_before_the_next_begins),
      cmocka_unit_test(
          answers_on_other_objects_are_ignored_until_the_time_is_over_which_names_them),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
