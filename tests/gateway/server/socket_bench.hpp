// A server whose thread serves a real TCP socket, and its client. The test's own thread is that of
// the cycle, so that virtual time goes on only where the test lets it.
#pragma once

#include <poll.h>
#include <unistd.h>

#include "gateway/sockets/server_thread.hpp"
#include "tests/gateway/server/client_bench.hpp"

namespace tactus {

/// A server that has a thread and a socket.
struct SocketBench {
  ServerBench bench;
  Listener listener;
  ServerThread thread{bench.server, listener, nullptr};

  void start() {
    Address address;
    Message why;
    assert_true(address.parse("tcp:127.0.0.1:0", why));
    assert_true(listener.open(address, false, why));
    bench.start();
    bench.step();
    assert_int_equal(thread.start(), 0);
  }
};

/// A client that is connected to the socket. What it sends waits in a queue until flush().
struct SocketClient : TestClient {
  static constexpr std::size_t kQueued = std::size_t{1} << 23;
  int socket = -1;
  std::array<std::uint8_t, kQueued> queue{};
  std::size_t queued = 0;
  std::array<std::uint8_t, 2 * kOutputBytes> received{};
  std::size_t came = 0;

  ~SocketClient() override { ::close(socket); }
  void join(SocketBench& its) {
    clock = &its.bench;
    const sockaddr_in& host = its.listener.address().host;
    assert_true(ntohs(host.sin_port) != 0);
    socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    assert_int_equal(::connect(socket, reinterpret_cast<const sockaddr*>(&host), sizeof host), 0);
    hello("A");
    flush(queued);
    while (welcomes == 0) wait(1);
  }
  std::size_t push(const std::uint8_t* data, std::size_t size) override {
    assert_true(queued + size <= queue.size());
    std::memcpy(queue.data() + queued, data, size);
    queued += size;
    return size;
  }
  /// Sends the first bytes of the queue.
  void flush(std::size_t count) {
    for (std::size_t at = 0; at < count;) {
      const ssize_t sent = ::send(socket, queue.data() + at, count - at, MSG_NOSIGNAL);
      assert_true(sent > 0);
      at += static_cast<std::size_t>(sent);
    }
    std::memmove(queue.data(), queue.data() + count, queued - count);
    queued -= count;
  }
  void read() override {
    for (;;) {
      const ssize_t count =
          ::recv(socket, received.data() + came, received.size() - came, MSG_DONTWAIT);
      assert_true(count != 0);  // the server has cut the connection
      if (count < 0) return;
      came += static_cast<std::size_t>(count);
      const std::size_t taken = take_whole({received.data(), came});
      std::memmove(received.data(), received.data() + taken, came - taken);
      came -= taken;
    }
  }
  /// Waits for the server, and reads what it says.
  void wait(int timeout_ms) {
    pollfd polled = {socket, POLLIN, 0};
    if (::poll(&polled, 1, timeout_ms) > 0) read();
  }
};

}  // namespace tactus
