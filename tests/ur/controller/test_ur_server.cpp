// Tests the emulated controller behind real sockets: a session over the loopback, programs that
// connect out, misbehaving clients, the places of clients; and the times at which a host that is
// sometimes late begins the cycles.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cerrno>

#include "sim_plant/ur/server/cycle_grid.hpp"
#include "tests/support/testing.hpp"
#include "tests/ur/controller/ur_bench.hpp"
#include "tests/ur/free_ports.hpp"

namespace tactus::ur {
namespace {

/// The emulated controller behind real sockets, for tests.

constexpr const char* kAddress = "127.0.0.77";
const int kOffset = free_offset(kAddress, -10000);

alignas(Server) unsigned char g_memory[sizeof(Server)];
Server* g_server = nullptr;

void start() {
  g_bench.start();
  assert_true(g_bench.started());
  if (g_server != nullptr) g_server->~Server();
  g_server = new (g_memory) Server(*g_bench);
  assert_true(g_server->start(kAddress, kOffset));
}

sockaddr_in place(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, kAddress, &address.sin_addr);
  return address;
}

int connect_to(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const int small = 4096;
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  const sockaddr_in address = place(port + kOffset);
  assert_int_equal(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (int i = 0; i < 5; ++i) g_server->pump(1'000'000);
  return socket;
}

void tick() {
  g_server->pump(0);
  g_bench->tick();
  g_server->flush();
}

/// Receives exactly `size` bytes, running cycles until they have arrived.
bool receive(int socket, std::uint8_t* data, std::size_t size) {
  std::size_t got = 0;
  for (int i = 0; i < 2000 && got < size; ++i) {
    const ssize_t more = recv(socket, data + got, size - got, MSG_DONTWAIT);
    if (more == 0) return false;
    if (more > 0)
      got += static_cast<std::size_t>(more);
    else
      g_server->pump(1'000'000);
  }
  return got == size;
}

template <std::size_t N>
int run_server_tests(const CMUnitTest (&tests)[N]) {
  const int failed = _cmocka_run_group_tests("tests", tests, N, nullptr, nullptr);
  if (g_server != nullptr) g_server->stop();
  return failed;
}

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

/// True if the peer has closed the connection.
bool is_closed(int socket) {
  std::array<char, 64 * 1024> bytes;
  ssize_t got = 0;
  while ((got = recv(socket, bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
  }
  return got == 0;
}

// Proves URE-42.

void clients_of_one_port_lock_out_nobody_at_another(void**) {
  start();
  std::array<int, 2 * Emulator::kPlaces> clients{};
  for (int& client : clients) client = connect_to(kDashboardPort);
  for (std::size_t i = 0; i < clients.size(); ++i)
    assert_int_equal(is_closed(clients[i]), i >= Emulator::kPlaces);
  for (const int port : {kPrimaryPort, kSecondaryPort, kRealtimePort, kRtdePort}) {
    const int other = connect_to(port);
    assert_false(is_closed(other));
    close(other);
  }
  for (const int client : clients) close(client);
}

void an_idle_client_gives_its_place_to_a_new_one(void**) {
  start();
  std::array<int, Emulator::kPlaces> clients{};
  for (int& client : clients) client = connect_to(kDashboardPort);
  const int cycles = static_cast<int>(Emulator::kIdle_s / kCycle_s);
  for (int k = 0; k < cycles + 10; ++k) {
    tick();
    if (k != cycles - 100) continue;
    for (std::size_t i = 0; i < clients.size(); ++i)  // all but the third are still in use
      if (i != 3) assert_int_equal(send(clients[i], "robotmode\n", 10, 0), 10);
  }
  const int late = connect_to(kDashboardPort);
  assert_false(is_closed(late));
  for (std::size_t i = 0; i < clients.size(); ++i) assert_int_equal(is_closed(clients[i]), i == 3);
  const int later = connect_to(kDashboardPort);
  assert_true(is_closed(later));
  for (const int client : clients) close(client);
  close(late);
  close(later);
}

void a_client_that_only_reads_is_not_idle(void**) {
  start();
  std::array<int, Emulator::kPlaces> clients{};
  for (int& client : clients) client = connect_to(kRealtimePort);
  for (int k = 0; k < static_cast<int>(Emulator::kIdle_s / kCycle_s) + 10; ++k) {
    tick();
    for (const int client : clients) assert_false(is_closed(client));
  }
  const int late = connect_to(kRealtimePort);
  assert_true(is_closed(late));
  for (const int client : clients) close(client);
  close(late);
}

/// It misses packets; one that neither reads nor writes is ended.
void a_client_that_uploads_programs_and_reads_nothing_stays(void**) {
  start();
  const int writes = connect_to(kRealtimePort), silent = connect_to(kRealtimePort);
  assert_int_equal(send(writes, "set speed 1.0\n", 14, 0), 14);
  for (int k = 0; k < 8000; ++k) tick();
  for (int i = 0; i < 10000 && !is_closed(silent); ++i) usleep(100);  // much is on its way
  assert_true(is_closed(silent));
  assert_false(is_closed(writes));
  close(writes);
  close(silent);
}

constexpr std::int64_t kPeriod_ns = 8'000'000, kBegin_ns = 5'000'000'000;

/// A host that begins a cycle as soon as it may, and stalls for `stall_ns` before cycle `at`.
struct Host {
  CycleGrid grid{kPeriod_ns, kBegin_ns};
  std::int64_t now_ns = kBegin_ns, shortest_ns = kPeriod_ns;
  std::int64_t cycles = 0;

  void run(int count, int at, std::int64_t stall_ns) {
    for (int k = 0; k < count; ++k) {
      const std::int64_t before_ns = now_ns;
      if (k == at) now_ns += stall_ns;
      const std::int64_t left_ns = grid.left_ns(now_ns);
      if (left_ns > 0) now_ns += left_ns;
      grid.begin(now_ns);
      ++cycles;
      if (k > 0) shortest_ns = std::min(shortest_ns, now_ns - before_ns);
    }
  }
};

// Proves URP-41.

void a_host_in_time_keeps_the_grid(void**) {
  Host host;
  host.run(1000, -1, 0);
  assert_int_equal(host.now_ns, kBegin_ns + 1000 * kPeriod_ns);
  assert_int_equal(host.shortest_ns, kPeriod_ns);
}

void what_was_late_is_caught_up(void**) {
  for (const std::int64_t stall_ms : {1, 9, 40, 100, 900}) {
    Host host;
    host.run(1000, 100, stall_ms * 1'000'000);
    assert_int_equal(host.now_ns, kBegin_ns + 1000 * kPeriod_ns);
  }
}

void clients_have_time_to_answer_between_two_cycles(void**) {
  Host host;
  host.run(1000, 100, 100'000'000);
  assert_int_equal(host.shortest_ns, kPeriod_ns / 2);
}

void after_more_than_a_second_the_time_is_let_go(void**) {
  Host host;
  host.run(1000, 100, 3'000'000'000);
  // By the host's own clock the 101st cycle begins 3 s late, and the grid moves with it.
  assert_int_equal(host.now_ns, kBegin_ns + 999 * kPeriod_ns + 3'000'000'000);
  assert_int_equal(host.shortest_ns, kPeriod_ns);
}

void a_grid_that_begins_anew_owes_nothing(void**) {
  CycleGrid grid(kPeriod_ns, kBegin_ns);
  grid.begin_anew(kBegin_ns + 500'000'000);
  assert_int_equal(grid.left_ns(kBegin_ns + 500'000'000), kPeriod_ns);
  grid.begin_anew(kBegin_ns + 500'000'001);
  assert_int_equal(grid.left_ns(kBegin_ns + 500'000'001), kPeriod_ns);
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
      cmocka_unit_test(clients_of_one_port_lock_out_nobody_at_another),
      cmocka_unit_test(an_idle_client_gives_its_place_to_a_new_one),
      cmocka_unit_test(a_client_that_only_reads_is_not_idle),
      cmocka_unit_test(a_client_that_uploads_programs_and_reads_nothing_stays),
      cmocka_unit_test(a_host_in_time_keeps_the_grid),
      cmocka_unit_test(what_was_late_is_caught_up),
      cmocka_unit_test(clients_have_time_to_answer_between_two_cycles),
      cmocka_unit_test(after_more_than_a_second_the_time_is_let_go),
      cmocka_unit_test(a_grid_that_begins_anew_owes_nothing),
  };
  return run_server_tests(tests);
}
