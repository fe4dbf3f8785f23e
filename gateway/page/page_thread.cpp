#include "gateway/page/page_thread.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/os/cycle_clock.hpp"
#include "hal/os/ordinary_thread.hpp"

namespace tactus {
namespace {

constexpr int kTurn_ms = 5;  // a state waits for so long at most
constexpr std::int64_t kRetry_ns = 1'000'000'000;

/// Opens a socket that listens at an address of this computer, and finds its port. -1 with errno.
int listen_at(const Address& address, int& port) {
  constexpr int kYes = 1, kBuffer = kSocketBytes;
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return -1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &kYes, sizeof kYes);
  setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kBuffer,
             sizeof kBuffer);  // its connections inherit it
  sockaddr_in bound = address.host;
  socklen_t size = sizeof bound;
  auto* const generic = reinterpret_cast<sockaddr*>(&bound);
  if (::bind(socket, generic, size) == 0 && ::listen(socket, kMostPageConnections) == 0 &&
      getsockname(socket, generic, &size) == 0) {
    port = ntohs(bound.sin_port);
    return socket;
  }
  const int error = errno;
  ::close(socket);
  errno = error;
  return -1;
}

bool draw_token(Text<32>& token) {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return false;
  constexpr const char* kDigits = "0123456789abcdef";
  token = {};
  for (const unsigned char byte : bytes) {
    token << std::string_view(kDigits + (byte >> 4), 1);
    token << std::string_view(kDigits + (byte & 15), 1);
  }
  return true;
}

}  // namespace

bool parse_page_address(std::string_view text, Address& address, Message& why) {
  Text<127> full("tcp:");
  if (!address.parse(full << text, why)) return false;
  if (!address.local && address.host.sin_addr.s_addr == htonl(INADDR_LOOPBACK)) return true;
  why << "'" << text
      << "': the page is served at 127.0.0.1 alone, so that programs on other computers do not "
         "reach it; give 127.0.0.1:PORT, and look at it from there through "
         "ssh -L PORT:127.0.0.1:PORT HOST";
  return false;
}

bool PageThread::prepare(Message& why) {
  Json json(description_bytes_.data(), description_bytes_.size());
  begin_ns_ = monotonic_ns();
  if (!draw_token(token_)) {
    why << "there are no random numbers for a token";
    return false;
  }
  describe_page(subject_, token_, json);
  description_ = json.text();
  const double period_s = subject_.pipeline.robot.period_s();
  ports_.divisor = std::max(1, static_cast<int>(kPortPeriod_ms * 1e-3 / period_s));
  return true;
}

bool PageThread::start(const Address& address, Message& why) {
  if (!prepare(why)) return false;
  const int socket = listen_at(address, port_);
  if (socket < 0) {
    why << std::strerror(errno);
    if (errno == EADDRINUSE)
      why << "; another program listens there: stop it, or give another port";
    return false;
  }
  if (!page_.start(socket, description_, token_, why)) {
    ::close(socket);
    return false;
  }
  const int error = start_ordinary_thread(thread_, run, this);
  started_ = error == 0;
  if (!started_) why << "the thread: " << std::strerror(error);
  return started_;
}

void PageThread::end() {
  if (!started_) return;
  ended_.store(true, std::memory_order_release);
  pthread_join(thread_, nullptr);
  started_ = false;
}

void* PageThread::run(void* thread) {
  static_cast<PageThread*>(thread)->work();
  return nullptr;
}

void PageThread::work() {
  while (!ended_.load(std::memory_order_acquire)) {
    if (!link_.there()) connect();
    tell_news();
    page_.run(kTurn_ms);
  }
  page_.stop();
  link_.close();
}

/// Becomes a client of the server; tries again if it had no place.
void PageThread::connect() {
  const std::int64_t now_ns = monotonic_ns();
  if (tried_ns_ != 0 && now_ns - tried_ns_ < kRetry_ns) return;
  tried_ns_ = now_ns;
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0) return;
  if (server_.join(ends[0])) return link_.open(ends[1], now_ns);
  ::close(ends[0]);
  ::close(ends[1]);
}

/// Without browsers the messages are read all the same: the server cuts a client that does not.
void PageThread::tell_news() {
  const std::int64_t now_ns = monotonic_ns();
  link_.work(now_ns, [&](const tactus_ToClient& message) {
    append_message(message, {begin_ns_, now_ns}, events_);
  });
  bool newer = false;
  while (ports_.values.take(values_)) newer = true;
  if (newer) append_ports(values_, subject_.pipeline.ports, events_);
}

}  // namespace tactus
