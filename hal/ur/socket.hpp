// Socket: a TCP connection that never blocks but where a time-out is given. It is made at the start
// and waited for there; in the cycle it only takes and gives what there is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/load_error.hpp"

namespace tactus::ur {

class Socket {
 public:
  Socket() = default;
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { close(); }

  /// Connects to an IPv4 address, without Nagle's delay. kConnectionLost, and `why` names address,
  /// port and reason. [init]
  Status connect(const char* address, int port, int timeout_ms, Message& why);
  /// Sends all of it, waiting where the other side is slow; false: it is gone. [init]
  bool send_all(std::string_view text, int timeout_ms);

  /// Waits until there is something to receive, the end of the connection included. [any]
  bool wait(std::int64_t timeout_ns) const;
  /// What has come, at most `size` bytes; 0: nothing, -1: the connection is at its end. [cyclic]
  long receive(std::uint8_t* data, std::size_t size);

  enum class Sent : std::uint8_t { kAll, kNothing, kLost };
  /// All of it or nothing; where the other side took a part, the connection is lost. [cyclic]
  Sent send(const std::uint8_t* data, std::size_t size);

  /// The other side is told; what was sent still arrives. [any]
  void close();
  bool connected() const { return socket_ >= 0; }

 private:
  int socket_ = -1;
};

}  // namespace tactus::ur
