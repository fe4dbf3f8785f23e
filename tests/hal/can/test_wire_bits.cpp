// The bounds of a frame's length, against frames whose bits are put together and stuffed.
#include <algorithm>
#include <random>
#include <string_view>

#include "hal/can/bus_load.hpp"
#include "tests/hal/can/wire_bits.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

using Data = std::array<std::uint8_t, kMaxData>;

struct LongSize {
  std::size_t size;
  int dlc;  ///< as ISO 11898-1 codes the size
};
constexpr LongSize kLongSizes[] = {{0, 0},   {4, 4},   {8, 8},   {12, 9},  {16, 10},
                                   {20, 11}, {24, 12}, {32, 13}, {48, 14}, {64, 15}};
/// Runs of four equal bits: after the first stuff bit, each of them gets another.
constexpr std::uint8_t kRuns[] = {0x0F, 0x1E, 0x3C, 0x78, 0xF0, 0xE1, 0xC3, 0x87};

int stuff(const WireBits& wire) {
  return wire.stuff(0, wire.count);
}

// Proves CAN-5.
/// The oracle's checksum is the one of the catalogue of CRCs, "CRC-15/CAN".
void the_checksum_is_that_of_can(void**) {
  WireBits wire;
  for (const char c : std::string_view("123456789")) wire.put(static_cast<std::uint8_t>(c), 8);
  assert_int_equal(wire.checksum(), 0x059E);
}

void assert_within(const WireBits& wire, std::size_t size) {
  const FrameBits bound = frame_bits(size, false);
  assert_int_equal(wire.count + kClassicTail, bound.nominal);
  assert_true(stuff(wire) <= bound.nominal_stuff);
}
void assert_long_within(const WireBits& wire, std::size_t size) {
  const FrameBits bound = frame_bits(size, true);
  // Behind the data: count of stuff bits, checksum and their fixed stuff bits, one before every
  // four bits.
  const std::size_t tail = 4 + (size <= 16 ? 17U : 21U);
  assert_int_equal(wire.count - kLongHead + tail + (tail + 3) / 4, bound.data);
  assert_int_equal(kLongHead + kClassicTail, bound.nominal);
  assert_true(wire.stuff(0, kLongHead) <= bound.nominal_stuff);
  assert_true(wire.stuff(kLongHead, wire.count) <= bound.data_stuff);
}

/// Data of random bytes, or of random bytes out of few, so that there are long runs.
void fill(Data& data, std::mt19937& random) {
  constexpr std::uint8_t kSome[] = {0x00, 0xFF, 0x0F, 0xF0, 0x1E, 0xE1, 0x3C, 0x87};
  const bool any = random() % 2 == 0;
  for (std::uint8_t& byte : data)
    byte = any ? static_cast<std::uint8_t>(random()) : kSome[random() % 8];
}

void no_classic_frame_is_longer_than_the_bound(void**) {
  std::mt19937 random(1);
  Data data{};
  for (int trial = 0; trial < 20000; ++trial) {
    fill(data, random);
    const std::size_t size = random() % 9;
    assert_within(classic_bits(random() & 0x7FF, data.data(), size), size);
  }
}

void no_long_frame_is_longer_than_the_bound(void**) {
  std::mt19937 random(2);
  Data data{};
  for (int trial = 0; trial < 20000; ++trial) {
    fill(data, random);
    const LongSize& row = kLongSizes[random() % std::size(kLongSizes)];
    assert_long_within(long_bits(random() & 0x7FF, data.data(), row.size, row.dlc), row.size);
  }
}

void a_frame_of_equal_bytes_is_within_the_bound_for_every_identifier(void**) {
  Data data{};
  for (std::uint16_t id = 0; id < 2048; ++id)
    for (const std::uint8_t byte : kRuns) {
      data.fill(byte);
      assert_within(classic_bits(id, data.data(), 8), 8);
      assert_long_within(long_bits(id, data.data(), 12, 9), 12);
    }
}

/// Fixed bits and the checksum keep real frames from it; the bound is that of any bits.
void bits_in_runs_of_four_reach_the_bound(void**) {
  for (std::size_t size = 0; size <= kClassicData; ++size) {
    const FrameBits bound = frame_bits(size, false);
    WireBits wire;
    wire.put(0, 1);
    while (wire.count + kClassicTail < static_cast<std::size_t>(bound.nominal))
      wire.put((wire.count - 1) / 4 % 2, 1);
    assert_int_equal(stuff(wire), bound.nominal_stuff);
  }
}

/// So the bound is not loose: two stuff bits of a real CAN FD frame are missing.
void real_long_frames_come_within_two_bits_of_the_bound(void**) {
  Data data{};
  for (const LongSize& row : kLongSizes) {
    if (row.size < 4) continue;
    int most = 0;
    for (std::uint16_t id = 0; id < 2048; ++id)
      for (const std::uint8_t byte : kRuns) {
        data.fill(byte);
        most = std::max(most, stuff(long_bits(id, data.data(), row.size, row.dlc)));
      }
    const FrameBits bound = frame_bits(row.size, true);
    assert_int_equal(most, bound.nominal_stuff + bound.data_stuff - 2);
  }
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_checksum_is_that_of_can),
      cmocka_unit_test(no_classic_frame_is_longer_than_the_bound),
      cmocka_unit_test(no_long_frame_is_longer_than_the_bound),
      cmocka_unit_test(a_frame_of_equal_bytes_is_within_the_bound_for_every_identifier),
      cmocka_unit_test(bits_in_runs_of_four_reach_the_bound),
      cmocka_unit_test(real_long_frames_come_within_two_bits_of_the_bound),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
