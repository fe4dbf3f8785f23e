// A CanSocket at one end of a packet socket pair, and a bare descriptor at the other.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

#include "hal/can/can_socket.hpp"

namespace tactus::can {

struct CanPair {
  CanSocket can;
  int peer = -1;

  explicit CanPair(bool fd = false, const CanFilter* filters = nullptr, int count = 0) {
    int ends[2] = {-1, -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) return;
    can.adopt(ends[0], fd, filters, count);
    peer = ends[1];
  }
  CanPair(const CanPair&) = delete;
  CanPair& operator=(const CanPair&) = delete;
  ~CanPair() { hang_up(); }

  void hang_up() {
    if (peer >= 0) ::close(peer);
    peer = -1;
  }
  bool put(const void* packet, std::size_t size) const {
    return ::send(peer, packet, size, MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(size);
  }
  /// Puts a classic frame whose data is `id`'s low byte, repeated.
  bool put_frame(std::uint32_t id, std::uint8_t size) const {
    can_frame raw{};
    raw.can_id = id;
    raw.can_dlc = size;
    std::memset(raw.data, static_cast<int>(id & 0xFF), sizeof raw.data);
    return put(&raw, sizeof raw);
  }
  /// Takes the next packet; returns its length, -1 if there is none.
  long take(void* packet, std::size_t size) const { return recv(peer, packet, size, MSG_DONTWAIT); }
};

}  // namespace tactus::can
