// RtdeClient: the conversation of port 30004. At the start protocol 2, or 1 where the controller
// knows no other, its version, one recipe of outputs, one of inputs; then a data package in every
// cycle of the robot, and set-points back.
#pragma once

#include "hal/ur/rtde_stream.hpp"
#include "hal/ur/ur_state.hpp"

namespace tactus::ur {

enum class RtdePhase : std::uint8_t {
  kConnect,
  kProtocol,
  kVersion,
  kOutputs,
  kInputs,
  kStart,
  kRunning
};
inline constexpr std::array<const char*, 7> kRtdePhaseNames = {
    "connect", "protocol", "version", "outputs", "inputs", "start", "running"};

class RtdeClient {
 public:
  /// From connecting to the first data package. `why` names phase and reason of what is not kOk:
  /// kConnectionLost, kBusTimeout, kRefusedByRobot, kRegistersInUse, kWireFormat. [init]
  Status start(const char* address, int port, double rate_hz, int timeout_ms, Message& why);

  /// Takes all data packages that have come, at most `kMostPackets`; the newest is in `state`.
  /// `count`: how many. [cyclic]
  Status receive(UrState& state, int& count, Message& why);
  /// Waits until something has come. [any]
  bool wait(std::int64_t timeout_ns) const { return stream_.socket.wait(timeout_ns); }

  /// Sends a set-point; nothing else is ever written to the registers. [cyclic]
  Socket::Sent send(std::int32_t count, const Vector6& q);

  void close() { stream_.socket.close(); }
  bool running() const { return phase_ == RtdePhase::kRunning && stream_.socket.connected(); }
  RtdePhase phase() const { return phase_; }
  const Version& version() const { return version_; }
  int protocol() const { return protocol_; }

 private:
  static constexpr int kMostPackets = 128;  ///< in one cycle: a second of them
  static constexpr std::size_t kMostRequest = 1024;
  using Request = std::array<std::uint8_t, kMostRequest>;

  Status run_phase(RtdePhase phase, Message& why);
  Status ask_protocol(Message& why);
  Status ask_version(Message& why);
  Status ask_outputs(Message& why);
  Status ask_inputs(Message& why);
  Status ask_start(Message& why);
  /// Sends a request and waits for the reply of its type; what comes between is skipped.
  Status ask(ByteWriter& request, RtdeType type, RtdePacket& reply, Message& why);

  RtdeStream stream_;
  RtdePhase phase_ = RtdePhase::kConnect;
  Version version_;
  int protocol_ = 2, timeout_ms_ = 0;
  double rate_hz_ = 0.0;
  std::uint8_t output_recipe_ = 0, input_recipe_ = 0;
};

}  // namespace tactus::ur
