#include "hal/ur/rtde_client.hpp"

namespace tactus::ur {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

template <std::size_t N>
void write_names(const std::array<RecipeField, N>& fields, ByteWriter& packet) {
  for (std::size_t i = 0; i < N; ++i) {
    if (i > 0) packet.text(",");
    packet.text(fields[i].name);
  }
}

Status refuse(Message& why, Status status, std::string_view text) {
  why = Message(text);
  return status;
}

}  // namespace

Status RtdeClient::start(const char* address, int port, double rate_hz, int timeout_ms,
                         Message& why) {
  rate_hz_ = rate_hz;
  timeout_ms_ = timeout_ms;
  protocol_ = 2;
  phase_ = RtdePhase::kConnect;
  TRY(stream_.connect(address, port, timeout_ms, why));
  while (phase_ != RtdePhase::kRunning) {
    phase_ = static_cast<RtdePhase>(static_cast<int>(phase_) + 1);
    Message reason;
    const Status status = run_phase(phase_, reason);
    if (status == Status::kOk) continue;
    stream_.socket.close();
    why = Message("RTDE, phase ");
    why << kRtdePhaseNames[static_cast<std::size_t>(phase_)] << ": " << reason;
    return status;
  }
  return Status::kOk;
}

Status RtdeClient::run_phase(RtdePhase phase, Message& why) {
  switch (phase) {
    case RtdePhase::kProtocol:
      return ask_protocol(why);
    case RtdePhase::kVersion:
      return ask_version(why);
    case RtdePhase::kOutputs:
      return ask_outputs(why);
    case RtdePhase::kInputs:
      return ask_inputs(why);
    case RtdePhase::kStart:
      return ask_start(why);
    default:
      return Status::kOk;
  }
}

Status RtdeClient::ask(ByteWriter& request, RtdeType type, RtdePacket& reply, Message& why) {
  constexpr int kMostBetween = 512;  // data packages on the way, text messages
  if (stream_.send(request) != Socket::Sent::kAll)
    return refuse(why, Status::kConnectionLost, "the connection was closed");
  for (int i = 0; i < kMostBetween; ++i) {
    bool any = false;
    TRY(stream_.next(reply, any, why));
    if (any && reply.type == type) return Status::kOk;
    if (!any && !stream_.socket.wait(timeout_ms_ * kMillisecond_ns)) break;
  }
  why = Message("no reply within ");
  why << timeout_ms_ << " ms";
  return Status::kBusTimeout;
}

/// A controller that does not know protocol 2 says no, and speaks protocol 1.
Status RtdeClient::ask_protocol(Message& why) {
  for (; protocol_ > 0; --protocol_) {
    Request bytes;
    ByteWriter request(bytes.data(), bytes.size());
    RtdeStream::begin(request, RtdeType::kRequestProtocolVersion);
    request.u16(static_cast<std::uint16_t>(protocol_));
    RtdePacket reply;
    TRY(ask(request, RtdeType::kRequestProtocolVersion, reply, why));
    ByteReader in(reply.payload, reply.size);
    const bool accepted = in.u8() == 1;
    if (!in.done()) return refuse(why, Status::kWireFormat, "a reply of another size");
    if (accepted) return Status::kOk;
  }
  return refuse(why, Status::kRefusedByRobot, "neither protocol 2 nor 1");
}

Status RtdeClient::ask_version(Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kGetUrcontrolVersion);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kGetUrcontrolVersion, reply, why));
  ByteReader in(reply.payload, reply.size);
  version_.major = in.u32(), version_.minor = in.u32();
  version_.bugfix = in.u32(), version_.build = in.u32();
  if (!in.done()) return refuse(why, Status::kWireFormat, "a reply of another size");
  const double fastest_hz = 1.0 / version_.cycle_s();
  const bool at_own_rate = protocol_ == 2 || rate_hz_ == fastest_hz;
  if (version_.at_least(3, 9) && rate_hz_ <= fastest_hz && at_own_rate) return Status::kOk;
  why << "software " << static_cast<int>(version_.major) << "." << static_cast<int>(version_.minor);
  if (!version_.at_least(3, 9))
    why << ", at least 3.9 is required (registers from 24 up)";
  else
    why << " sends at " << fastest_hz << " Hz" << (protocol_ == 2 ? " at most" : "")
        << "; the pipeline's period asks for " << rate_hz_ << " Hz";
  return Status::kRefusedByRobot;
}

Status RtdeClient::ask_outputs(Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kSetupOutputs);
  if (protocol_ == 2) request.f64(rate_hz_);
  write_names(kOutputFields, request);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kSetupOutputs, reply, why));
  ByteReader in(reply.payload, reply.size);
  if (protocol_ == 2) output_recipe_ = in.u8();
  return check_types(in.rest(), kOutputFields.data(), kOutputFields.size(), why);
}

Status RtdeClient::ask_inputs(Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kSetupInputs);
  write_names(kInputFields, request);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kSetupInputs, reply, why));
  ByteReader in(reply.payload, reply.size);
  input_recipe_ = in.u8();
  TRY(check_types(in.rest(), kInputFields.data(), kInputFields.size(), why));
  return input_recipe_ != 0 ? Status::kOk
                            : refuse(why, Status::kRefusedByRobot, "no recipe for the inputs");
}

Status RtdeClient::ask_start(Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kStart);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kStart, reply, why));
  ByteReader in(reply.payload, reply.size);
  const bool accepted = in.u8() == 1;
  if (!in.done()) return refuse(why, Status::kWireFormat, "a reply of another size");
  return accepted ? Status::kOk : refuse(why, Status::kRefusedByRobot, "not accepted");
}

Status RtdeClient::receive(UrState& state, int& count, Message& why) {
  count = 0;
  for (int i = 0; i < kMostPackets; ++i) {
    RtdePacket packet;
    bool any = false;
    TRY(stream_.next(packet, any, why));
    if (!any) break;
    if (packet.type != RtdeType::kDataPackage) continue;  // text messages
    ByteReader in(packet.payload, packet.size);
    if (protocol_ == 2 && in.u8() != output_recipe_)
      return refuse(why, Status::kWireFormat, "RTDE: a data package of another recipe");
    TRY(decode_state(in, state, why));
    ++count;
  }
  return Status::kOk;
}

Socket::Sent RtdeClient::send(std::int32_t count, const Vector6& q) {
  std::array<std::uint8_t, 64> bytes;
  ByteWriter packet(bytes.data(), bytes.size());
  RtdeStream::begin(packet, RtdeType::kDataPackage);
  packet.u8(input_recipe_);
  packet.i32(count);
  for (const double value : q) packet.f64(value);
  return stream_.send(packet);
}

}  // namespace tactus::ur
