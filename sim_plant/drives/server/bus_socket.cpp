#include "sim_plant/drives/server/bus_socket.hpp"

#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace tactus::drives {

BusSocket::~BusSocket() {
  if (socket_ >= 0) close(socket_);
}

bool BusSocket::open(const char* interface, bool fd) {
  what_ = "the kernel has no CAN";
  socket_ = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (socket_ < 0) return false;
  what_ = "CAN FD is not available";
  const int on = 1;
  if (fd && setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) != 0) return false;
  what_ = "the interface does not exist";
  const unsigned index = if_nametoindex(interface);
  if (index == 0) return false;
  what_ = "the interface cannot be used";
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  return bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

bool BusSocket::adopt(int descriptor) {
  what_ = "the descriptor is not open";
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) != 0) return false;
  socket_ = descriptor;
  return true;
}

bool BusSocket::receive(can::CanFrame& frame) {
  for (;;) {
    canfd_frame raw{};
    const ssize_t got = recv(socket_, &raw, sizeof raw, MSG_DONTWAIT);
    if (got == 0) {
      close(socket_);
      socket_ = -1;
    }
    if (got <= 0) return false;
    const bool fd = got == CANFD_MTU;
    if (!fd && got != CAN_MTU) continue;
    if ((raw.can_id & (CAN_EFF_FLAG | CAN_ERR_FLAG)) != 0) continue;
    if (raw.len > (fd ? can::kMaxData : can::kClassicData)) continue;
    frame = {};
    frame.id = static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK);
    frame.size = raw.len;
    frame.fd = fd;
    frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
    if (!frame.remote) std::memcpy(frame.data.data(), raw.data, raw.len);
    return true;
  }
}

bool BusSocket::send(const can::CanFrame& frame) {
  canfd_frame raw{};
  raw.can_id = frame.id;
  raw.len = frame.size;
  if (frame.fd) raw.flags = CANFD_BRS;
  std::memcpy(raw.data, frame.data.data(), frame.size);
  const std::size_t size = frame.fd ? CANFD_MTU : CAN_MTU;
  if (::send(socket_, &raw, size, MSG_DONTWAIT | MSG_NOSIGNAL) >= 0) return true;
  return errno != EAGAIN && errno != EWOULDBLOCK && errno != ENOBUFS;
}

}  // namespace tactus::drives
