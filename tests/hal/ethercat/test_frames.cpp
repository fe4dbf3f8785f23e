// Frames and datagrams against bytes that Scapy composed: tests/hal/ethercat/compose_frames prints
// them.
#include <cstring>
#include <random>

#include "tests/hal/ethercat/hex_frame.hpp"
#include "tests/support/testing.hpp"

namespace tactus::ethercat {
namespace {

constexpr const char* kCyclic =
    "ffffffffffff02000000000188a44e100c0c000001002e800000000102030405060708090a0b0c0d0e0f1011121314"
    "15161718191a1b1c1d1e1f202122232425262728292a2b2c2d00000e0c01101009080000000000000000000000"
    "0000";
constexpr const char* kOneByte =
    "ffffffffffff02000000000188a40d10070100000000010000000000000000000000000000000000000000000000"
    "0000000000000000000000000000";
constexpr const char* kManyCommands =
    "ffffffffffff02000000000188a480100101feff300102800000010200000202ffff10000280000034120000040302"
    "1002050a800000000000000000000000000000050403100008088000000909090909090909000008050000200102"
    "800000110000000a06785634120380000000000000000b07f0ffffff018000000700000d08000010090400000000"
    "0000000000";

void assert_same(const Frame& frame, const char* digits) {
  const Frame expected = frame_of(digits);
  assert_int_equal(frame.size, expected.size);
  assert_memory_equal(frame.bytes.data(), expected.bytes.data(), expected.size);
}

// Proves ECAT-1.
void a_cyclic_frame_is_the_one_of_scapy(void**) {
  Frame frame;
  FrameWriter writer(frame, kSender);
  std::uint8_t* const image = writer.add(Command::kLrw, 0x0C, 0x10000, 46);
  for (int i = 0; i < 46; ++i) image[i] = static_cast<std::uint8_t>(i);
  assert_non_null(writer.add(Command::kFrmw, 0x0C, address_of(0x1001, 0x910), 8));
  writer.pad();
  assert_same(frame, kCyclic);
}

void a_short_frame_is_padded_and_keeps_its_length(void**) {
  Frame frame;
  FrameWriter writer(frame, kSender);
  assert_non_null(writer.add(Command::kBrd, 1, 0, 1));
  writer.pad();
  assert_same(frame, kOneByte);
}

void every_way_of_addressing_is_the_one_of_scapy(void**) {
  Frame frame;
  FrameWriter writer(frame, kSender);
  std::uint8_t* at = writer.add(Command::kAprd, 1, address_of(position_field(2), 0x130), 2);
  put<std::uint16_t>(at, 0x0201);
  put<std::uint16_t>(writer.add(Command::kApwr, 2, address_of(position_field(1), 0x10), 2), 0x1234);
  writer.add(Command::kFprd, 3, address_of(0x1002, 0x502), 10);
  std::memset(writer.add(Command::kFpwr, 4, address_of(0x1003, 0x800), 8), 9, 8);
  put<std::uint16_t>(writer.add(Command::kBwr, 5, address_of(0, 0x120), 2), 0x11);
  writer.add(Command::kLrd, 6, 0x12345678, 3);
  *writer.add(Command::kLwr, 7, 0xFFFFFFF0, 1) = 7;
  writer.add(Command::kArmw, 8, address_of(0, 0x910), 4);
  writer.pad();
  assert_same(frame, kManyCommands);
}

void datagrams_of_scapy_are_found_in_their_order(void**) {
  Frame frame = frame_of(kManyCommands);
  FrameReader reader(frame);
  Datagram datagram;
  constexpr std::size_t kSizes[] = {2, 2, 10, 8, 2, 3, 1, 4};
  for (std::size_t i = 0; i < 8; ++i) {
    assert_true(reader.next(datagram));
    assert_int_equal(datagram.index, i + 1);
    assert_int_equal(datagram.size, kSizes[i]);
    assert_int_equal(datagram.counter(), 0);
    if (i == 0) assert_int_equal(datagram.position(), 0xFFFE);
    if (i == 3) assert_int_equal(datagram.reg(), 0x800);
    if (i == 5) assert_int_equal(datagram.logical(), 0x12345678);
  }
  assert_false(reader.next(datagram));
  assert_true(reader.whole());
}

void the_padding_of_ethernet_is_no_datagram(void**) {
  Frame frame = frame_of(kOneByte);
  FrameReader reader(frame);
  Datagram datagram;
  assert_true(reader.next(datagram));
  assert_false(reader.next(datagram));
  assert_true(reader.whole());
}

void a_frame_without_padding_is_whole(void**) {
  Frame frame = frame_of(kOneByte);
  frame.size = 29;
  FrameReader reader(frame);
  Datagram datagram;
  assert_true(reader.next(datagram));
  assert_false(reader.next(datagram));
  assert_true(reader.whole());
}

/// Changes a frame and counts the datagrams that are still found.
int found(Frame frame, std::size_t at, std::uint8_t value, bool& whole) {
  frame.bytes[at] = value;
  FrameReader reader(frame);
  Datagram datagram;
  int count = 0;
  while (reader.next(datagram)) ++count;
  whole = reader.whole();
  return count;
}

void a_frame_that_is_not_whole_is_known(void**) {
  bool whole = true;
  const Frame frame = frame_of(kManyCommands);
  assert_int_equal(found(frame, 12, 0x08, whole), 0);  // another EtherType
  assert_false(whole);
  assert_int_equal(found(frame, 15, 0x20, whole), 0);  // another type of EtherCAT
  assert_false(whole);
  assert_int_equal(found(frame, 14, 0x90, whole), 0);  // longer than the Ethernet frame
  assert_false(whole);
  assert_int_equal(found(frame, 14, 0x40, whole), 3);  // shorter than its datagrams
  assert_false(whole);
  assert_int_equal(found(frame, 16 + 7, 0x00, whole), 1);  // "no more" before the last
  assert_false(whole);
  assert_int_equal(found(frame, 16 + 6, 0xFF, whole), 0);  // a datagram longer than the frame
  assert_false(whole);
}

void no_more_datagrams_than_fit_are_written(void**) {
  Frame frame;
  FrameWriter writer(frame, kSender);
  for (std::size_t i = 0; i < kMaxDatagrams; ++i)
    assert_non_null(writer.add(Command::kNop, 0, 0, 4));
  assert_null(writer.add(Command::kNop, 0, 0, 4));
  Frame full;
  FrameWriter filler(full, kSender);
  assert_non_null(filler.add(Command::kLrw, 0, 0, 1486));
  assert_int_equal(full.size, kMaxFrame);
  assert_null(filler.add(Command::kNop, 0, 0, 0));
}

/// With sanitizers: no byte outside of the frame is touched.
void random_bytes_are_read_within_the_frame(void**) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    Frame frame = frame_of(kManyCommands);
    for (int n = 0; n < 4; ++n)
      frame.bytes[12 + random() % (frame.size - 12)] = static_cast<std::uint8_t>(random());
    FrameReader reader(frame);
    Datagram datagram;
    while (reader.next(datagram)) {
      assert_true(datagram.header >= frame.bytes.data() + kFirstDatagram);
      assert_true(datagram.data + datagram.size + kCounterBytes <= frame.bytes.data() + frame.size);
    }
  }
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_cyclic_frame_is_the_one_of_scapy),
      cmocka_unit_test(a_short_frame_is_padded_and_keeps_its_length),
      cmocka_unit_test(every_way_of_addressing_is_the_one_of_scapy),
      cmocka_unit_test(datagrams_of_scapy_are_found_in_their_order),
      cmocka_unit_test(the_padding_of_ethernet_is_no_datagram),
      cmocka_unit_test(a_frame_without_padding_is_whole),
      cmocka_unit_test(a_frame_that_is_not_whole_is_known),
      cmocka_unit_test(no_more_datagrams_than_fit_are_written),
      cmocka_unit_test(random_bytes_are_read_within_the_frame),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
