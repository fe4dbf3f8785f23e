// A CanSocket on a CAN interface of this machine, and a bare socket of the kernel on the same or
// another interface. The tests here run in the virtual machine of scripts/can-vm.
#pragma once

#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/can/can_socket.hpp"

namespace tactus::can {

/// Calls ioctl for an interface with the request that `fill` completes. Returns true if it is done.
template <class Fill>
bool set_interface(const char* interface, unsigned long what, Fill fill) {
  const int any = ::socket(AF_INET, SOCK_DGRAM, 0);
  ifreq request{};
  std::strncpy(request.ifr_name, interface, sizeof request.ifr_name - 1);
  const bool known = ioctl(any, SIOCGIFFLAGS, &request) == 0;
  fill(request);
  const bool done = known && ioctl(any, what, &request) == 0;
  ::close(any);
  return done;
}
inline bool set_up(const char* interface, bool up) {
  return set_interface(interface, SIOCSIFFLAGS, [up](ifreq& request) {
    const int flags = up ? request.ifr_flags | IFF_UP : request.ifr_flags & ~IFF_UP;
    request.ifr_flags = static_cast<short>(flags);
  });
}
inline bool set_queue(const char* interface, int frames) {
  return set_interface(interface, SIOCSIFTXQLEN,
                       [frames](ifreq& request) { request.ifr_qlen = frames; });
}

struct CanBus {
  CanSocket can;
  Message why;
  Status status;
  int peer = -1;

  /// Opens the interface `own` for the CanSocket and `others` for the bare socket.
  explicit CanBus(const char* own, const char* others, bool fd = false,
                  const CanFilter* filters = nullptr, int count = 0)
      : status(can.open(own, fd, filters, count, why)),
        peer(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK, CAN_RAW)) {
    constexpr int kYes = 1;
    setsockopt(peer, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &kYes, sizeof kYes);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(others));
    if (::bind(peer, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      status = Status::kConnectionLost;
  }
  CanBus(const CanBus&) = delete;
  CanBus& operator=(const CanBus&) = delete;
  ~CanBus() {
    if (peer >= 0) ::close(peer);
  }

  bool put(const void* packet, std::size_t size) const {
    return write(peer, packet, size) == static_cast<ssize_t>(size);
  }
  /// Puts a classic frame with one byte of data.
  bool put_frame(std::uint32_t id, std::uint8_t data = 0) const {
    can_frame raw{};
    raw.can_id = id;
    raw.can_dlc = 1;
    raw.data[0] = data;
    return put(&raw, sizeof raw);
  }
  /// Takes the next packet, if one comes within a second; returns its length, else -1.
  long take(canfd_frame& packet) const {
    fd_set set;
    FD_ZERO(&set);
    FD_SET(peer, &set);
    timeval second = {1, 0};
    if (select(peer + 1, &set, nullptr, nullptr, &second) != 1) return -1;
    return read(peer, &packet, sizeof packet);
  }
};

}  // namespace tactus::can
