#include "hal/net/socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

#include "kernel/core/nanoseconds.hpp"

namespace tactus::ur {
namespace {

/// Returns false after the time-out or a signal.
bool wait_for(int socket, short events, std::int64_t timeout_ns) {
  pollfd polled = {socket, events, 0};
  const timespec timeout = {timeout_ns / kSecond_ns, timeout_ns % kSecond_ns};
  return ppoll(&polled, 1, &timeout, nullptr) > 0;
}

/// Returns 0 or the errno.
int finish_connecting(int socket, const Deadline& deadline) {
  if (!wait_for(socket, POLLOUT, deadline.left_ns())) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

}  // namespace

bool is_ipv4(const char* address) {
  in_addr number{};
  return inet_pton(AF_INET, address, &number) == 1;
}

/// Returns 0, EINPROGRESS or the errno.
int Socket::open(const char* address, int port) {
  close();
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, address, &to.sin_addr) != 1) return EINVAL;
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) return errno;
  constexpr int kYes = 1;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &kYes, sizeof kYes);
  const bool connected = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  return connected ? 0 : errno;
}

bool Socket::begin(const char* address, int port) {
  const int error = open(address, port);
  if (error == 0 || error == EINPROGRESS) return true;
  close();
  return false;
}

Status Socket::connect(const char* address, int port, const Deadline& deadline, Message& why) {
  int error = open(address, port);
  if (error == EINPROGRESS) error = finish_connecting(socket_, deadline);
  if (error == 0) return Status::kOk;
  close();
  why = Message();
  why << address << " port " << port << ": " << std::strerror(error);
  return Status::kConnectionLost;
}

bool Socket::wait(std::int64_t timeout_ns) const {
  return wait_for(socket_, POLLIN, timeout_ns);
}

long Socket::receive(std::uint8_t* data, std::size_t size) {
  const ssize_t got = ::recv(socket_, data, size, 0);
  if (got > 0) return got;
  return got < 0 && (errno == EAGAIN || errno == EINTR) ? 0 : -1;
}

Socket::Sent Socket::send(const std::uint8_t* data, std::size_t size) {
  const ssize_t sent = ::send(socket_, data, size, MSG_NOSIGNAL);
  if (sent == static_cast<ssize_t>(size)) return Sent::kAll;
  return sent < 0 && (errno == EAGAIN || errno == EINTR) ? Sent::kNothing : Sent::kLost;
}

bool Socket::send_some(std::string_view& text) {
  const ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
  if (sent > 0) text.remove_prefix(static_cast<std::size_t>(sent));
  return sent >= 0 || errno == EAGAIN || errno == EINTR;
}

void Socket::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

}  // namespace tactus::ur
