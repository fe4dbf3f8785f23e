// The control computer's end of the sockets that programs open, for tests.
#pragma once

#include <cstdio>

#include "tests/support/testing.hpp"
#include "tests/ur/controller/ur_bench.hpp"

namespace tactus::ur {

inline int g_primary = -1, g_rtde = -1;

inline void connect() {
  g_bench.start();
  assert_true(g_bench.started());
  g_primary = g_bench->open(Service::kPrimary);
  g_rtde = g_bench->open(Service::kRtde);
}

/// Connects every link that a program asks for.
inline void answer_calls() {
  for (Link& link : g_bench->links().all())
    if (link.state() == Link::State::kWanted) link.connected();
}

inline void tick(int count = 1) {
  for (int i = 0; i < count; ++i) {
    g_bench.ticks(1);
    answer_calls();
  }
}

inline void send_ints(std::string_view socket, std::initializer_list<double> values) {
  std::array<std::uint8_t, 128> bytes{};
  ByteWriter writer(bytes.data(), bytes.size());
  for (const double value : values) writer.i32(static_cast<std::int32_t>(std::lround(value)));
  g_bench->links().find(socket)->receive(bytes.data(), writer.size());
}

constexpr double kMillion = 1e6;

/// Sends a message over the reverse socket.
inline void reverse(double timeout_ms, const Joints& values, ControlMode mode) {
  send_ints("reverse_socket", {timeout_ms, values[0] * kMillion, values[1] * kMillion,
                               values[2] * kMillion, values[3] * kMillion, values[4] * kMillion,
                               values[5] * kMillion, static_cast<double>(mode)});
}
inline void forward_command(double command, double count) {
  send_ints("reverse_socket", {200, command, count, 0, 0, 0, 0, 3});
}
/// Runs cycles with the keep-alive that a trajectory needs.
inline void keep_alive(int count) {
  for (int i = 0; i < count; ++i) {
    forward_command(kForwardNothing, 0);
    tick();
  }
}

inline bool playing() {
  return g_bench.image().runtime_state == 2;
}

/// The result received over the trajectory socket, or -1.
inline std::int32_t result() {
  Outbox& out = g_bench->links().find("trajectory_socket")->outbox();
  if (out.size() < 4) return -1;
  const std::int32_t value = ByteReader(out.data(), 4).i32();
  out.sent(4);
  return value;
}

constexpr const char* kExternalControl =
    "def external():\n"
    "  def connect_socket_with_retry(host, port, name, max_attempts=5, dt=0.2):\n"
    "    return socket_open(host, port, name)\n"
    "  end\n"
    "  a = connect_socket_with_retry(\"10.0.0.7\", 50003, \"trajectory_socket\")\n"
    "  b = connect_socket_with_retry(\"10.0.0.7\", 50004, \"script_command_socket\")\n"
    "  c = connect_socket_with_retry(\"10.0.0.7\", 50001, \"reverse_socket\")\n"
    "  servoj(q, t=steptime, lookahead_time=0.03, gain=2000)\n"
    "  write_output_float_register(1, splineTimerTraveled)\n"
    "  socket_send_int(TRAJECTORY_RESULT_CANCELED, \"trajectory_socket\")\n"
    "  socket_close(\"script_command_socket\")\n"
    "  write_output_integer_register(5, 77)\n"
    "  sleep(0.5)\n"
    "end\n";

inline void start_external(std::string_view text = kExternalControl) {
  connect();
  g_bench.send(g_primary, text);
  tick(6);
  assert_true(playing());
}

}  // namespace tactus::ur
