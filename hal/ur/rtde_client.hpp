// RtdeClient: the conversation of port 30004. The start agrees on protocol 2, or 1 if the
// controller supports no other, reads the version, and sets up one recipe of outputs and one of
// inputs. A recipe with a field that the controller does not support is void; where it can do
// without, the start is made once more. Then the robot sends a data package in every cycle and
// receives set-points.
#pragma once

#include "hal/net/socket.hpp"
#include "hal/ur/protocol.hpp"
#include "hal/ur/ur_state.hpp"
#include "kernel/core/digital_outputs.hpp"

namespace tactus::ur {

/// A whole packet without its header, valid until the next call of next().
struct RtdePacket {
  RtdeType type = RtdeType::kTextMessage;
  const std::uint8_t* payload = nullptr;
  std::size_t size = 0;
};

/// Assembles whole RTDE packets from the pieces that a connection delivers.
class RtdeStream {
 public:
  Socket socket;

  /// [init]
  Status connect(const char* address, int port, const Deadline& deadline, Message& why) {
    frames_.clear();
    return socket.connect(address, port, deadline, why);
  }

  /// Returns the next packet; `any` is false if none is complete. kConnectionLost; kWireFormat: the
  /// length is impossible. Reads at most one buffer. [cyclic]
  Status next(RtdePacket& packet, bool& any, Message& why);

  /// Sends a packet that `begin` began. [cyclic]
  Socket::Sent send(ByteWriter& packet) {
    packet.set_u16(0, packet.size());
    return packet.ok() ? socket.send(packet.data(), packet.size()) : Socket::Sent::kLost;
  }
  static void begin(ByteWriter& packet, RtdeType type) {
    packet.u16(0);
    packet.u8(static_cast<std::uint8_t>(type));
  }

 private:
  static constexpr std::size_t kLongest = 4096;  ///< bytes of a packet; ours have about 500

  Frames<2, kRtdeHeader, kLongest> frames_;
};

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

  /// Takes all data packages that have arrived, at most `kMostPackets`, and returns their number in
  /// `count`; the newest is in `state`. [cyclic]
  Status receive(UrState& state, int& count, Message& why);
  /// Waits until bytes have arrived. [any]
  bool wait(std::int64_t timeout_ns) const { return stream_.socket.wait(timeout_ns); }

  /// Digital outputs that go with every set-point from now on. [cyclic]
  void set_outputs(const DigitalOutputs& outputs) { outputs_ = outputs; }
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
  bool recipe_void_ = false;  // it had unsupported fields
  DigitalOutputs outputs_;
  std::uint8_t output_recipe_ = 0, input_recipe_ = 0;
};

/// Writes the registers of the set-points, as in hal/ur/servo_program.hpp; nothing else is ever
/// written to them.
class SetPoints {
 public:
  /// `why` explains a Status that is not kOk.
  SetPoints(RtdeClient& session, Message& why) : session_(session), why_(why) {}

  /// Begins with a new connection. `max_missed`: periods in a row in which nothing can be sent.
  /// [init]
  void start(int max_missed);
  /// Sends the next set-point. kConnectionLost; kBusTimeout after more than `max_missed` that could
  /// not be sent. [cyclic]
  Status send(const Vector6& q);
  /// Tells the program that there is no set-point yet, and counts from there. `sent` is false if
  /// that was not possible in this cycle. As send(). [cyclic]
  Status clear(bool& sent);
  /// Tells the program to brake and to end. As clear(). [cyclic]
  Status end(bool& sent);

  /// The count of the last set-point, as in the register; 0: none yet. [any]
  std::int32_t count() const { return count_; }

 private:
  Status write(std::int32_t count, const Vector6& q, bool& sent);

  RtdeClient& session_;
  Message& why_;
  Vector6 last_ = Vector6::Zero();  // rad
  std::int32_t count_ = 0;
  int max_missed_ = 0, unsent_ = 0;  // unsent_: periods in a row
};

}  // namespace tactus::ur
