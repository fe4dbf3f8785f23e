// Frames on the link, against COBS and CRC-32 written again from their definitions.
#include <algorithm>
#include <random>
#include <string_view>
#include <vector>

#include "hal/serial/crc32.hpp"
#include "hal/serial/frame.hpp"
#include "tests/support/testing.hpp"

namespace tactus::serial {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes g_wire, g_plain;
std::mt19937 g_random(1);

/// CRC-32 one bit at a time, by the definition.
std::uint32_t slow_crc(const Bytes& bytes) {
  std::uint32_t sum = 0xFFFFFFFF;
  for (const std::uint8_t byte : bytes)
    for (int bit = 0; bit < 8; ++bit) {
      const bool ones = ((sum ^ byte >> bit) & 1) != 0;
      sum = sum >> 1 ^ (ones ? 0xEDB88320 : 0);
    }
  return ~sum;
}

/// The decoder of the paper: a code says how many bytes follow before the next zero.
Bytes unstuffed(const Bytes& wire) {
  Bytes plain;
  for (std::size_t at = 0; at + 1 < wire.size();) {
    const std::uint8_t code = wire[at++];
    for (int i = 1; i < code; ++i) plain.push_back(wire[at++]);
    if (code < 0xFF && at + 1 < wire.size()) plain.push_back(0);
  }
  return plain;
}

const Bytes& written(Kind kind, std::uint16_t number, const Bytes& payload) {
  g_wire.assign(kMaxFrame, 0xAA);
  g_wire.resize(write_frame({kind, number, payload.data(), payload.size()}, g_wire.data()));
  return g_wire;
}

/// Reads all bytes; returns how many frames they held, of which the reader has the last.
int read(FrameReader& reader, const Bytes& wire) {
  int frames = 0;
  for (const std::uint8_t byte : wire) frames += reader.take(byte) ? 1 : 0;
  return frames;
}

/// Payloads of every kind of length, with zeros or without.
Bytes random_payload() {
  Bytes payload(g_random() % (kMaxPayload + 1));
  const bool zeros = g_random() % 2 == 0;
  for (std::uint8_t& byte : payload)
    byte = static_cast<std::uint8_t>(zeros && g_random() % 4 == 0 ? 0 : g_random() % 255 + 1);
  return payload;
}

// Proves LNK-1.
void the_check_sum_is_that_of_ieee_802_3(void**) {
  constexpr std::string_view kDigits = "123456789";
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(kDigits.data());
  assert_int_equal(crc32<16>(bytes, kDigits.size()), 0xCBF43926);  // the catalogue's check value
  assert_int_equal(slow_crc({bytes, bytes + kDigits.size()}), 0xCBF43926);
}

void a_frame_is_stuffed_and_summed_as_the_definitions_say(void**) {
  for (int trial = 0; trial < 2000; ++trial) {
    const Bytes payload = random_payload();
    const Bytes& wire = written(Kind::kText, 0x0102, payload);
    assert_int_equal(std::count(wire.begin(), wire.end(), 0), 1);
    assert_int_equal(wire.back(), 0);
    g_plain = unstuffed(wire);
    assert_int_equal(g_plain.size(), kHead + payload.size() + kTail);
    assert_int_equal(g_plain[0], static_cast<int>(Kind::kText));
    assert_int_equal(g_plain[1] << 8 | g_plain[2], 0x0102);
    assert_true(std::equal(payload.begin(), payload.end(), g_plain.begin() + kHead));
    const std::size_t end = g_plain.size();
    const std::uint32_t sum = static_cast<std::uint32_t>(g_plain[end - 4]) << 24 |
                              static_cast<std::uint32_t>(g_plain[end - 3]) << 16 |
                              static_cast<std::uint32_t>(g_plain[end - 2]) << 8 | g_plain[end - 1];
    g_plain.resize(end - kTail);
    assert_int_equal(sum, slow_crc(g_plain));
  }
}

void what_is_written_is_read(void**) {
  static FrameReader reader;
  for (int trial = 0; trial < 2000; ++trial) {
    const Bytes payload = random_payload();
    const auto number = static_cast<std::uint16_t>(g_random());
    assert_int_equal(read(reader, written(Kind::kWaypoints, number, payload)), 1);
    assert_int_equal(reader.frame().number, number);
    assert_true(reader.frame().kind == Kind::kWaypoints);
    assert_int_equal(reader.frame().size, payload.size());
    assert_true(std::equal(payload.begin(), payload.end(), reader.frame().payload));
  }
  assert_int_equal(reader.health().frames, 2000);
  assert_int_equal(reader.health().malformed + reader.health().corrupted, 0);
}

void the_longest_payload_fits_and_one_byte_more_is_refused(void**) {
  static FrameReader reader;
  Bytes payload(kMaxPayload, 0x55);
  assert_int_equal(read(reader, written(Kind::kText, 1, payload)), 1);
  assert_true(g_wire.size() <= kMaxFrame);
  payload.push_back(0x55);
  assert_int_equal(written(Kind::kText, 1, payload).size(), 0);
}

void every_flipped_bit_is_found(void**) {
  static FrameReader reader;
  Bytes payload(40);
  for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(g_random());
  const Bytes wire = written(Kind::kState, 7, payload);
  for (std::size_t bit = 0; bit < 8 * wire.size(); ++bit) {
    Bytes broken = wire;
    broken[bit / 8] = static_cast<std::uint8_t>(broken[bit / 8] ^ 1U << bit % 8);
    assert_int_equal(read(reader, broken), 0);
    assert_int_equal(read(reader, {0}), 0);
    assert_int_equal(read(reader, wire), 1);  // and the next frame is read
  }
}

void a_frame_is_found_behind_any_bytes(void**) {
  static FrameReader reader;
  int found = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Bytes noise(g_random() % 3000);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(g_random());
    noise.push_back(0);
    found += read(reader, noise);
    assert_int_equal(read(reader, written(Kind::kTick, 3, {1, 2, 3})), 1);
    assert_int_equal(reader.frame().size, 3);
  }
  assert_int_equal(found, 0);
  assert_true(reader.health().malformed > 0);
}

void a_frame_without_an_end_is_dropped_and_counted(void**) {
  static FrameReader reader;
  assert_int_equal(read(reader, Bytes(5 * kMaxFrame, 0x11)), 0);
  assert_int_equal(read(reader, {0}), 0);
  assert_int_equal(reader.health().malformed, 1);
  assert_int_equal(read(reader, written(Kind::kTick, 3, {})), 1);
}

}  // namespace
}  // namespace tactus::serial

int main() {
  using namespace tactus::serial;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_check_sum_is_that_of_ieee_802_3),
      cmocka_unit_test(a_frame_is_stuffed_and_summed_as_the_definitions_say),
      cmocka_unit_test(what_is_written_is_read),
      cmocka_unit_test(the_longest_payload_fits_and_one_byte_more_is_refused),
      cmocka_unit_test(every_flipped_bit_is_found),
      cmocka_unit_test(a_frame_is_found_behind_any_bytes),
      cmocka_unit_test(a_frame_without_an_end_is_dropped_and_counted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
