#include "gateway/sockets/address.hpp"

#include <arpa/inet.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <cstring>

namespace tactus {
namespace {

constexpr std::string_view kUnix = "unix:", kTcp = "tcp:";

bool parse_path(std::string_view path, sockaddr_un& to, Message& why) {
  to.sun_family = AF_UNIX;
  if (path.empty() || path.size() + Address::kDatagrams.size() >= sizeof to.sun_path) {
    why << "the path of a Unix socket has 1 to "
        << sizeof to.sun_path - Address::kDatagrams.size() - 1 << " characters";
    return false;
  }
  std::memcpy(to.sun_path, path.data(), path.size());
  return true;
}

bool parse_host(std::string_view text, sockaddr_in& to, Message& why) {
  const std::size_t colon = text.rfind(':');
  const Text<63> host(text.substr(0, colon));
  std::uint16_t port = 0;
  bool good = colon != std::string_view::npos;
  if (good) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + colon + 1, end, port);
    good = error == std::errc() && stop == end;
  }
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  good = good && inet_pton(AF_INET, host.c_str(), &to.sin_addr) == 1;
  if (!good) why << "'" << text << "' is no IPv4 address and port, like 127.0.0.1:7370";
  return good;
}

}  // namespace

bool Address::parse(std::string_view text, Message& why) {
  *this = {};
  if (text.substr(0, kUnix.size()) == kUnix)
    return parse_path(text.substr(kUnix.size()), path, why);
  local = false;
  if (text.substr(0, kTcp.size()) == kTcp) return parse_host(text.substr(kTcp.size()), host, why);
  why << "'" << text << "' is neither unix:PATH nor tcp:ADDRESS:PORT";
  return false;
}

Text<127> Address::text() const {
  if (local) return Text<127>(kUnix) << path.sun_path;
  char name[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &host.sin_addr, name, sizeof name);
  return Text<127>(kTcp) << name << ":" << static_cast<int>(ntohs(host.sin_port));
}

bool Address::loopback() const {
  return local || ntohl(host.sin_addr.s_addr) >> 24 == 127;
}

Text<127> default_address() {
  Text<127> text(kUnix);
  const char* const folder = std::getenv("XDG_RUNTIME_DIR");
  if (folder != nullptr && folder[0] == '/') {
    text << folder << "/tactus.sock";
  } else {
    text << "/tmp/tactus-" << static_cast<std::size_t>(getuid()) << ".sock";
  }
  return text;
}

}  // namespace tactus
