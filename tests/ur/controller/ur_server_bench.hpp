// The emulated controller behind real sockets, for tests.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cerrno>

#include "tests/support/testing.hpp"
#include "tests/ur/controller/ur_bench.hpp"
#include "tests/ur/free_ports.hpp"

namespace tactus::ur {

inline constexpr const char* kAddress = "127.0.0.77";
inline const int kOffset = free_offset(kAddress, -10000);

alignas(Server) inline unsigned char g_memory[sizeof(Server)];
inline Server* g_server = nullptr;

inline void start() {
  g_bench.start();
  assert_true(g_bench.started());
  if (g_server != nullptr) g_server->~Server();
  g_server = new (g_memory) Server(*g_bench);
  assert_true(g_server->start(kAddress, kOffset));
}

inline sockaddr_in place(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, kAddress, &address.sin_addr);
  return address;
}

inline int connect_to(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const int small = 4096;
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  const sockaddr_in address = place(port + kOffset);
  assert_int_equal(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (int i = 0; i < 5; ++i) g_server->pump(1'000'000);
  return socket;
}

inline void tick() {
  g_server->pump(0);
  g_bench->tick();
  g_server->flush();
}

/// Receives exactly `size` bytes, running cycles until they have arrived.
inline bool receive(int socket, std::uint8_t* data, std::size_t size) {
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

}  // namespace tactus::ur
