#include "gateway/sockets/listener.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "gateway/server/limits.hpp"

namespace tactus {
namespace {

constexpr int kFlags = SOCK_NONBLOCK | SOCK_CLOEXEC;

template <class To>
const sockaddr* generic(const To& to) {
  return reinterpret_cast<const sockaddr*>(&to);
}

sockaddr_un beside(const sockaddr_un& path) {
  sockaddr_un to = path;
  std::memcpy(to.sun_path + std::strlen(to.sun_path), Address::kDatagrams.data(),
              Address::kDatagrams.size());
  return to;
}

/// True if something is there that is no socket.
bool is_other(const sockaddr_un& path) {
  struct stat file {};
  return lstat(path.sun_path, &file) == 0 && !S_ISSOCK(file.st_mode);
}

/// True if no process listens at the path any more.
bool is_left_over(const sockaddr_un& path, int type) {
  if (access(path.sun_path, F_OK) != 0 || is_other(path)) return false;
  const int probe = ::socket(AF_UNIX, type | kFlags, 0);
  const bool refused =
      probe >= 0 && ::connect(probe, generic(path), sizeof path) != 0 && errno == ECONNREFUSED;
  if (probe >= 0) ::close(probe);
  return refused;
}

/// Binds a Unix socket that only this user reaches; false with errno.
bool bind_path(int socket, const sockaddr_un& path, int type) {
  if (is_left_over(path, type)) ::unlink(path.sun_path);
  const mode_t before = umask(0177);
  const bool bound = ::bind(socket, generic(path), sizeof path) == 0;
  const int error = errno;
  umask(before);
  errno = error;
  return bound;
}

bool explain(const char* what, Message& why) {
  why << what << ": " << std::strerror(errno);
  if (errno == EADDRINUSE) why << "; another server listens there: stop it, or give --listen";
  return false;
}

bool explain_path(const sockaddr_un& path, Message& why) {
  if (errno != EADDRINUSE || !is_other(path)) return explain(path.sun_path, why);
  why << path.sun_path << ": a file is there that is no socket; remove it, or give --listen";
  return false;
}

}  // namespace

bool Listener::open(const Address& address, bool datagrams, Message& why) {
  close();
  address_ = address;
  const int family = address.local ? AF_UNIX : AF_INET;
  streams_ = ::socket(family, SOCK_STREAM | kFlags, 0);
  if (datagrams) datagrams_ = ::socket(family, SOCK_DGRAM | kFlags, 0);
  if (streams_ < 0 || (datagrams && datagrams_ < 0)) return explain("socket", why);
  if (!(address.local ? open_local(why) : open_host(why))) {
    close();
    return false;
  }
  return ::listen(streams_, kMostClients) == 0 || explain("listen", why);
}

bool Listener::open_local(Message& why) {
  bound_ = bind_path(streams_, address_.path, SOCK_STREAM);
  if (!bound_) return explain_path(address_.path, why);
  if (datagrams_ < 0) return true;
  const sockaddr_un datagrams = beside(address_.path);
  bound_datagrams_ = bind_path(datagrams_, datagrams, SOCK_DGRAM);
  return bound_datagrams_ || explain_path(datagrams, why);
}

bool Listener::open_host(Message& why) {
  constexpr int kYes = 1;
  setsockopt(streams_, SOL_SOCKET, SO_REUSEADDR, &kYes, sizeof kYes);
  socklen_t size = sizeof address_.host;
  if (::bind(streams_, generic(address_.host), sizeof address_.host) != 0 ||
      getsockname(streams_, reinterpret_cast<sockaddr*>(&address_.host), &size) != 0 ||
      (datagrams_ >= 0 && ::bind(datagrams_, generic(address_.host), sizeof address_.host) != 0))
    return explain("the address and port", why);
  return true;
}

int Listener::accept() const {
  const int client = ::accept4(streams_, nullptr, nullptr, kFlags);
  constexpr int kYes = 1;
  if (client >= 0 && !address_.local)
    setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &kYes, sizeof kYes);
  return client;
}

void Listener::close() {
  if (streams_ >= 0) ::close(streams_);
  if (datagrams_ >= 0) ::close(datagrams_);
  streams_ = datagrams_ = -1;
  if (bound_) ::unlink(address_.path.sun_path);
  if (bound_datagrams_) ::unlink(beside(address_.path).sun_path);
  bound_ = bound_datagrams_ = false;
}

}  // namespace tactus
