// The cycle of a CanSocket; how it is opened is in can_socket_open.cpp.
#include "hal/can/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <poll.h>
#include <sys/time.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "kernel/core/nanoseconds.hpp"

namespace tactus::can {
namespace {

static_assert(sizeof(can_frame) == CAN_MTU && sizeof(canfd_frame) == CANFD_MTU);
static_assert(kErrorData == CAN_MAX_DLEN && kMaxData == CANFD_MAX_DLEN);

/// Returns true if `error` says that the queue has no room now. A signal does not interrupt a send
/// that does not wait.
bool is_full(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == ENOBUFS;
}

}  // namespace

int CanSocket::receive(CanFrame* frames, int capacity) {
  const int most = std::min(capacity, kBatch);
  if (socket_ < 0 || most <= 0) return 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(most); ++i) {
    batch_.pieces[i] = {batch_.packets[i].data(), kPacket};
    msghdr& header = batch_.headers[i].msg_hdr;
    header = msghdr{};
    header.msg_iov = &batch_.pieces[i];
    header.msg_iovlen = 1;
    header.msg_control = batch_.controls[i].data();
    header.msg_controllen = kControl;
  }
  ++system_calls_;
  const int got =
      recvmmsg(socket_, batch_.headers.data(), static_cast<unsigned>(most), MSG_DONTWAIT, nullptr);
  if (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) health_.lost = true;
  int count = 0;
  for (int i = 0; i < got; ++i) {
    const mmsghdr& header = batch_.headers[static_cast<std::size_t>(i)];
    // A closed packet socket gives packets without bytes, and so does a peer that sends them.
    if (header.msg_len == 0 && hung_up()) {
      health_.lost = true;
      break;
    }
    if (take_packet(header, frames[count])) ++count;
  }
  return count;
}

bool CanSocket::take_packet(const mmsghdr& header, CanFrame& frame) {
  canfd_frame packet{};
  frame = CanFrame();
  take_control(header, frame);
  const bool long_packet = fd_ && header.msg_len == CANFD_MTU;
  const bool whole = (header.msg_hdr.msg_flags & MSG_TRUNC) == 0;
  if (whole && (header.msg_len == CAN_MTU || long_packet))
    std::memcpy(&packet, header.msg_hdr.msg_iov->iov_base, header.msg_len);
  else
    packet.len = UINT8_MAX;
  const bool error = (packet.can_id & CAN_ERR_FLAG) != 0;
  const bool error_frame = !long_packet && packet.len == CAN_ERR_DLC;
  if (packet.len > (long_packet ? kMaxData : kClassicData) || (error && !error_frame)) {
    ++health_.malformed;
    return false;
  }
  if (error) {
    std::uint8_t data[kErrorData];
    std::memcpy(data, packet.data, sizeof data);
    health_.take_error(packet.can_id & CAN_ERR_MASK, data);
    return false;
  }
  if ((packet.can_id & CAN_EFF_FLAG) != 0) {
    ++health_.foreign;
    return false;
  }
  const std::uint32_t id = packet.can_id & CAN_SFF_MASK;
  if (!wanted(id)) return false;
  frame.id = static_cast<std::uint16_t>(id);
  frame.fd = long_packet;
  frame.remote = (packet.can_id & CAN_RTR_FLAG) != 0;
  frame.size = frame.remote ? std::uint8_t{0} : packet.len;
  std::memcpy(frame.data.data(), packet.data, frame.size);
  return true;
}

void CanSocket::take_control(const mmsghdr& header, CanFrame& frame) {
  auto* control = const_cast<msghdr*>(&header.msg_hdr);
  for (cmsghdr* item = CMSG_FIRSTHDR(control); item != nullptr; item = CMSG_NXTHDR(control, item)) {
    if (item->cmsg_level != SOL_SOCKET) continue;
    if (item->cmsg_type == SCM_TIMESTAMPNS && item->cmsg_len >= CMSG_LEN(sizeof(timespec))) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(item), sizeof stamp);
      frame.stamp_ns = stamp.tv_sec * kSecond_ns + stamp.tv_nsec;
    } else if (item->cmsg_type == SO_RXQ_OVFL &&
               item->cmsg_len >= CMSG_LEN(sizeof health_.dropped)) {
      std::memcpy(&health_.dropped, CMSG_DATA(item), sizeof health_.dropped);
    }
  }
}

bool CanSocket::hung_up() const {
  pollfd polled = {socket_, POLLRDHUP, 0};
  return poll(&polled, 1, 0) > 0;  // negative: a signal came, which proves nothing
}

Sent CanSocket::send(const CanFrame* frames, int count) {
  assert(count <= kBatch);
  const int most = std::min(count, kBatch);
  if (socket_ < 0 || health_.lost) return Sent::kLost;
  if (most <= 0) return Sent::kAll;
  for (std::size_t i = 0; i < static_cast<std::size_t>(most); ++i) {
    batch_.pieces[i] = {batch_.packets[i].data(), write_packet(frames[i], batch_.packets[i])};
    msghdr& header = batch_.headers[i].msg_hdr;
    header = msghdr{};
    header.msg_iov = &batch_.pieces[i];
    header.msg_iovlen = 1;
  }
  ++system_calls_;
  const int sent = sendmmsg(socket_, batch_.headers.data(), static_cast<unsigned>(most),
                            MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent == count) return Sent::kAll;
  const int error = sent < 0 ? errno : EAGAIN;  // of a batch sent in part, the next call names it
  health_.unsent += static_cast<std::uint32_t>(count - std::max(sent, 0));
  if (is_full(error)) return Sent::kQueueFull;
  health_.lost = true;
  return Sent::kLost;
}

std::size_t CanSocket::write_packet(const CanFrame& frame,
                                    std::array<std::uint8_t, kPacket>& packet) const {
  const bool long_packet = fd_ && frame.fd;
  assert(long_packet == frame.fd && frame.size <= (frame.fd ? kMaxData : kClassicData));
  canfd_frame raw{};
  raw.can_id = frame.id & CAN_SFF_MASK;
  if (frame.remote) raw.can_id |= CAN_RTR_FLAG;
  const std::size_t size = std::min<std::size_t>(frame.size, long_packet ? kMaxData : kClassicData);
  raw.len = static_cast<std::uint8_t>(long_packet ? fd_size(size) : size);
  if (long_packet) raw.flags = CANFD_BRS;
  if (!frame.remote) std::memcpy(raw.data, frame.data.data(), size);
  const std::size_t bytes = long_packet ? CANFD_MTU : CAN_MTU;
  std::memcpy(packet.data(), &raw, bytes);
  return bytes;
}

}  // namespace tactus::can
