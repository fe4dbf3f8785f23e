// Tests the emulated controller behind real sockets: a session over the loopback, programs that
// connect out, and misbehaving clients.
#include "tests/ur/controller/ur_server_bench.hpp"

namespace tactus::ur {
namespace {

// Proves URE-40.

void a_session_over_the_loopback(void**) {
  start();
  const int client = connect_to(kRtdePort);
  const std::uint8_t ask[] = {0, 5, 86, 0, 2, 0, 3, 118};
  assert_int_equal(send(client, ask, sizeof ask, 0), sizeof ask);
  std::array<std::uint8_t, 23> reply{};
  assert_true(receive(client, reply.data(), reply.size()));
  assert_int_equal(reply[3], 1);
  assert_int_equal(ByteReader(reply.data() + 7, 4).u32(), 3);
  const int dashboard = connect_to(kDashboardPort);
  std::array<char, 46> greeting{};
  assert_true(receive(dashboard, reinterpret_cast<std::uint8_t*>(greeting.data()), 45));
  assert_string_equal(greeting.data(), "Connected: Universal Robots Dashboard Server\n");
  close(client);
  close(dashboard);
}

void a_program_connects_out_to_the_address_in_its_text(void**) {
  start();
  const int door = socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = place(54321);
  const int on = 1;
  setsockopt(door, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  assert_int_equal(bind(door, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  assert_int_equal(listen(door, 1), 0);
  const int client = connect_to(kSecondaryPort);
  constexpr std::string_view kProgram =
      "def talk():\n  socket_open(\"127.0.0.77\", 54321, \"s\")\n  sleep(0.1)\n"
      "  socket_send_int(7, \"s\")\n  sleep(0.1)\nend\n";
  assert_int_equal(send(client, kProgram.data(), kProgram.size(), 0), kProgram.size());
  for (int i = 0; i < 10; ++i) tick();
  const int robot = accept(door, nullptr, nullptr);
  assert_true(robot >= 0);
  for (int i = 0; i < 15; ++i) tick();
  std::array<std::uint8_t, 4> value{};
  assert_true(receive(robot, value.data(), value.size()));
  assert_int_equal(value[3], 7);
  for (int i = 0; i < 30; ++i) tick();
  assert_false(receive(robot, value.data(), 1));  // closed with the program
  close(robot);
  close(client);
  close(door);
}

/// External control, uploaded to the secondary port, connects back and receives a stream.
void set_points_over_the_network_move_the_arm(void**) {
  start();
  std::array<int, 3> doors{}, robots{};
  const int on = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    doors[i] = socket(AF_INET, SOCK_STREAM, 0);
    setsockopt(doors[i], SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const sockaddr_in address = place(54331 + static_cast<int>(i));
    assert_int_equal(bind(doors[i], reinterpret_cast<const sockaddr*>(&address), sizeof address),
                     0);
    assert_int_equal(listen(doors[i], 1), 0);
  }
  const int client = connect_to(kSecondaryPort);
  constexpr std::string_view kProgram =
      "def external():\n"
      "  connect_socket_with_retry(\"127.0.0.77\", 54331, \"trajectory_socket\")\n"
      "  connect_socket_with_retry(\"127.0.0.77\", 54332, \"script_command_socket\")\n"
      "  connect_socket_with_retry(\"127.0.0.77\", 54333, \"reverse_socket\")\n"
      "end\n";
  assert_int_equal(send(client, kProgram.data(), kProgram.size(), 0), kProgram.size());
  for (int i = 0; i < 30; ++i) tick();
  for (std::size_t i = 0; i < 3; ++i) {
    robots[i] = accept(doors[i], nullptr, nullptr);
    assert_true(robots[i] >= 0);
  }
  Joints q = g_bench.image().actual_q;
  const double from = q[0];
  for (int k = 0; k < 125; ++k) {
    q[0] += 0.2 * kCycle_s;
    std::array<std::uint8_t, 32> message;
    ByteWriter writer(message.data(), message.size());
    writer.i32(500);
    for (int i = 0; i < 6; ++i) writer.i32(static_cast<std::int32_t>(std::lround(q[i] * 1e6)));
    writer.i32(1);
    assert_int_equal(send(robots[2], message.data(), message.size(), 0), message.size());
    tick();
  }
  // 0.2 rad, less the 0.03 s of servoj's lookahead and the data in flight.
  ASSERT_NEAR(g_bench.image().actual_q[0] - from, 0.2, 0.02);
  close(robots[2]);
  for (int i = 0; i < 60; ++i) tick();
  assert_false(g_bench.image().program_running);
  for (const int socket : {client, doors[0], doors[1], doors[2], robots[0], robots[1]})
    close(socket);
}

// Proves URE-41.

void a_client_that_does_not_read_disturbs_nobody(void**) {
  start();
  const int dead = connect_to(kRealtimePort);
  const int alive = connect_to(kRealtimePort);
  double last = 0.0;
  std::array<std::uint8_t, 1116> packet{};
  for (int k = 0; k < 4000; ++k) {
    tick();
    assert_true(receive(alive, packet.data(), packet.size()));
    const double stamp = ByteReader(packet.data() + kTimeOffset, 8).f64();
    if (k > 0) ASSERT_NEAR(stamp - last, 0.008, 1e-9);
    last = stamp;
  }
  // The dead client was disconnected; its remaining bytes begin with whole packets.
  std::array<std::uint8_t, 4> size{};
  assert_true(receive(dead, size.data(), size.size()));
  assert_int_equal(ByteReader(size.data(), 4).u32(), 1116);
  bool closed = false;
  std::array<std::uint8_t, 4096> rest;
  for (int i = 0; i < 100000 && !closed; ++i) {
    const ssize_t got = recv(dead, rest.data(), rest.size(), MSG_DONTWAIT);
    closed = got == 0 || (got < 0 && errno != EAGAIN);
    if (got < 0 && !closed) usleep(100);
  }
  assert_true(closed);
  close(dead);
  close(alive);
}

void a_client_that_vanishes_frees_its_place_and_its_claims(void**) {
  start();
  for (int n = 0; n < 3 * Emulator::kSessions; ++n) {
    const int client = connect_to(kRtdePort);
    constexpr std::uint8_t kSetup[] = "\0\x17Iinput_int_register_0";
    assert_int_equal(send(client, kSetup, 23, 0), 23);
    std::array<std::uint8_t, 9> reply{};
    assert_true(receive(client, reply.data(), reply.size()));
    assert_int_equal(reply[3], 1);
    close(client);
    for (int i = 0; i < 3; ++i) g_server->pump(1'000'000);
  }
}

void a_port_that_is_taken_is_said(void**) {
  start();
  static Server second(*g_bench);
  assert_false(second.start(kAddress, kOffset));
  assert_int_equal(errno, EADDRINUSE);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_session_over_the_loopback),
      cmocka_unit_test(a_program_connects_out_to_the_address_in_its_text),
      cmocka_unit_test(set_points_over_the_network_move_the_arm),
      cmocka_unit_test(a_client_that_does_not_read_disturbs_nobody),
      cmocka_unit_test(a_client_that_vanishes_frees_its_place_and_its_claims),
      cmocka_unit_test(a_port_that_is_taken_is_said),
  };
  return run_server_tests(tests);
}
