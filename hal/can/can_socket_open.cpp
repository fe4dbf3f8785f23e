// How a CanSocket is opened, waited for and closed.
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <string_view>

#include "hal/can/can_socket.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::can {
namespace {

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

Waited CanSocket::wait(std::int64_t timeout_ns) const {
  pollfd polled = {socket_, POLLIN, 0};
  const timespec timeout = {timeout_ns / kSecond_ns, timeout_ns % kSecond_ns};
  const int ready = ppoll(&polled, 1, &timeout, nullptr);
  if (ready < 0 && errno == EINTR) return Waited::kInterrupted;
  return ready > 0 ? Waited::kSomething : Waited::kNothing;
}

void CanSocket::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

}  // namespace tactus::can
