// RtdeClient: the conversation of port 30004. The start agrees on protocol 2, or 1 if the
// controller knows no other, reads the version, and sets up one recipe of outputs and one of
// inputs. A recipe with a field that the controller does not know is void; where it can do without,
// the start is made once more. Then the robot sends a data package in every cycle and receives
// set-points.
#pragma once

#include "hal/ur/rtde_stream.hpp"
#include "hal/ur/ur_state.hpp"
#include "kernel/core/digital_outputs.hpp"

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

constexpr const char* name(RtdePhase phase) {
  switch (phase) {
    case RtdePhase::kConnect: return "connect";
    case RtdePhase::kProtocol: return "protocol";
    case RtdePhase::kVersion: return "version";
    case RtdePhase::kOutputs: return "outputs";
    case RtdePhase::kInputs: return "inputs";
    case RtdePhase::kStart: return "start";
    case RtdePhase::kRunning: return "running";
  }
  return nullptr;
}

class RtdeClient {
 public:
  /// Connects and starts the stream of data packages. kConnectionLost, kBusTimeout,
  /// kRefusedByRobot, kRegistersInUse, kWireFormat: `why` names phase and reason. With `outputs`
  /// the digital outputs are claimed too. [init]
  Status start(const char* address, int port, double rate_hz, bool outputs,
               const Deadline& deadline, Message& why);

  /// Takes all data packages that have come, at most `kMostPackets`, and returns their number in
  /// `count`; the newest is in `state`. [cyclic]
  Status receive(UrState& state, int& count, Message& why);
  /// Waits until bytes have come. [any]
  bool wait(std::int64_t timeout_ns) const { return stream_.socket.wait(timeout_ns); }

  /// Digital outputs that go with every set-point from now on. [cyclic]
  void put_out(const DigitalOutputs& outputs) { outputs_ = outputs; }
  /// Sends a set-point; nothing else is ever written to the registers. [cyclic]
  Socket::Sent send(std::int32_t count, const Vector6& q);

  void close() { stream_.socket.close(); }
  bool running() const { return phase_ == RtdePhase::kRunning && stream_.socket.connected(); }
  RtdePhase phase() const { return phase_; }
  const Version& version() const { return version_; }
  int protocol() const { return protocol_; }

 private:
  static constexpr int kMostPackets = 128;  ///< in one cycle: those of a second
  static constexpr std::size_t kMostRequest = 1024;
  using Request = std::array<std::uint8_t, kMostRequest>;

  Status converse(const char* address, int port, const Deadline& deadline, Message& why);
  bool leave_out(std::string_view types);
  Status run_phase(RtdePhase phase, const Deadline& deadline, Message& why);
  Status ask_protocol(const Deadline& deadline, Message& why);
  Status ask_version(const Deadline& deadline, Message& why);
  Status ask_outputs(const Deadline& deadline, Message& why);
  Status ask_inputs(const Deadline& deadline, Message& why);
  Status ask_start(const Deadline& deadline, Message& why);
  /// Sends a request and waits for the reply of its type; packets of other types are skipped.
  Status ask(ByteWriter& request, RtdeType type, const Deadline& deadline, RtdePacket& reply,
             Message& why);

  RtdeStream stream_;
  RtdePhase phase_ = RtdePhase::kConnect;
  Version version_;
  int protocol_ = 2;
  double rate_hz_ = 0.0;
  std::size_t inputs_ = kSetPointFields;  // fields of the recipe
  ToolFields offered_{};
  bool recipe_void_ = false;  // it had fields that the controller does not know
  DigitalOutputs outputs_;
  std::uint8_t output_recipe_ = 0, input_recipe_ = 0;
};

}  // namespace tactus::ur
