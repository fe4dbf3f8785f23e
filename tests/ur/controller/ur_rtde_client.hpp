// An RTDE client for tests: packets from hexadecimal, and a session opened as the vendor's client
// opens it.
#pragma once

#include <cstdio>

#include "tests/support/testing.hpp"
#include "tests/ur/controller/ur_bench.hpp"

namespace tactus::ur {

inline int g_client = -1;

/// Bytes of a hexadecimal text, blanks ignored.
inline std::string_view bytes(const char* hex) {
  static std::array<char, 4096> out;
  std::size_t size = 0;
  for (unsigned value = 0; *hex != '\0';) {
    if (*hex == ' ') {
      ++hex;
      continue;
    }
    std::sscanf(hex, "%2x", &value);
    out[size++] = static_cast<char>(value);
    hex += 2;
  }
  return {out.data(), size};
}

inline void connect_rtde() {
  g_bench.start();
  assert_true(g_bench.started());
  g_client = g_bench->open(Service::kRtde);
  assert_true(g_client >= 0);
}

/// A packet: its type, and its payload.
inline void send_packet(char type, std::string_view payload, int client) {
  std::array<char, 16384> packet;
  const std::size_t size = payload.size() + 3;
  packet[0] = static_cast<char>(size >> 8);
  packet[1] = static_cast<char>(size & 0xff);
  packet[2] = type;
  std::memcpy(packet.data() + 3, payload.data(), payload.size());
  g_bench.send(client, {packet.data(), size});
}

inline void expect_text(std::string_view actual, std::string_view expected) {
  assert_int_equal(actual.size(), expected.size());
  assert_memory_equal(actual.data(), expected.data(), expected.size());
}

constexpr const char* kVersion2 = "00 05 56 00 02";
constexpr const char* kOutputs = "00 36 4f 40 5f 40 00 00 00 00 00";
constexpr std::string_view kNames = "timestamp,actual_q,robot_mode,runtime_state";
constexpr const char* kBegin = "00 03 53";

/// The client's side of a session at 125 Hz, as one stream.
inline std::string_view session_stream() {
  static std::array<char, 256> stream;
  std::size_t size = 0;
  const auto add = [&](std::string_view part) {
    std::memcpy(stream.data() + size, part.data(), part.size());
    size += part.size();
  };
  add(bytes(kVersion2));
  add(bytes("00 03 76"));
  add(bytes(kOutputs));
  add(kNames);
  add(bytes(kBegin));
  return {stream.data(), size};
}
constexpr const char* kReplies =
    "00 04 56 01  00 13 76 00 00 00 03 00 00 00 0f 00 00 00 08 00 01 9f 63  00 20 4f 01"
    "44 4f 55 42 4c 45 2c 56 45 43 54 4f 52 36 44 2c 49 4e 54 33 32 2c 55 49 4e 54 33 32"
    "00 04 53 01";

}  // namespace tactus::ur
