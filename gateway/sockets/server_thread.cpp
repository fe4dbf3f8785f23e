#include "gateway/sockets/server_thread.hpp"

#include <poll.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hal/os/cycle_clock.hpp"
#include "hal/os/ordinary_thread.hpp"

namespace tactus {
namespace {

// A report waits for so long at most; without clients only snapshots are thrown away.
constexpr int kBusy_ms = 1, kIdle_ms = 10;
constexpr int kDatagramsPerTurn = 64;

}  // namespace

int ServerThread::start() {
  sockets_.fill(-1);
  const int error = start_ordinary_thread(thread_, run, this);
  started_ = error == 0;
  return error;
}

void ServerThread::end() {
  if (!started_) return;
  ended_.store(true, std::memory_order_release);
  pthread_join(thread_, nullptr);
  started_ = false;
  const int joining = joining_.exchange(-1);
  if (joining >= 0) ::close(joining);
}

bool ServerThread::join(int socket) {
  int none = -1;
  return joining_.compare_exchange_strong(none, socket);
}

void* ServerThread::run(void* thread) {
  static_cast<ServerThread*>(thread)->work();
  return nullptr;
}

void ServerThread::work() {
  while (!ended_.load(std::memory_order_acquire)) {
    bool busy = false;
    for (const int socket : sockets_) busy = busy || socket >= 0;
    turn(busy ? kBusy_ms : kIdle_ms);
  }
  for (int slot = 0; slot < kMostClients; ++slot) close(slot);
}

/// Waits for input, handles it, and sends the output.
void ServerThread::turn(int timeout_ms) {
  std::array<pollfd, kMostClients + 2> polled;
  for (int slot = 0; slot < kMostClients; ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    const bool receives = sockets_[i] >= 0 && space(slot).size > 0;
    const bool sends = sockets_[i] >= 0 && waiting(slot).size > 0;
    polled[i] = {sockets_[i], static_cast<short>((receives ? POLLIN : 0) | (sends ? POLLOUT : 0)),
                 0};
  }
  polled[kMostClients] = {listener_.streams(), POLLIN, 0};
  polled[kMostClients + 1] = {listener_.datagrams(), POLLIN, 0};
  if (listener_.datagrams() < 0) polled[kMostClients + 1].events = 0;
  if (::poll(polled.data(), polled.size(), timeout_ms) > 0) {
    for (int slot = 0; slot < kMostClients; ++slot) {
      const short found = polled[static_cast<std::size_t>(slot)].revents;
      if ((found & POLLIN) != 0)
        receive(slot);
      else if ((found & (POLLHUP | POLLERR)) != 0)
        close(slot);
    }
    if (polled[kMostClients].revents != 0) welcome(listener_.accept(), false);
    if (polled[kMostClients + 1].revents != 0) take_datagrams();
  }
  welcome(joining_.exchange(-1), true);
  for (int slot = 0; slot < kMostClients; ++slot)
    if (sockets_[static_cast<std::size_t>(slot)] >= 0 && keyed(slot) && !take_plain(slot))
      close(slot);
  server_.work(monotonic_ns());
  for (int slot = 0; slot < kMostClients; ++slot) send(slot);
}

/// A socket of -1 is none.
void ServerThread::welcome(int socket, bool inside) {
  if (socket < 0) return;
  std::uint64_t session = 0;
  const bool drawn = getrandom(&session, sizeof session, 0) == sizeof session && session != 0;
  const int slot = drawn ? server_.open(session, monotonic_ns()) : -1;
  if (slot < 0) return refuse_connection(socket);
  sockets_[static_cast<std::size_t>(slot)] = socket;
  inside_[static_cast<std::size_t>(slot)] = inside;
  if (keyed(slot)) tunnel(slot).begin(*key_);
}

/// Tells a client for which there is no place why, if nothing is encrypted, and closes its socket.
void ServerThread::refuse_connection(int socket) {
  const Bytes why = server_.refuse_connection(monotonic_ns());
  std::array<std::uint8_t, kLengthBytes + kLongestToClient> bytes{};
  for (std::size_t i = 0; i < kLengthBytes; ++i)
    bytes[i] = static_cast<std::uint8_t>(why.size >> (8 * i));
  std::memcpy(bytes.data() + kLengthBytes, why.data, why.size);
  if (key_ == nullptr)
    static_cast<void>(::send(socket, bytes.data(), kLengthBytes + why.size, MSG_NOSIGNAL));
  ::shutdown(socket, SHUT_WR);
  std::array<std::uint8_t, 512> unread;  // or its Hello would make the close a reset
  static_cast<void>(::recv(socket, unread.data(), unread.size(), MSG_DONTWAIT));
  ::close(socket);
}

/// The bytes of the network go to the server, or through the tunnel.
ByteSpace ServerThread::space(int slot) {
  return keyed(slot) ? tunnel(slot).space() : server_.space(slot);
}

Bytes ServerThread::waiting(int slot) {
  if (!keyed(slot)) return server_.waiting(slot);
  const std::size_t sealed = tunnel(slot).seal(server_.waiting(slot));
  if (sealed > 0) server_.sent(slot, sealed, monotonic_ns());
  return tunnel(slot).waiting();
}

void ServerThread::sent(int slot, std::size_t count) {
  keyed(slot) ? tunnel(slot).sent(count) : server_.sent(slot, count, monotonic_ns());
}

/// Gives the server what has arrived through the tunnel and it has space for. False: the tunnel is
/// broken.
bool ServerThread::take_plain(int slot) {
  Tunnel& from = tunnel(slot);
  for (;;) {
    if (!from.open()) return false;
    const Bytes plain = from.plain();
    const ByteSpace to = server_.space(slot);
    const std::size_t count = std::min(plain.size, to.size);
    if (count == 0) return true;
    std::memcpy(to.data, plain.data, count);
    from.taken(count);
    server_.received(slot, count, monotonic_ns());
  }
}

void ServerThread::take_datagrams() {
  for (int i = 0; i < kDatagramsPerTurn; ++i) {
    const ssize_t size = ::recv(listener_.datagrams(), datagram_.data(), datagram_.size(), 0);
    if (size < 0) return;
    server_.datagram({datagram_.data(), static_cast<std::size_t>(size)}, monotonic_ns());
  }
}

void ServerThread::receive(int slot) {
  const ByteSpace to = space(slot);
  const int socket = sockets_[static_cast<std::size_t>(slot)];
  if (to.size == 0) return;
  const ssize_t size = ::recv(socket, to.data, to.size, 0);
  const auto count = static_cast<std::size_t>(size);
  if (size > 0)
    return keyed(slot) ? tunnel(slot).received(count)
                       : server_.received(slot, count, monotonic_ns());
  if (size == 0 || (errno != EAGAIN && errno != EINTR)) close(slot);
}

void ServerThread::send(int slot) {
  const int socket = sockets_[static_cast<std::size_t>(slot)];
  if (socket < 0) return;
  const Bytes bytes = waiting(slot);
  if (bytes.size > 0) {
    const ssize_t size = ::send(socket, bytes.data, bytes.size, MSG_NOSIGNAL);
    if (size > 0) sent(slot, static_cast<std::size_t>(size));
    if (size < 0 && errno != EAGAIN && errno != EINTR) return close(slot);
  }
  if (server_.finished(slot, monotonic_ns())) close(slot);
}

void ServerThread::close(int slot) {
  int& socket = sockets_[static_cast<std::size_t>(slot)];
  if (socket < 0) return;
  ::close(socket);
  socket = -1;
  tunnel(slot).end();
  server_.closed(slot, monotonic_ns());
}

}  // namespace tactus
