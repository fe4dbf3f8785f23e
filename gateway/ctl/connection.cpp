#include "gateway/ctl/connection.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tactus::ctl {
namespace {

constexpr std::size_t kHead = 4;

std::uint32_t length_of(const std::string& bytes) {
  std::uint32_t length = 0;
  for (std::size_t i = kHead; i-- > 0;) length = length << 8 | static_cast<std::uint8_t>(bytes[i]);
  return length;
}

bool wait_for(int socket, short events, int timeout_ms) {
  pollfd waiting = {socket, events, 0};
  int ready = 0;
  do {
    ready = poll(&waiting, 1, timeout_ms);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

}  // namespace

bool Connection::fail(const std::string& reason) {
  error_ = reason;
  close();
  return false;
}

void Connection::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

bool Connection::open(const std::string& address, int timeout_ms) {
  if (address.rfind("unix:", 0) == 0) return open_unix(address.substr(5), timeout_ms);
  const std::size_t colon = address.rfind(':');
  if (address.rfind("tcp:", 0) == 0 && colon > 4)
    return open_tcp(address.substr(4, colon - 4), address.substr(colon + 1), timeout_ms);
  return fail("'" + address + "' is no address; write unix:PATH or tcp:HOST:PORT");
}

bool Connection::open_unix(const std::string& path, int timeout_ms) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path)
    return fail("unix:" + path + ": the path is empty or longer than 107 bytes");
  std::memcpy(address.sun_path, path.data(), path.size());
  socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (connect_within(&address, sizeof address, timeout_ms)) return true;
  return fail("unix:" + path + ": " + std::strerror(errno) +
              "; is 'tactus serve' running with this socket?");
}

bool Connection::open_tcp(const std::string& host, const std::string& port, int timeout_ms) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  const std::string place = "tcp:" + host + ":" + port + ": ";
  const int code = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (code != 0) return fail(place + gai_strerror(code) + "; write tcp:HOST:PORT");
  bool connected = false;
  for (const addrinfo* one = found; one != nullptr && !connected; one = one->ai_next) {
    close();
    socket_ =
        socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, one->ai_protocol);
    connected = connect_within(one->ai_addr, one->ai_addrlen, timeout_ms);
  }
  const int reason = errno;
  freeaddrinfo(found);
  if (!connected)
    return fail(place + std::strerror(reason) + "; is 'tactus serve' running at this address?");
  const int on = 1;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return true;
}

bool Connection::connect_within(const void* address, std::size_t size, int timeout_ms) {
  if (socket_ < 0) return false;
  const auto* generic = static_cast<const sockaddr*>(address);
  if (connect(socket_, generic, static_cast<socklen_t>(size)) == 0) return true;
  if (errno != EINPROGRESS && errno != EAGAIN && errno != EINTR) return false;
  if (!wait_for(socket_, POLLOUT, timeout_ms)) {
    errno = ETIMEDOUT;
    return false;
  }
  int error = 0;
  socklen_t length = sizeof error;
  getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &length);
  errno = error;
  return error == 0;
}

bool Connection::send(const ToServer& message, int timeout_ms) {
  if (socket_ < 0) return false;
  std::string bytes(kHead, '\0');
  message.AppendToString(&bytes);
  const std::size_t length = bytes.size() - kHead;
  for (std::size_t i = 0; i < kHead; ++i) bytes[i] = static_cast<char>(length >> (8 * i) & 0xff);
  return send_all(tunnel_ ? tunnel_->seal(bytes) : bytes, timeout_ms);
}

bool Connection::send_all(const std::string& bytes, int timeout_ms) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t taken = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (taken > 0) {
      sent += static_cast<std::size_t>(taken);
    } else if (errno == EAGAIN) {
      if (!wait_for(socket_, POLLOUT, timeout_ms)) return fail("the server does not read");
    } else if (errno != EINTR) {
      return fail(std::string("the server is gone: ") + std::strerror(errno));
    }
  }
  return true;
}

bool Connection::receive_exactly(std::string& bytes, std::size_t count, int timeout_ms) {
  bytes.assign(count, '\0');
  for (std::size_t have = 0; have < count;) {
    if (!wait_for(socket_, POLLIN, timeout_ms)) return false;
    const ssize_t result = recv(socket_, bytes.data() + have, count - have, 0);
    if (result == 0 || (result < 0 && errno != EAGAIN && errno != EINTR)) return false;
    have += result > 0 ? static_cast<std::size_t>(result) : 0;
  }
  return true;
}

bool Connection::encrypt(const std::string& key_file, int timeout_ms) {
  Key key;
  Message why;
  if (!read_key(key_file.c_str(), key, why)) return fail(std::string(why.c_str()));
  ClientTunnel& tunnel = tunnel_.emplace();
  const std::string hello = tunnel.hello();
  std::string answer;
  const bool agreed = !hello.empty() && send_all(hello, timeout_ms) &&
                      receive_exactly(answer, ClientTunnel::kAnswerBytes, timeout_ms) &&
                      send_all(tunnel.agree(key, answer), timeout_ms);
  sodium_memzero(key.data(), key.size());
  return agreed || fail("the server does not answer to a key; is it started with --key?");
}

bool Connection::take_message(ToClient& message, ReceiveResult& result) {
  if (received_.size() < kHead) return false;
  const std::uint32_t length = length_of(received_);
  if (length <= kLongest && received_.size() < kHead + length) return false;
  result = ReceiveResult::kMessage;
  if (length > kLongest ||
      !message.ParseFromArray(received_.data() + kHead, static_cast<int>(length))) {
    fail("the server sends no messages of this protocol; is the address that of 'tactus serve'?");
    result = ReceiveResult::kGone;
  }
  received_.erase(0, kHead + length);
  return true;
}

Connection::ReceiveResult Connection::fail_key() {
  fail("the server does not have this key, or somebody changes what is sent; give its key file");
  return ReceiveResult::kGone;
}

Connection::ReceiveResult Connection::receive(ToClient& message) {
  ReceiveResult result = ReceiveResult::kNothing;
  while (!take_message(message, result)) {
    if (socket_ < 0) return ReceiveResult::kGone;
    char bytes[4096];
    const ssize_t count = recv(socket_, bytes, sizeof bytes, 0);
    if (count > 0) {
      (tunnel_ ? sealed_ : received_).append(bytes, static_cast<std::size_t>(count));
      if (tunnel_ && !tunnel_->open(sealed_, received_)) {
        return fail_key();
      }
      opened_ = !received_.empty() || opened_;
    } else if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
      return ReceiveResult::kNothing;
    } else {
      if (tunnel_ && !opened_) return fail_key();
      fail(count == 0 ? std::string("the server has closed the connection")
                      : std::string("the server is gone: ") + std::strerror(errno));
      return ReceiveResult::kGone;
    }
  }
  return result;
}

}  // namespace tactus::ctl
