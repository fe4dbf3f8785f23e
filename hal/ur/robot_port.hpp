// RobotPort: the primary port, 30001. It uploads the program and receives the calibration of the
// arm and the reason why the robot has stopped or does not run the program.
#pragma once

#include "hal/net/socket.hpp"
#include "hal/ur/arm_calibration.hpp"

namespace tactus::ur {

class RobotPort {
 public:
  /// Connects and discards earlier messages of the robot. [init]
  Status connect(const char* address, int port, const Deadline& deadline, Message& why);
  /// Begins the upload of a program, which must stay where it is until the upload is over, and
  /// forgets the last runtime exception. [cyclic]
  void upload(std::string_view program);
  /// Continues the upload; only the state shows whether the program runs. [cyclic]
  void send();
  bool uploading() const { return !unsent_.empty(); }

  /// Reads at most `kMostBytes` of the bytes that have arrived. [cyclic]
  void receive();
  /// Forgets the last stop. [cyclic]
  void forget_stop();
  /// Waits until bytes have arrived. [any]
  bool wait(std::int64_t timeout_ns) const { return socket_.wait(timeout_ns); }

  /// Code, argument and text of the newest stop, "C153A2: position deviates from the path, joint 3
  /// (elbow)"; empty if there was none. [any]
  const Message& stop() const { return stop_; }
  /// The code alone; 0 if there was none. [any]
  std::uint32_t stop_code() const { return stop_code_; }
  /// Line, column and text of the newest runtime exception; empty if there was none. [any]
  const Message& exception() const { return exception_; }
  /// That which was told last in this connection. [any]
  const ArmCalibration& calibration() const { return calibration_; }

  void close() { socket_.close(); }
  bool connected() const { return socket_.connected(); }
  /// True if it was closed for a message whose length is impossible. [any]
  bool broken() const { return broken_; }

 private:
  static constexpr std::size_t kMostBytes = 4096;

  void take(const Packet& packet);
  void take_state(ByteReader& parts);
  void take_stop(ByteReader& body);
  void take_exception(ByteReader& body);

  Socket socket_;
  StateFrames frames_;
  std::string_view unsent_;
  Message stop_, exception_;
  ArmCalibration calibration_;
  std::uint32_t stop_code_ = 0;
  bool broken_ = false;
};

}  // namespace tactus::ur
