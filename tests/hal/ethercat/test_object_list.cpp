// SDO information of an emulated drive: what it tells of its objects is what SDO finds there.

#include <cstring>

#include "tests/hal/ethercat/segment_bench.hpp"

namespace tactus::segment {
namespace {

SegmentBench& fresh(int mailbox_bytes) {
  static SegmentBench bench;
  bench.settings = {};
  bench.settings.slaves = 1;
  bench.settings.places.fill(SmPlaces::with_mailboxes(mailbox_bytes, mailbox_bytes));
  bench.now_ns = 0;
  bench.load();
  bench.to_preop();
  return bench;
}

// The answers of a request, put together. Static, as a failed test leaves it.
std::array<std::uint8_t, 4096> answer;
std::size_t answer_bytes = 0;
int fragments = 0;

/// Sends a request of SDO information (ETG.1000.6, 5.6.3) and gathers the fragments of the answer;
/// each says how many are left. Returns its opcode.
int ask(SegmentBench& bench, std::uint8_t opcode, std::uint16_t index, std::uint8_t sub = 0) {
  const std::uint8_t request[] = {0,
                                  0x80,
                                  opcode,
                                  0,
                                  0,
                                  0,
                                  static_cast<std::uint8_t>(index),
                                  static_cast<std::uint8_t>(index >> 8),
                                  sub,
                                  0};
  answer_bytes = 0;
  fragments = 0;
  int length = bench.mailbox(0, request, sizeof request), left = -1;
  for (;; length = bench.answer(0)) {
    assert_true(length >= 6 && length + 6 <= bench.places(0).mailbox_in_bytes);
    const std::uint8_t* const head = bench.data.data() + 8;
    const int now_left = get<std::uint16_t>(head + 2);
    assert_int_equal(bench.data[7], 0x80);
    if (left >= 0) assert_int_equal(now_left, left - 1);
    assert_int_equal(head[0] >> 7, now_left > 0);
    const auto bytes = static_cast<std::size_t>(length - 6);
    std::memcpy(answer.data() + answer_bytes, head + 4, bytes);
    answer_bytes += bytes;
    ++fragments;
    left = now_left;
    if (left == 0) return head[0] & 0x7F;
  }
}
bool is_listed(std::uint16_t index) {
  bool listed = false;
  for (std::size_t at = 2; at + 2 <= answer_bytes; at += 2)
    listed = listed || get<std::uint16_t>(answer.data() + at) == index;
  return listed;
}
/// The bits of an object that SDO reads; -1: there is none.
int bits_of(SegmentBench& bench, unsigned index, unsigned sub) {
  const int command = bench.sdo(0, 0x40, index, sub);
  if (command == 0x80) return -1;
  if ((command & 2) == 0) return 8 * static_cast<int>(bench.sdo_value());
  return 8 * (4 - (command >> 2 & 3));
}

// Proves ECAT-19.
void the_list_has_all_objects_that_sdo_finds_and_no_other(void**) {
  for (const int mailbox : {16, 17, 64, 128, 1486}) {
    SegmentBench& bench = fresh(mailbox);
    assert_int_equal(ask(bench, 1, 1), 2);
    assert_int_equal(get<std::uint16_t>(answer.data()), 1);
    assert_true(mailbox == 1486 ? fragments == 1 : fragments > 1);
    const auto count = static_cast<int>(answer_bytes / 2 - 1);
    int found = 0;
    for (unsigned index = 0x1000; index < 0x7000; ++index) {
      const bool listed = is_listed(static_cast<std::uint16_t>(index));
      bool there = bits_of(bench, index, 0) >= 0;
      if (!there) there = bench.sdo_value() != 0x06020000;
      if (listed != there) print_error("%04Xh\n", index);
      assert_int_equal(listed, there);
      found += there;
    }
    assert_int_equal(found, count);
    assert_int_equal(ask(bench, 1, 0), 2);  // the lengths of the lists
    assert_int_equal(answer_bytes, 12);
    assert_int_equal(get<std::uint16_t>(answer.data() + 2), count);
  }
}

/// Also that an entry is mapped which the drive says can be mapped, and no other.
void entries_are_described_as_sdo_reads_and_maps_them(void**) {
  SegmentBench& bench = fresh(1486);
  assert_int_equal(ask(bench, 1, 1), 2);
  static std::array<std::uint8_t, 4096> list;
  list = answer;
  const std::size_t bytes = answer_bytes;
  assert_int_equal(bench.sdo(0, 0x2F, 0x1C12, 0, 0), 0x60);
  for (std::size_t at = 2; at < bytes; at += 2) {
    const auto index = get<std::uint16_t>(list.data() + at);
    assert_int_equal(ask(bench, 3, index), 4);
    assert_int_equal(get<std::uint16_t>(answer.data()), index);
    const unsigned last = answer[4];
    assert_int_equal(bits_of(bench, index, last + 1), -1);
    for (unsigned sub = 0; sub <= last; ++sub) {
      const int bits = bits_of(bench, index, sub);
      const bool there = bits >= 0 || bench.sdo_value() != 0x06090011;  // it may have no data yet
      assert_int_equal(ask(bench, 5, index, static_cast<std::uint8_t>(sub)), there ? 6 : 7);
      if (bits < 0) continue;
      assert_int_equal(answer[2], sub);
      assert_int_equal(get<std::uint16_t>(answer.data() + 6), bits);
      const bool mappable = (get<std::uint16_t>(answer.data() + 8) & 0x40) != 0;
      const std::uint32_t entry =
          std::uint32_t{index} << 16 | sub << 8 | static_cast<std::uint32_t>(bits);
      assert_int_equal(bench.sdo(0, 0x2F, 0x1600, 0, 0), 0x60);
      assert_int_equal(bench.sdo(0, 0x23, 0x1600, 1, entry), mappable ? 0x60 : 0x80);
    }
  }
}

void what_is_not_there_is_told_with_its_abort_code(void**) {
  SegmentBench& bench = fresh(128);
  assert_int_equal(ask(bench, 3, 0x1400), 7);
  assert_int_equal(get<std::uint32_t>(answer.data()), 0x06020000);
  assert_int_equal(ask(bench, 5, 0x1018, 9), 7);
  assert_int_equal(get<std::uint32_t>(answer.data()), 0x06090011);
  assert_int_equal(ask(bench, 1, 6), 7);
  assert_int_equal(ask(bench, 9, 1), 7);
  const std::uint8_t brief[] = {0, 0x80, 1, 0};
  assert_true(bench.mailbox(0, brief, sizeof brief) > 0);
  assert_int_equal(bench.data[8], 7);
}

}  // namespace
}  // namespace tactus::segment

int main() {
  using namespace tactus::segment;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_list_has_all_objects_that_sdo_finds_and_no_other),
      cmocka_unit_test(entries_are_described_as_sdo_reads_and_maps_them),
      cmocka_unit_test(what_is_not_there_is_told_with_its_abort_code),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
