// A port of a controller made of bytes: one connection at a time, on this machine.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <string_view>

#include "tests/support/testing.hpp"

namespace tactus::ur {

struct FakeListener {
  int listening = -1, port = 0, socket = -1;
  std::atomic<int> connections{0};  // so far
  std::array<std::uint8_t, 16384> bytes;
  std::size_t size = 0;
  bool dribbles = false;  // sends one byte now and then

  void open() {
    listening = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    constexpr int kBuffer = 4096;  // soon full where nobody reads
    setsockopt(listening, SOL_SOCKET, SO_RCVBUF, &kBuffer, sizeof kBuffer);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof at;
    assert_int_equal(::bind(listening, reinterpret_cast<sockaddr*>(&at), length), 0);
    assert_int_equal(::listen(listening, 4), 0);
    getsockname(listening, reinterpret_cast<sockaddr*>(&at), &length);
    port = ntohs(at.sin_port);
  }
  /// A new connection takes the place of the one before.
  bool accept() {
    const int connection = ::accept4(listening, nullptr, nullptr, SOCK_NONBLOCK);
    if (connection < 0) return false;
    drop();
    socket = connection;
    ++connections;
    constexpr int kYes = 1;
    setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &kYes, sizeof kYes);
    return true;
  }
  void drop() {
    if (socket >= 0) ::close(socket);
    socket = -1;
    size = slow_size_ = 0;
  }
  void close() {
    drop();
    if (listening >= 0) ::close(listening);
  }
  /// Takes bytes that have come; false: none.
  bool take() {
    const long got = ::recv(socket, bytes.data() + size, bytes.size() - size, MSG_DONTWAIT);
    if (got == 0) drop();
    if (got > 0) size += static_cast<std::size_t>(got);
    return got > 0;
  }

  void send(const std::uint8_t* data, std::size_t count) {
    if (!dribbles) {
      ::send(socket, data, count, MSG_NOSIGNAL);
      return;
    }
    count = std::min(count, slow_.size() - slow_size_);
    std::memcpy(slow_.data() + slow_size_, data, count);
    slow_size_ += count;
  }
  void say(std::string_view text) {
    send(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  void dribble() {
    constexpr int kTicks = 4;  // 2 ms
    if (slow_size_ == 0 || ++tick_ % kTicks != 0) return;
    ::send(socket, slow_.data(), 1, MSG_NOSIGNAL);
    std::memmove(slow_.data(), slow_.data() + 1, --slow_size_);
  }

 private:
  std::array<std::uint8_t, 4096> slow_;
  std::size_t slow_size_ = 0;
  int tick_ = 0;
};

}  // namespace tactus::ur
