// Tests the places of the clients at the ports of the emulated controller.
#include "tests/ur/controller/ur_server_bench.hpp"

namespace tactus::ur {
namespace {

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
  assert_true(is_closed(silent));
  assert_false(is_closed(writes));
  close(writes);
  close(silent);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(clients_of_one_port_lock_out_nobody_at_another),
      cmocka_unit_test(an_idle_client_gives_its_place_to_a_new_one),
      cmocka_unit_test(a_client_that_only_reads_is_not_idle),
      cmocka_unit_test(a_client_that_uploads_programs_and_reads_nothing_stays),
  };
  return run_server_tests(tests);
}
