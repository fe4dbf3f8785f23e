// CanSocket: the cycle first, then opening, waiting and closing.
#include "hal/can/can_socket.hpp"

#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <string_view>

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

constexpr std::string_view kInherited = "fd:";
// The kernel charges about 800 bytes for a frame, doubles this number, and limits it to
// net.core.rmem_max, usually 208 KiB: some 500 frames.
constexpr int kReceiveBuffer = 1 << 20;

template <class T>
bool set_option(int socket, int level, int option, const T& value) {
  return setsockopt(socket, level, option, &value, sizeof value) == 0;
}

void prepare(int socket) {
  constexpr int kYes = 1;
  // The stamp of the kernel's clock: a controller's own clock would not be comparable to the
  // host's.
  set_option(socket, SOL_SOCKET, SO_TIMESTAMPNS, kYes);
  set_option(socket, SOL_SOCKET, SO_RXQ_OVFL, kYes);
  set_option(socket, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer);
  fcntl(socket, F_SETFD, FD_CLOEXEC);
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
}

bool carries_packets(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0 &&
         (type == SOCK_SEQPACKET || type == SOCK_DGRAM || type == SOCK_RAW);
}

Status lost(const char* interface, std::string_view reason, Message& why) {
  why = Message();
  why << "bus " << interface << ": " << reason;
  return Status::kConnectionLost;
}

/// Frames with 29-bit identifiers do not pass.
bool filter_in_kernel(int socket, const CanFilter* filters, int count) {
  if (count <= 0) return true;
  std::array<can_filter, CanSocket::kMostFilters> rows{};
  for (int i = 0; i < count; ++i)
    rows[static_cast<std::size_t>(i)] = {filters[i].id, filters[i].mask | CAN_EFF_FLAG};
  return setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, rows.data(),
                    static_cast<socklen_t>(sizeof(can_filter) * static_cast<unsigned>(count))) == 0;
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
  return poll(&polled, 1, 0) > 0;  // negative: a signal arrived, which proves nothing
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

Status CanSocket::open(const char* interface, bool fd, const CanFilter* filters, int count,
                       Message& why) {
  close();
  if (count > kMostFilters) {
    why = Message();
    why << "bus " << interface << ": " << count << " filters, at most " << kMostFilters;
    return Status::kTooLarge;
  }
  if (std::string_view(interface).substr(0, kInherited.size()) == kInherited)
    return inherit(interface, fd, filters, count, why);
  const int descriptor = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor < 0) {
    const int error = errno;
    const Status status = lost(interface, std::strerror(error), why);
    if (error != EAFNOSUPPORT && error != EPROTONOSUPPORT) return status;
    why << "; this kernel has no SocketCAN: load the modules can and can_raw";
    return Status::kNotOffered;
  }
  begin(descriptor, fd, filters, count);
  constexpr can_err_mask_t kErrors = CAN_ERR_MASK & ~CAN_ERR_LOSTARB;
  Status status = Status::kOk;
  if (!set_option(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrors) ||
      !filter_in_kernel(socket_, filters, count))
    status = lost(interface, std::strerror(errno), why);
  if (status == Status::kOk) status = bind_to(interface, fd, why);
  if (status != Status::kOk) close();
  return status;
}

Status CanSocket::bind_to(const char* interface, bool fd, Message& why) {
  ifreq request{};
  if (std::strlen(interface) >= sizeof request.ifr_name)
    return lost(interface, "the name is longer than an interface's can be", why);
  std::strncpy(request.ifr_name, interface, sizeof request.ifr_name - 1);
  if (ioctl(socket_, SIOCGIFINDEX, &request) != 0)
    return lost(interface, "there is no such interface; `ip -brief link` lists them", why);
  const int index = request.ifr_ifindex;
  if (ioctl(socket_, SIOCGIFFLAGS, &request) != 0)
    return lost(interface, std::strerror(errno), why);
  if ((request.ifr_flags & IFF_UP) == 0)
    return lost(interface, "the interface is down; set its bit rate and `ip link set` it up", why);
  if (fd && (ioctl(socket_, SIOCGIFMTU, &request) != 0 || request.ifr_mtu != CANFD_MTU))
    return lost(interface, "the interface is not set to CAN FD (its MTU is not 72)", why);
  constexpr int kYes = 1;
  if (fd && !set_option(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, kYes))
    return lost(interface, "the kernel's sockets do not offer CAN FD", why);
  if (ioctl(socket_, SIOCGIFTXQLEN, &request) == 0) queue_frames_ = request.ifr_qlen;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return lost(interface, errno == ENODEV ? "not a CAN interface" : std::strerror(errno), why);
  return Status::kOk;
}

Status CanSocket::inherit(const char* interface, bool fd, const CanFilter* filters, int count,
                          Message& why) {
  std::string_view digits = interface;
  digits.remove_prefix(kInherited.size());
  int descriptor = -1;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), descriptor);
  if (error != std::errc() || end != digits.data() + digits.size() || descriptor < 0)
    return lost(interface, "after fd: comes the number of a descriptor", why);
  if (!carries_packets(descriptor))
    return lost(interface, "the descriptor is not an open packet socket", why);
  begin(descriptor, fd, filters, count);
  return Status::kOk;
}

void CanSocket::adopt(int descriptor, bool fd, const CanFilter* filters, int count) {
  close();
  begin(descriptor, fd, filters, count);
}

void CanSocket::begin(int descriptor, bool fd, const CanFilter* filters, int count) {
  socket_ = descriptor;
  fd_ = fd;
  system_calls_ = 0;
  queue_frames_ = -1;
  health_ = LinkHealth();
  want(filters, count);
  prepare(socket_);
}

void CanSocket::want(const CanFilter* filters, int count) {
  wanted_.fill(count > 0 ? 0 : ~std::uint32_t{0});
  for (int i = 0; i < count; ++i)
    for (std::uint32_t id = 0; id < kIdentifiers; ++id)
      if (((id ^ filters[i].id) & filters[i].mask) == 0) wanted_[id / 32] |= 1U << id % 32;
}

WaitResult CanSocket::wait(std::int64_t timeout_ns) const {
  pollfd polled = {socket_, POLLIN, 0};
  const timespec timeout = {timeout_ns / kSecond_ns, timeout_ns % kSecond_ns};
  const int ready = ppoll(&polled, 1, &timeout, nullptr);
  if (ready < 0 && errno == EINTR) return WaitResult::kInterrupted;
  return ready > 0 ? WaitResult::kSomething : WaitResult::kNothing;
}

void CanSocket::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

}  // namespace tactus::can
