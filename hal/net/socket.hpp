// Socket: a TCP connection. Only connecting and waiting block, for the given time at most; in the
// cycle it takes bytes that have arrived and sends without waiting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/net/deadline.hpp"
#include "kernel/core/load_error.hpp"

namespace tactus::ur {

/// True for four numbers with points between them; names are not looked up. [any]
bool is_ipv4(const char* address);

class Socket {
 public:
  Socket() = default;
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { close(); }

  /// Connects to an IPv4 address, without Nagle's delay. kConnectionLost: `why` names address, port
  /// and reason; what to do about it depends on what is known of the other end. [init]
  Status connect(const char* address, int port, const Deadline& deadline, Message& why);

  /// Begins to connect in place of the connection before, and waits for nothing: receive() then
  /// returns 0 until the other end greets, or -1 if it cannot be reached. False: this computer
  /// cannot begin. [cyclic]
  bool begin(const char* address, int port);

  /// Waits until bytes or the end of the connection can be received. [any]
  bool wait(std::int64_t timeout_ns) const;
  /// Receives at most `size` bytes; returns their number, 0 if there was none, -1 if the connection
  /// has ended. [cyclic]
  long receive(std::uint8_t* data, std::size_t size);

  enum class Sent : std::uint8_t { kAll, kNothing, kLost };
  /// Sends all bytes or none; if only a part could be sent, the connection is lost. [cyclic]
  Sent send(const std::uint8_t* data, std::size_t size);
  /// Sends as much of a text as can be sent at once, and takes it off the front. False: the
  /// connection is lost. [cyclic]
  bool send_some(std::string_view& text);

  /// Closes the connection; bytes that were sent still arrive. [any]
  void close();
  bool connected() const { return socket_ >= 0; }

 private:
  int open(const char* address, int port);

  int socket_ = -1;
};

}  // namespace tactus::ur
