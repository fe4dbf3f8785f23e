// The emulated slave controller: EEPROM and clock.
#include "tests/hal/ethercat/segment_bench.hpp"

namespace tactus::segment {
namespace {

// Proves ECAT-2.
/// Masters ask in two ways: 6 bytes at 0502h and the data apart, or 4 bytes and all together.
void the_eeprom_is_read_in_both_usual_ways(void**) {
  SegmentBench& bench = fresh_segment(3);
  bench.give_stations();
  std::uint8_t request[6] = {};
  put<std::uint16_t>(request, kEepromRead);
  put<std::uint32_t>(request + 2, kSiiVendor);
  const std::uint32_t at = address_of(0x1002, kEepromControlReg);
  assert_int_equal(bench.send(Command::kFpwr, at, request, 6), 1);
  assert_int_equal(bench.read(1, kEepromControlReg, 2), 1);
  assert_int_equal(bench.word() & kEepromBusy, 0);
  assert_int_equal(bench.read(1, kEepromDataReg, 8), 1);
  assert_int_equal(bench.dword(), 0x5443);
  assert_int_equal(get<std::uint32_t>(bench.data.data() + 4), 402);
  put<std::uint32_t>(request + 2, kSiiSerial);
  assert_int_equal(bench.send(Command::kFpwr, at, request, 4), 1);
  assert_int_equal(bench.read(1, kEepromControlReg, 10), 1);
  assert_int_equal(get<std::uint32_t>(bench.data.data() + 6), 1002);
}

/// ETG.1000.6: CRC-8 of the first 14 bytes, polynomial 07h.
void the_checksum_of_the_eeprom_is_right(void**) {
  SiiImage image;
  image.compose({1, 2, 3, 4}, {});
  unsigned crc = 0xFF;
  for (unsigned i = 0; i < 112; ++i) {
    const unsigned bit = image.word(i / 16) >> (i % 16 / 8 * 8 + 7 - i % 8) & 1U;
    const unsigned top = crc >> 7 & 1U;
    crc = (crc << 1 & 0xFFU) ^ (top != bit ? 0x07U : 0U);
  }
  assert_int_equal(image.word(kSiiChecksum), crc);
}

void clocks_follow_the_reference_clock(void**) {
  SegmentBench& bench = fresh_segment(3);
  bench.settings.drift_ppb = 50'000;
  bench.load();
  bench.give_stations();
  std::int64_t local[3];
  const std::uint32_t latch = 0;
  bench.send(Command::kBwr, address_of(0, kPortTimesReg), &latch, 4);
  for (int i = 0; i < 3; ++i) {
    bench.read(i, kUnitTimeReg, 8);
    local[i] = get<std::int64_t>(bench.data.data());
  }
  for (int i = 0; i < 3; ++i) bench.write<std::int64_t>(i, kTimeOffsetReg, local[0] - local[i]);
  for (int n = 0; n < 3000; ++n) {
    bench.now_ns += SegmentBench::kMs_ns;
    bench.send(Command::kFrmw, address_of(0x1001, kSystemTimeReg), nullptr, 8);
  }
  std::int64_t times[3];
  const std::int64_t before_ns = bench.now_ns;
  for (int i = 0; i < 3; ++i) {
    bench.read(i, kSystemTimeReg, 8);
    times[i] = get<std::int64_t>(bench.data.data()) - (bench.now_ns - before_ns);
  }
  assert_true(std::abs(times[1] - times[0]) < 2000);
  assert_true(std::abs(times[2] - times[0]) < 2000);
}

}  // namespace
}  // namespace tactus::segment

int main() {
  using namespace tactus::segment;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_eeprom_is_read_in_both_usual_ways),
      cmocka_unit_test(the_checksum_of_the_eeprom_is_right),
      cmocka_unit_test(clocks_follow_the_reference_clock),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
