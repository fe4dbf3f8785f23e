// Clients of the primary port and the dashboard, for tests.
#pragma once

#include <cstdio>

#include "tests/support/testing.hpp"
#include "tests/ur/controller/ur_bench.hpp"

namespace tactus::ur {

inline int g_primary = -1, g_dashboard = -1;

inline void connect_clients(const Settings& settings = {}) {
  g_bench.start(settings);
  assert_true(g_bench.started());
  g_primary = g_bench->open(Service::kPrimary);
  g_dashboard = g_bench->open(Service::kDashboard);
  g_bench.take(g_dashboard);
}

inline void expect_reply(std::string_view command, std::string_view reply) {
  g_bench.send(g_dashboard, command);
  g_bench.send(g_dashboard, "\n");
  std::string_view got = g_bench.take(g_dashboard);
  assert_true(!got.empty() && got.back() == '\n');
  got.remove_suffix(1);
  if (got != reply) print_error("%.*s\n", static_cast<int>(got.size()), got.data());
  assert_true(got == reply);
}

/// Whether the bytes of the primary port contain a message of this type whose body begins with
/// `body`.
inline bool heard(MessageType type, std::string_view body) {
  const std::string_view got = g_bench.take(g_primary);
  StateFrames frames;
  Packet packet;
  bool found = false;
  for (std::size_t at = 0; at < got.size();) {
    at += frames.take(reinterpret_cast<const std::uint8_t*>(got.data()) + at, got.size() - at);
    NextPacket next;
    while ((next = frames.next(packet)) == NextPacket::kPacket) {
      ByteReader reader(packet.data, packet.size);
      reader.u32();
      if (reader.i8() != static_cast<int>(StateType::kRobotMessage)) continue;
      reader.u64();
      reader.i8();
      if (reader.u8() != static_cast<int>(type)) continue;
      found = found || reader.rest().substr(0, body.size()) == body;
    }
    assert_true(next != NextPacket::kBroken);
  }
  return found;
}

/// Code and argument, as they appear at the beginning of a body.
inline std::string_view stop_bytes(Code code, std::int32_t argument) {
  static std::array<std::uint8_t, 8> bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  writer.i32(static_cast<std::int32_t>(code));
  writer.i32(argument);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline bool protective_stopped() {
  return g_bench.image().safety_mode == static_cast<int>(SafetyMode::kProtectiveStop);
}
inline bool in_mode(RobotMode mode) {
  return g_bench.image().robot_mode == static_cast<int>(mode);
}

}  // namespace tactus::ur
