#include "sim_plant/ur/server/server.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>

#include <ctime>

namespace tactus::ur {
namespace {

constexpr std::size_t kAtOnce = 64 * 1024;  // bytes read from one client at a time
constexpr int kLastReads = 16;              // from a client that has hung up

void set_no_delay(int socket) {
  const int on = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

bool fill(const char* address, int port, sockaddr_in& into) {
  into = {};
  into.sin_family = AF_INET;
  into.sin_port = htons(static_cast<std::uint16_t>(port));
  return inet_pton(AF_INET, address, &into.sin_addr) == 1;
}

int listen_at(const char* address, int port) {
  sockaddr_in place;
  if (!fill(address, port, place)) {
    errno = EINVAL;
    return -1;
  }
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return -1;
  const int on = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const auto* generic = reinterpret_cast<const sockaddr*>(&place);
  if (bind(socket, generic, sizeof place) == 0 && listen(socket, 8) == 0) return socket;
  const int error = errno;
  close(socket);
  errno = error;
  return -1;
}

/// Sends as many bytes as the socket takes. False: the peer is gone.
bool send_some(int socket, Outbox& out) {
  while (!out.empty()) {
    const ssize_t sent = send(socket, out.data(), out.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    out.sent(static_cast<std::size_t>(sent));
  }
  return true;
}

}  // namespace

bool Server::start(const char* address, int port_offset) {
  link_sockets_.fill(-1);
  for (Listener& listener : listeners_) {
    listener.socket = listen_at(address, listener.port + port_offset);
    if (listener.socket >= 0) continue;
    const int error = errno;
    stop();
    errno = error;
    return false;
  }
  return true;
}

void Server::stop() {
  for (Listener& listener : listeners_) {
    if (listener.socket >= 0) close(listener.socket);
    listener.socket = -1;
  }
  for (Connection& connection : connections_)
    if (connection.socket >= 0) show_out(connection);
  for (std::size_t i = 0; i < link_sockets_.size(); ++i) close_link(i);
}

/// Lists listeners, then connections, then links; those not open have -1, which poll ignores.
int Server::build_poll_list() {
  std::size_t n = 0;
  for (const Listener& listener : listeners_) polled_[n++] = {listener.socket, POLLIN, 0};
  for (const Connection& connection : connections_) {
    short events = POLLIN;
    if (connection.socket >= 0 && !emulator_.outbox(connection.session).empty()) events |= POLLOUT;
    polled_[n++] = {connection.socket, events, 0};
  }
  for (std::size_t i = 0; i < link_sockets_.size(); ++i) {
    Link& link = emulator_.links().all()[i];
    short events = link.room() > 0 ? POLLIN : 0;
    if (!link.open() || !link.outbox().empty()) events |= POLLOUT;
    polled_[n++] = {link_sockets_[i], events, 0};
  }
  return static_cast<int>(n);
}

void Server::pump(std::int64_t timeout_ns) {
  for (std::size_t i = 0; i < link_sockets_.size(); ++i) connect_link(i);
  const int count = build_poll_list();
  timespec timeout;
  timeout.tv_sec = static_cast<time_t>(timeout_ns / 1'000'000'000);
  timeout.tv_nsec = static_cast<long>(timeout_ns % 1'000'000'000);
  if (ppoll(polled_.data(), static_cast<nfds_t>(count), &timeout, nullptr) <= 0) return;
  const pollfd* polled = polled_.data();
  // Guests before listeners, so that events of a closed connection do not count for a new one in
  // the same place.
  for (std::size_t i = 0; i < kGuests; ++i) {
    const short events = polled[kDoors + i].revents;
    if (connections_[i].socket >= 0 && (events & (POLLIN | POLLHUP | POLLERR)) != 0)
      read_from(connections_[i]);
    if (connections_[i].socket >= 0) write_to(connections_[i]);
  }
  for (std::size_t i = 0; i < link_sockets_.size(); ++i)
    if (link_sockets_[i] >= 0) serve_link(i, polled[kDoors + kGuests + i].revents);
  for (std::size_t i = 0; i < kDoors; ++i)
    if ((polled[i].revents & POLLIN) != 0) let_in(listeners_[i]);
}

void Server::flush() {
  for (Connection& connection : connections_)
    if (connection.socket >= 0) write_to(connection);
  for (std::size_t i = 0; i < link_sockets_.size(); ++i) {
    connect_link(i);
    Link& link = emulator_.links().all()[i];
    if (link_sockets_[i] >= 0 && link.open() && !send_some(link_sockets_[i], link.outbox()))
      link.lost();
  }
}

void Server::let_in(Listener& listener) {
  const int socket = accept4(listener.socket, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (socket < 0) return;
  set_no_delay(socket);
  const int session = find_place(listener.service);
  if (session < 0) {
    close(socket);
    return;
  }
  for (Connection& connection : connections_) {
    if (connection.socket >= 0) continue;
    connection = {socket, session, listener.reads, listener.port};
    write_to(connection);
    return;
  }
}

/// Opens a session; if all places are taken, in the place of a client that is idle.
int Server::find_place(Service service) {
  const int session = emulator_.open(service);
  const int idle = session < 0 ? emulator_.find_idle(service) : -1;
  if (idle < 0) return session;
  for (Connection& connection : connections_)
    if (connection.socket >= 0 && connection.session == idle) show_out(connection);
  return emulator_.open(service);
}

bool Server::read_some(Connection& connection) {
  static std::array<std::uint8_t, kAtOnce> bytes;
  const ssize_t got = recv(connection.socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (got > 0 && connection.reads)
    emulator_.receive(connection.session, bytes.data(), static_cast<std::size_t>(got));
  return got > 0;
}

void Server::read_from(Connection& connection) {
  errno = 0;  // stays 0 at the end of the stream
  if (read_some(connection) || errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return;
  show_out(connection);
}

void Server::write_to(Connection& connection) {
  Outbox& out = emulator_.outbox(connection.session);
  const bool there = send_some(connection.socket, out);
  // Bytes sent before a client hung up count: they may be a whole program.
  for (int n = 0; !there && n < kLastReads && read_some(connection); ++n) {
  }
  if (there && emulator_.stalled(connection.session))
    std::fprintf(stderr, "port %d: a client that reads nothing was disconnected\n",
                 connection.port);
  if (!there || emulator_.ended(connection.session)) show_out(connection);
}

void Server::show_out(Connection& connection) {
  emulator_.close(connection.session);
  close(connection.socket);
  connection = {};
}

void Server::connect_link(std::size_t i) {
  Link& link = emulator_.links().all()[i];
  int& socket = link_sockets_[i];
  const bool over = link.state() == Link::State::kClosed || link.state() == Link::State::kWanted ||
                    link.state() == Link::State::kFailed;
  if (over && socket >= 0) {
    if (link.state() == Link::State::kClosed) send_some(socket, link.outbox());
    close_link(i);
  }
  if (link.state() != Link::State::kWanted) return;
  sockaddr_in place;
  if (!fill(link.host(), link.port(), place)) return link.failed();
  socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return link.failed();
  set_no_delay(socket);
  link.connecting();
  const auto* generic = reinterpret_cast<const sockaddr*>(&place);
  if (connect(socket, generic, sizeof place) == 0) return link.connected();
  if (errno == EINPROGRESS) return;
  close_link(i);
  link.failed();
}

void Server::close_link(std::size_t i) {
  if (link_sockets_[i] >= 0) close(link_sockets_[i]);
  link_sockets_[i] = -1;
}

void Server::serve_link(std::size_t i, short events) {
  Link& link = emulator_.links().all()[i];
  if (link.state() == Link::State::kConnecting && (events & (POLLOUT | POLLERR | POLLHUP)) != 0) {
    int error = 0;
    socklen_t size = sizeof error;
    getsockopt(link_sockets_[i], SOL_SOCKET, SO_ERROR, &error, &size);
    if (error == 0) return link.connected();
    close_link(i);
    return link.failed();
  }
  if (!link.open()) return;
  if ((events & (POLLIN | POLLHUP | POLLERR)) != 0 && link.room() > 0) {
    static std::array<std::uint8_t, kAtOnce> bytes;
    const std::size_t room = std::min(link.room(), bytes.size());
    const ssize_t got = recv(link_sockets_[i], bytes.data(), room, MSG_DONTWAIT);
    if (got > 0) link.receive(bytes.data(), static_cast<std::size_t>(got));
    const bool later = got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
    if (got <= 0 && !later) {
      link.lost();
      close_link(i);
      return;
    }
  }
  if (!send_some(link_sockets_[i], link.outbox())) link.lost();
}

}  // namespace tactus::ur
