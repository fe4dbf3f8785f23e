// RobotPort: the primary port, 30001. It takes the program, and tells why the robot has stopped or
// why it does not run the program.
#pragma once

#include "hal/ur/protocol.hpp"
#include "hal/ur/socket.hpp"

namespace tactus::ur {

class RobotPort {
 public:
  /// What the robot has said is forgotten. [init]
  Status connect(const char* address, int port, int timeout_ms, Message& why);
  /// Uploads a program: that it runs is seen in the state alone. kConnectionLost. [init]
  Status upload(std::string_view program, int timeout_ms, Message& why);

  /// Takes at most `kMostBytes` of what has come. [cyclic]
  void receive();
  /// Waits until something has come. [any]
  bool wait(std::int64_t timeout_ns) const { return socket_.wait(timeout_ns); }

  /// The code of the newest stop with its argument and the text for it, "C153A2: position deviates
  /// from the path, joint 3 (elbow)"; empty: none has come. [any]
  const Message& stop() const { return stop_; }
  /// Line, column and text of the newest runtime exception; empty: none has come. [any]
  const Message& exception() const { return exception_; }

  void close() { socket_.close(); }
  bool connected() const { return socket_.connected(); }

 private:
  static constexpr std::size_t kMostBytes = 4096;

  void take(const Packet& packet);
  void take_stop(ByteReader& body);
  void take_exception(ByteReader& body);

  Socket socket_;
  StateFrames frames_;
  Message stop_, exception_;
};

}  // namespace tactus::ur
