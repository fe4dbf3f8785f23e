// Connection: messages to and from the server over a stream socket, each behind its length of four
// bytes, least significant first.
#pragma once

#include <tactus.pb.h>

#include <cstdint>
#include <optional>
#include <string>

#include "gateway/ctl/client_tunnel.hpp"

namespace tactus::ctl {

class Connection {
 public:
  static constexpr std::size_t kLongest = 16 * 1024;  ///< of a message, in bytes

  Connection() = default;
  ~Connection() { close(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Connects to unix:PATH or tcp:HOST:PORT within a time. False: error() has the reason.
  bool open(const std::string& address, int timeout_ms);
  /// Encrypts the connection with the key in a file. False: error() has the reason.
  bool encrypt(const std::string& key_file, int timeout_ms);
  void close();
  /// Sends a message; waits at most `timeout_ms` for a server that does not read. False: gone.
  bool send(const ToServer& message, int timeout_ms);

  enum class ReceiveResult : std::uint8_t { kMessage, kNothing, kGone };
  /// Takes the next message that has arrived, without waiting. kGone: error() has the reason.
  ReceiveResult receive(ToClient& message);

  /// To wait for: readable when something has arrived.
  int descriptor() const { return socket_; }
  const std::string& error() const { return error_; }

 private:
  bool open_unix(const std::string& path, int timeout_ms);
  bool open_tcp(const std::string& host, const std::string& port, int timeout_ms);
  bool connect_within(const void* address, std::size_t size, int timeout_ms);
  bool fail(const std::string& reason);
  ReceiveResult fail_key();
  bool send_all(const std::string& bytes, int timeout_ms);
  bool receive_exactly(std::string& bytes, std::size_t count, int timeout_ms);
  bool take_message(ToClient& message, ReceiveResult& result);

  int socket_ = -1;
  bool opened_ = false;  // something of the server could be decrypted
  std::string sealed_, received_, error_;
  std::optional<ClientTunnel> tunnel_;
};

}  // namespace tactus::ctl
