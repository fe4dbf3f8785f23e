// SDO over CoE as the master does it: known messages, and a drive's server with small mailboxes.
#include <cstring>
#include <string>

#include "hal/ethercat/coe_client.hpp"
#include "sim_plant/ethercat/coe_server.hpp"
#include "tests/support/testing.hpp"

namespace tactus::ethercat {
namespace {

using can::SdoAbort;
using Progress = CoeClient::Progress;

constexpr std::size_t kBox = 64;

struct Bench {
  CoeClient client;
  std::array<std::uint8_t, kBox> box{};
  can::Emergency emergency;
  std::uint8_t counter = 0;

  void expect(const std::uint8_t* bytes, std::size_t size) {
    assert_true(client.take(box.data(), box.size(), counter));
    assert_memory_equal(box.data(), bytes, size);
    for (std::size_t i = size; i < box.size(); ++i) assert_int_equal(box[i], 0);
  }
  bool answer(const std::uint8_t* bytes, std::size_t size) {
    box.fill(0);
    std::memcpy(box.data(), bytes, size);
    return client.receive(box.data(), box.size(), emergency, 0);
  }
};

// Proves ECAT-11.
void reading_the_device_type_is_the_known_message(void**) {
  Bench bench;
  bench.client.upload(kBox, 0x1000, 0, 0);
  const std::uint8_t request[] = {10, 0, 0, 0, 0, 0x13, 0, 0x20, 0x40, 0, 0x10, 0, 0, 0, 0, 0};
  bench.expect(request, sizeof request);
  const std::uint8_t answer[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x43, 0, 0x10, 0, 0x92, 0x01, 2, 0};
  assert_false(bench.answer(answer, sizeof answer));
  assert_true(bench.client.progress() == Progress::kDone);
  assert_int_equal(bench.client.value(), 0x00020192);
}

void one_to_four_bytes_are_written_in_one_message(void**) {
  constexpr std::uint8_t kCommands[] = {0x2F, 0x2B, 0x27, 0x23};
  for (std::uint8_t bytes = 1; bytes <= 4; ++bytes) {
    Bench bench;
    bench.client.download(kBox, 0x6060, 5, 0x44332211, bytes, 0);
    std::uint8_t request[] = {10, 0, 0, 0, 0, 0x13, 0, 0x20, 0, 0x60, 0x60, 5, 0, 0, 0, 0};
    request[8] = kCommands[bytes - 1];
    for (std::uint8_t i = 0; i < bytes; ++i)
      request[12 + i] = static_cast<std::uint8_t>(0x11 * (i + 1));
    bench.expect(request, sizeof request);
    const std::uint8_t answer[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x60, 0x60, 0x60, 5, 0, 0, 0, 0};
    bench.answer(answer, sizeof answer);
    assert_true(bench.client.progress() == Progress::kDone);
  }
}

void an_abort_of_the_drive_ends_the_transfer_with_its_code(void**) {
  Bench bench;
  bench.client.upload(kBox, 0x1234, 1, 0);
  (void)bench.client.take(bench.box.data(), kBox, bench.counter);
  const std::uint8_t other[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x80, 0x35, 0x12, 1, 0, 0, 2, 6};
  bench.answer(other, sizeof other);  // on another object
  assert_true(bench.client.progress() == Progress::kBusy);
  const std::uint8_t answer[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x80, 0x34, 0x12, 1, 0, 0, 2, 6};
  bench.answer(answer, sizeof answer);
  assert_true(bench.client.progress() == Progress::kAborted);
  assert_string_equal(bench.client.describe().c_str(),
                      "object 1234h:1: the object does not exist (06020000h)");
}

/// A refusal of this program does not pass for one of the drive.
void an_object_that_is_too_large_is_refused_by_us(void**) {
  Bench bench;
  bench.client.upload(kBox, 0x1008, 0, 0);
  (void)bench.client.take(bench.box.data(), kBox, bench.counter);
  const std::uint8_t answer[] = {10,   0,    0,    0, 0,    0x13, 0,    0x30,
                                 0x41, 0x08, 0x10, 0, 0x40, 0x42, 0x0F, 0};
  bench.answer(answer, sizeof answer);
  assert_string_equal(bench.client.describe().c_str(),
                      "object 1008h:0: it has 1000000 bytes, and this program takes at most 128");
}

/// No abort of the drive: its mailbox has not passed the request on. The codes are those of the
/// error reply in ETG.1000.4, which names them MBXERR_SYNTAX to MBXERR_INVALIDSIZE.
void an_error_of_the_mailbox_is_told_as_that(void**) {
  struct Row {
    std::uint8_t code;
    const char* says;
  };
  for (const Row& row :
       {Row{1, "wrong syntax of the header (error 0001h of ETG.1000.4)"},
        Row{2, "unsupported protocol (error 0002h of ETG.1000.4)"},
        Row{3, "wrong channel (error 0003h of ETG.1000.4)"},
        Row{4, "unsupported service (error 0004h of ETG.1000.4)"},
        Row{5, "invalid header (error 0005h of ETG.1000.4)"},
        Row{6, "too short (error 0006h of ETG.1000.4)"},
        Row{7, "no memory (error 0007h of ETG.1000.4)"},
        Row{8, "inconsistent length (error 0008h of ETG.1000.4)"},
        Row{9, "a code that the standard does not have (error 0009h of ETG.1000.4)"}}) {
    Bench bench;
    bench.client.upload(kBox, 0x1000, 0, 0);
    (void)bench.client.take(bench.box.data(), kBox, bench.counter);
    const std::uint8_t error[] = {4, 0, 0, 0, 0, 0x10, 1, 0, row.code, 0};
    bench.answer(error, sizeof error);
    assert_true(bench.client.progress() == CoeClient::Progress::kAborted);
    const std::string expected =
        std::string("object 1000h:0: the slave's mailbox refuses the request: ") + row.says;
    assert_string_equal(bench.client.describe().c_str(), expected.c_str());
  }
}

/// Of a message in a longer mailbox no byte is read beyond those that are kept, whatever it says of
/// its length.
void a_message_that_fills_a_long_mailbox_is_taken_out_of_its_first_bytes(void**) {
  constexpr std::size_t kLong = 1486;
  constexpr std::uint8_t kLengthLow = 0xC8, kLengthHigh = 5;  // 1480
  std::array<std::uint8_t, CoeClient::kMostMessage> kept{};
  std::uint8_t counter = 0;
  can::Emergency emergency;
  const auto answer = [&](CoeClient& client, const std::uint8_t* bytes, std::size_t size) {
    kept.fill(0xA5);
    std::memcpy(kept.data(), bytes, size);
    (void)client.receive(kept.data(), kLong, emergency, 0);
  };
  for (const std::uint8_t size : {std::uint8_t{100}, std::uint8_t{128}, std::uint8_t{129}}) {
    CoeClient client;
    client.upload(kLong, 0x1008, 0, 0);
    (void)client.take(kept.data(), kept.size(), counter);
    const std::uint8_t whole[] = {kLengthLow, kLengthHigh, 0,    0,    0,    0x13, 0, 0x30,
                                  0x41,       0x08,        0x10, 0x00, size, 0,    0, 0};
    answer(client, whole, sizeof whole);
    assert_true(client.progress() == (size <= 128 ? Progress::kDone : Progress::kAborted));
    for (std::size_t i = 0; i < size && size <= 128; ++i) assert_int_equal(client.data()[i], 0xA5);
  }
  CoeClient client;
  client.upload(kLong, 0x1008, 0, 0);
  (void)client.take(kept.data(), kept.size(), counter);
  const std::uint8_t begun[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x41, 0x08, 0x10, 0, 128, 0, 0, 0};
  answer(client, begun, sizeof begun);
  assert_true(client.take(kept.data(), kept.size(), counter));
  const std::uint8_t segment[] = {kLengthLow, kLengthHigh, 0, 0, 0, 0x13, 0, 0x30, 0x01};
  answer(client, segment, sizeof segment);
  assert_true(client.abort() == SdoAbort::kTooLong);
}

void messages_that_are_no_answer_are_told_with_their_number(void**) {
  Bench bench;
  bench.client.set_time(1'000'000'000);
  bench.client.upload(kBox, 0x1000, 0, 0);
  (void)bench.client.take(bench.box.data(), kBox, bench.counter);
  const std::uint8_t other[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x43, 0, 0x11, 0, 0, 0, 0, 0};
  const std::uint8_t longer[] = {0xFF, 0, 0, 0, 0, 0x13, 0, 0x30, 0x43, 0, 0x10, 0, 0, 0, 0, 0};
  bench.answer(other, sizeof other);
  bench.answer(longer, sizeof longer);
  bench.client.advance(1'000'000'001);
  assert_string_equal(
      bench.client.describe().c_str(),
      "object 1000h:0: no answer within 1000 ms, but 2 messages that are none; of the "
      "last, its length does not fit into the mailbox (05040000h)");
}

void an_emergency_is_no_answer(void**) {
  Bench bench;
  bench.client.upload(kBox, 0x1000, 0, 0);
  (void)bench.client.take(bench.box.data(), kBox, bench.counter);
  const std::uint8_t message[] = {10, 0, 0, 0, 0, 0x13, 0, 0x10, 0x10, 0x43, 0x09, 0, 0, 0, 0, 0};
  assert_true(bench.answer(message, sizeof message));
  assert_int_equal(bench.emergency.code, 0x4310);
  assert_int_equal(bench.emergency.error_register, 9);
  assert_true(bench.client.progress() == Progress::kBusy);
}

void a_silent_drive_ends_the_transfer_in_time(void**) {
  Bench bench;
  bench.client.set_time(1000);
  bench.client.upload(kBox, 0x1000, 0, 0);
  bench.client.advance(1000);
  assert_true(bench.client.progress() == Progress::kBusy);
  bench.client.advance(1001);
  assert_true(bench.client.abort() == SdoAbort::kTimeout);
}

void answers_that_break_the_protocol_end_the_transfer(void**) {
  const std::uint8_t first[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x41, 0x08, 0x10, 0, 20, 0, 0, 0};
  struct Row {
    std::uint8_t command;
    SdoAbort abort;
  };
  for (const Row& row : {Row{0x10, SdoAbort::kToggle}, Row{0x60, SdoAbort::kCommand},
                         Row{0x01, SdoAbort::kTooShort}, Row{0x0E, SdoAbort::kTooShort}}) {
    Bench bench;
    bench.client.upload(kBox, 0x1008, 0, 0);
    (void)bench.client.take(bench.box.data(), kBox, bench.counter);
    bench.answer(first, sizeof first);
    assert_true(bench.client.take(bench.box.data(), kBox, bench.counter));
    std::uint8_t segment[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0, 1, 2, 3, 4, 5, 6, 7};
    segment[8] = row.command;
    bench.answer(segment, sizeof segment);
    assert_true(bench.client.progress() == Progress::kAborted);
    assert_true(bench.client.abort() == row.abort);
  }
}

/// Client and server with mailboxes of every length.
void transfers_are_the_same_through_mailboxes_of_every_length(void**) {
  static drives::Dictionary dictionary;
  static segment::CoeObjects objects(dictionary);
  static segment::CoeServer server(objects);
  dictionary.reset(1);
  objects.reset();
  for (std::size_t room = 16; room <= kBox; ++room) {
    for (const bool writes : {false, true}) {
      server.reset(room);
      Bench bench;
      const std::uint8_t speed[] = {static_cast<std::uint8_t>(room), 0, 0, 0, 0};
      if (writes)
        bench.client.download_bytes(room, 0x6080, 0, speed, 4, 0);
      else
        bench.client.upload(room, 0x1008, 0, 0);
      for (int n = 0; n < 100 && bench.client.progress() == Progress::kBusy; ++n) {
        if (bench.client.take(bench.box.data(), room, bench.counter))
          (void)server.receive(bench.box.data(), room, true, false);
        segment::MailboxMessage answer;
        while (server.take(answer)) {
          assert_true(answer.size <= room);
          (void)bench.client.receive(answer.bytes.data(), room, bench.emergency, 0);
        }
      }
      assert_true(bench.client.progress() == Progress::kDone);
      if (!writes) {
        assert_int_equal(bench.client.size(), 27);
        assert_memory_equal(bench.client.data(), "Tactus emulated servo drive", 27);
      } else {
        assert_int_equal(dictionary.get(drives::slot_of(0x6080)), room);
      }
    }
  }
}

/// No object of the drive is longer than four bytes and writable: the messages themselves.
void a_long_write_goes_in_segments(void**) {
  Bench bench;
  std::uint8_t bytes[30];
  for (std::uint8_t i = 0; i < sizeof bytes; ++i) bytes[i] = i;
  bench.client.download_bytes(24, 0x2000, 1, bytes, sizeof bytes, 0);
  const std::uint8_t begin[] = {18, 0, 0, 0, 0, 0x13, 0, 0x20, 0x21, 0, 0x20, 1,
                                30, 0, 0, 0, 0, 1,    2, 3,    4,    5, 6,    7};
  assert_true(bench.client.take(bench.box.data(), 24, bench.counter));
  assert_memory_equal(bench.box.data(), begin, sizeof begin);
  const std::uint8_t begun[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x60, 0, 0x20, 1, 0, 0, 0, 0};
  bench.answer(begun, sizeof begun);
  assert_true(bench.client.take(bench.box.data(), 24, bench.counter));
  assert_int_equal(bench.box[0], 18);
  assert_int_equal(bench.box[8], 0x00);
  assert_memory_equal(bench.box.data() + 9, bytes + 8, 15);
  const std::uint8_t first[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x20, 0, 0, 0, 0, 0, 0, 0};
  bench.answer(first, sizeof first);
  assert_true(bench.client.take(bench.box.data(), 24, bench.counter));
  assert_int_equal(bench.box[0], 10);
  assert_int_equal(bench.box[8], 0x11);  // toggled, 7 bytes, the last
  assert_memory_equal(bench.box.data() + 9, bytes + 23, 7);
  const std::uint8_t last[] = {10, 0, 0, 0, 0, 0x13, 0, 0x30, 0x30, 0, 0, 0, 0, 0, 0, 0};
  bench.answer(last, sizeof last);
  assert_true(bench.client.progress() == Progress::kDone);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(reading_the_device_type_is_the_known_message),
      cmocka_unit_test(one_to_four_bytes_are_written_in_one_message),
      cmocka_unit_test(an_abort_of_the_drive_ends_the_transfer_with_its_code),
      cmocka_unit_test(an_object_that_is_too_large_is_refused_by_us),
      cmocka_unit_test(an_error_of_the_mailbox_is_told_as_that),
      cmocka_unit_test(a_message_that_fills_a_long_mailbox_is_taken_out_of_its_first_bytes),
      cmocka_unit_test(messages_that_are_no_answer_are_told_with_their_number),
      cmocka_unit_test(an_emergency_is_no_answer),
      cmocka_unit_test(a_silent_drive_ends_the_transfer_in_time),
      cmocka_unit_test(answers_that_break_the_protocol_end_the_transfer),
      cmocka_unit_test(transfers_are_the_same_through_mailboxes_of_every_length),
      cmocka_unit_test(a_long_write_goes_in_segments),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
