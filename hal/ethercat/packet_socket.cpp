#include "hal/ethercat/packet_socket.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>

#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

constexpr int kBufferBytes = 64 * 1024;  // of frames that wait: as many as come in some cycles

}  // namespace

Status PacketSocket::refuse(Status status, const char* what, const char* remedy, Message& why) {
  const int error = errno;
  why << what;
  if (error != 0) why << ": " << std::strerror(error);
  why << "; " << remedy;
  close();
  return status;
}

Status PacketSocket::open(const char* interface, Message& why) {
  close();
  lost_ = false;
  system_calls_ = 0;
  why = Message("interface ");
  why << interface << ": ";
  TRY(claim(interface, why));
  errno = 0;
  socket_ = ::socket(AF_PACKET, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0)
    return refuse(Status::kNotOffered, "no packet socket",
                  "run as root, or give the program CAP_NET_RAW", why);
  return bind_to(interface, why);
}

/// Binds an abstract name: it is of the network namespace, as the interface, and goes with the
/// process, however that ends.
Status PacketSocket::claim(const char* interface, Message& why) {
  errno = 0;
  claim_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  Text<sizeof name.sun_path - 2> text("tactus-ethercat-");
  text << interface;
  const std::string_view shown = text;
  std::memcpy(name.sun_path + 1, shown.data(), shown.size());  // after a zero: abstract
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + shown.size());
  if (claim_ >= 0 && bind(claim_, reinterpret_cast<const sockaddr*>(&name), size) == 0)
    return Status::kOk;
  const bool taken = errno == EADDRINUSE;
  if (taken) errno = 0;
  return taken ? refuse(Status::kBusConflict, "another Tactus program uses it", "end it first", why)
               : refuse(Status::kNotOffered, "no socket that claims it",
                        "see the limit of open files (`ulimit -n`)", why);
}

Status PacketSocket::bind_to(const char* interface, Message& why) {
  ifreq request{};
  if (std::strlen(interface) >= sizeof request.ifr_name) {
    errno = 0;
    return refuse(Status::kBadValue, "the name is too long", "see `ip link`", why);
  }
  std::strncpy(request.ifr_name, interface, sizeof request.ifr_name - 1);
  if (ioctl(socket_, SIOCGIFHWADDR, &request) != 0)
    return refuse(Status::kBadValue, "cannot be found", "see `ip link`", why);
  errno = 0;
  if (request.ifr_hwaddr.sa_family != ARPHRD_ETHER)
    return refuse(Status::kBadValue, "is not Ethernet", "see `ip link`", why);
  std::memcpy(address_.data(), request.ifr_hwaddr.sa_data, address_.size());
  if (ioctl(socket_, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0 ||
      (request.ifr_flags & IFF_RUNNING) == 0)
    return refuse(Status::kConnectionLost, "is down, or has no cable",
                  "plug it in, and `ip link set ... up`", why);
  const int on = 1, bytes = kBufferBytes;
  // Old kernels refuse it; then the copies stay in the queue and are recognized by their type.
  (void)setsockopt(socket_, SOL_PACKET, PACKET_QDISC_BYPASS, &on, sizeof on);
  (void)setsockopt(socket_, SOL_PACKET, PACKET_IGNORE_OUTGOING, &on, sizeof on);
  (void)setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(kEtherType);
  address.sll_ifindex = static_cast<int>(if_nametoindex(interface));
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return refuse(Status::kNotOffered, "cannot be bound", "see `ip link`", why);
  why = {};
  return Status::kOk;
}

bool PacketSocket::adopt(int descriptor) {
  close();
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) != 0) return false;
  socket_ = descriptor;
  lost_ = false;
  return true;
}

void PacketSocket::close() {
  if (socket_ >= 0) ::close(socket_);
  if (claim_ >= 0) ::close(claim_);
  socket_ = claim_ = -1;
}

/// A copy of an own frame, from a kernel that cannot leave it out, counts as none.
bool PacketSocket::receive(Frame& frame) {
  if (socket_ < 0) return false;
  sockaddr_ll from{};
  socklen_t size = sizeof from;
  ++system_calls_;
  const ssize_t got = recvfrom(socket_, frame.bytes.data(), frame.bytes.size(),
                               MSG_DONTWAIT | MSG_TRUNC, reinterpret_cast<sockaddr*>(&from), &size);
  if (got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR))
    lost_ = true;
  frame.size = 0;
  if (got <= 0) return false;
  const bool own = from.sll_family == AF_PACKET && from.sll_pkttype == PACKET_OUTGOING;
  if (!own && static_cast<std::size_t>(got) <= frame.bytes.size())
    frame.size = static_cast<std::size_t>(got);
  return true;
}

bool PacketSocket::send(const Frame& frame) {
  if (socket_ < 0) return false;
  ++system_calls_;
  if (::send(socket_, frame.bytes.data(), frame.size, MSG_DONTWAIT | MSG_NOSIGNAL) >= 0)
    return true;
  if (errno == ENETDOWN || errno == ENXIO || errno == ENODEV || errno == EPIPE) lost_ = true;
  return false;
}

bool PacketSocket::wait(std::int64_t longest_ns) {
  pollfd polled{socket_, POLLIN, 0};
  const timespec longest = {longest_ns / kSecond_ns, longest_ns % kSecond_ns};
  return ppoll(&polled, 1, &longest, nullptr) >= 0 || errno != EINTR;
}

}  // namespace tactus::ethercat
