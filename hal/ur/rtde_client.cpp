#include "hal/ur/rtde_client.hpp"

#include <limits>

#include "hal/ur/refuse.hpp"
#include "hal/ur/servo_program.hpp"

namespace tactus::ur {
namespace {

/// The fields of the recipe of outputs, one after the other.
struct OutputRecipe {
  std::array<RecipeField, kOutputFields.size()> fields;
  std::size_t count = 0;

  explicit OutputRecipe(const ToolFields& offered) {
    for (std::size_t i = 0; i < kOutputFields.size(); ++i)
      if (i < kStateFields || offered[i - kStateFields]) fields[count++] = kOutputFields[i];
  }
};

void write_names(const RecipeField* fields, std::size_t count, ByteWriter& packet) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) packet.text(",");
    packet.text(fields[i].name);
  }
}

}  // namespace

Status RtdeClient::start(const char* address, int port, double rate_hz, bool outputs,
                         const Deadline& deadline, Message& why) {
  rate_hz_ = rate_hz;
  inputs_ = outputs ? kInputFields.size() : kSetPointFields;
  outputs_ = {};
  offered_.fill(true);
  recipe_void_ = false;
  TRY(converse(address, port, deadline, why));
  return recipe_void_ ? converse(address, port, deadline, why) : Status::kOk;
}

/// Goes through the phases, or to a recipe that is void.
Status RtdeClient::converse(const char* address, int port, const Deadline& deadline, Message& why) {
  stream_.socket.close();
  protocol_ = 2;
  phase_ = RtdePhase::kConnect;
  if (const Status status = stream_.connect(address, port, deadline, why); status != Status::kOk) {
    why << (is_ipv4(address) ? "; is this the robot's IPv4 address, and is it on?"
                             : "; write the robot's IPv4 address, four numbers with points");
    return status;
  }
  while (phase_ != RtdePhase::kRunning && !(phase_ == RtdePhase::kOutputs && recipe_void_)) {
    phase_ = static_cast<RtdePhase>(static_cast<int>(phase_) + 1);
    Message reason;
    const Status status = run_phase(phase_, deadline, reason);
    if (status == Status::kOk) continue;
    stream_.socket.close();
    why = Message("RTDE, phase ");
    why << name(phase_) << ": " << reason;
    return status;
  }
  return Status::kOk;
}

Status RtdeClient::run_phase(RtdePhase phase, const Deadline& deadline, Message& why) {
  switch (phase) {
    case RtdePhase::kProtocol: return ask_protocol(deadline, why);
    case RtdePhase::kVersion: return ask_version(deadline, why);
    case RtdePhase::kOutputs: return ask_outputs(deadline, why);
    case RtdePhase::kInputs: return ask_inputs(deadline, why);
    case RtdePhase::kStart: return ask_start(deadline, why);
    default: return Status::kOk;
  }
}

Status RtdeClient::ask(ByteWriter& request, RtdeType type, const Deadline& deadline,
                       RtdePacket& reply, Message& why) {
  if (stream_.send(request) != Socket::Sent::kAll)
    return refuse(why, Status::kConnectionLost, "the connection was closed");
  for (std::int64_t left_ns = deadline.left_ns(); left_ns > 0; left_ns = deadline.left_ns()) {
    bool any = false;
    TRY(stream_.next(reply, any, why));
    if (any && reply.type == type) return Status::kOk;
    if (!any && !stream_.socket.wait(left_ns)) break;
  }
  why = Message("no reply within ");
  why << deadline.whole_ms() << " ms; check the network or raise connect_ms";
  return Status::kBusTimeout;
}

/// Requests protocol 2, then 1: a controller refuses a protocol that it does not support.
Status RtdeClient::ask_protocol(const Deadline& deadline, Message& why) {
  for (; protocol_ > 0; --protocol_) {
    Request bytes;
    ByteWriter request(bytes.data(), bytes.size());
    RtdeStream::begin(request, RtdeType::kRequestProtocolVersion);
    request.u16(static_cast<std::uint16_t>(protocol_));
    RtdePacket reply;
    TRY(ask(request, RtdeType::kRequestProtocolVersion, deadline, reply, why));
    ByteReader in(reply.payload, reply.size);
    const bool accepted = in.u8() == 1;
    if (!in.done()) return refuse(why, Status::kWireFormat, "the reply has an unexpected size");
    if (accepted) return Status::kOk;
  }
  return refuse(why, Status::kRefusedByRobot, "the controller offers neither protocol 2 nor 1");
}

Status RtdeClient::ask_version(const Deadline& deadline, Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kGetUrcontrolVersion);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kGetUrcontrolVersion, deadline, reply, why));
  ByteReader in(reply.payload, reply.size);
  version_.major = in.u32();
  version_.minor = in.u32();
  version_.bugfix = in.u32();
  version_.build = in.u32();
  if (!in.done()) return refuse(why, Status::kWireFormat, "the reply has an unexpected size");
  const double fastest_hz = 1.0 / version_.cycle_s();
  const bool at_own_rate = protocol_ == 2 || rate_hz_ == fastest_hz;
  if (version_.at_least(3, 9) && rate_hz_ <= fastest_hz && at_own_rate) return Status::kOk;
  why << "software " << static_cast<int>(version_.major) << "." << static_cast<int>(version_.minor);
  if (!version_.at_least(3, 9))
    why << " has no registers from 24 up; update to 3.9 or later";
  else
    why << (protocol_ == 2 ? ": at most " : ": ") << fastest_hz << " Hz, not " << rate_hz_
        << " Hz; set [robot] period_us = " << 1e6 / fastest_hz;
  return Status::kRefusedByRobot;
}

Status RtdeClient::ask_outputs(const Deadline& deadline, Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kSetupOutputs);
  if (protocol_ == 2) request.f64(rate_hz_);
  const OutputRecipe recipe(offered_);
  write_names(recipe.fields.data(), recipe.count, request);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kSetupOutputs, deadline, reply, why));
  ByteReader in(reply.payload, reply.size);
  if (protocol_ == 2) output_recipe_ = in.u8();
  const std::string_view types = in.rest();
  recipe_void_ = !recipe_void_ && leave_out(types);
  return recipe_void_ ? Status::kOk : check_types(types, recipe.fields.data(), recipe.count, why);
}

/// Leaves the fields of the tool that are not found out of the next recipe; false: all are.
bool RtdeClient::leave_out(std::string_view types) {
  bool any = false;
  for (std::size_t i = 0; i < kOutputFields.size(); ++i) {
    std::string_view type;
    if (!next_name(types, type)) break;
    if (i < kStateFields || type != name(FieldType::kNotFound)) continue;
    offered_[i - kStateFields] = false;
    any = true;
  }
  return any;
}

Status RtdeClient::ask_inputs(const Deadline& deadline, Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kSetupInputs);
  write_names(kInputFields.data(), inputs_, request);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kSetupInputs, deadline, reply, why));
  ByteReader in(reply.payload, reply.size);
  input_recipe_ = in.u8();
  TRY(check_types(in.rest(), kInputFields.data(), inputs_, why));
  return input_recipe_ != 0
             ? Status::kOk
             : refuse(why, Status::kRefusedByRobot, "the controller refused the input recipe");
}

Status RtdeClient::ask_start(const Deadline& deadline, Message& why) {
  Request bytes;
  ByteWriter request(bytes.data(), bytes.size());
  RtdeStream::begin(request, RtdeType::kStart);
  RtdePacket reply;
  TRY(ask(request, RtdeType::kStart, deadline, reply, why));
  ByteReader in(reply.payload, reply.size);
  const bool accepted = in.u8() == 1;
  if (!in.done()) return refuse(why, Status::kWireFormat, "the reply has an unexpected size");
  return accepted ? Status::kOk
                  : refuse(why, Status::kRefusedByRobot, "the controller refused to start sending");
}

Status RtdeClient::receive(UrState& state, int& count, Message& why) {
  count = 0;
  for (int i = 0; i < kMostPackets; ++i) {
    RtdePacket packet;
    bool any = false;
    Message reason;
    const Status status = stream_.next(packet, any, reason);
    if (status != Status::kOk) {
      why = Message("RTDE: ");
      why << reason;
      return status;
    }
    if (!any) break;
    if (packet.type != RtdeType::kDataPackage) continue;  // text messages
    ByteReader in(packet.payload, packet.size);
    if (protocol_ == 2 && in.u8() != output_recipe_)
      return refuse(why, Status::kWireFormat, "RTDE: a data package has the wrong recipe number");
    TRY(decode_state(in, offered_, state, why));
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
  for (std::size_t i = kSetPointFields; i < inputs_; i += 2) {  // eight outputs of a kind
    const std::size_t shift = 4 * (i - kSetPointFields);
    packet.u8(static_cast<std::uint8_t>(outputs_.mask >> shift));
    packet.u8(static_cast<std::uint8_t>(outputs_.value >> shift));
  }
  return stream_.send(packet);
}

Status RtdeStream::next(RtdePacket& packet, bool& any, Message& why) {
  Packet found;
  NextPacket next = frames_.next(found);
  if (next == NextPacket::kNone) {
    std::array<std::uint8_t, kLongest> bytes;
    const long got = socket.receive(bytes.data(), frames_.room());
    if (got < 0) {
      why = Message("the connection was closed");
      return Status::kConnectionLost;
    }
    frames_.take(bytes.data(), static_cast<std::size_t>(got));
    next = frames_.next(found);
  }
  any = next == NextPacket::kPacket;
  if (any)
    packet = {static_cast<RtdeType>(found.data[2]), found.data + kRtdeHeader,
              found.size - kRtdeHeader};
  if (next != NextPacket::kBroken) return Status::kOk;
  why = Message("the length of a packet is outside 3 to ");
  why << kLongest << " bytes";
  return Status::kWireFormat;
}

void SetPoints::start(int max_missed) {
  max_missed_ = max_missed;
  count_ = unsent_ = 0;
  last_.setZero();
}

Status SetPoints::send(const Vector6& q) {
  bool sent = false;
  last_ = q;
  count_ = count_ < std::numeric_limits<std::int32_t>::max() ? count_ + 1 : 1;
  return write(count_, q, sent);
}

Status SetPoints::clear(bool& sent) {
  count_ = 0;
  return write(0, last_, sent);
}

Status SetPoints::end(bool& sent) {
  return write(kServoEnded, last_, sent);
}

Status SetPoints::write(std::int32_t count, const Vector6& q, bool& sent) {
  const Socket::Sent result = session_.send(count, q);
  sent = result == Socket::Sent::kAll;
  unsent_ = result == Socket::Sent::kNothing ? unsent_ + 1 : 0;
  if (result == Socket::Sent::kLost) {
    why_ = Message("RTDE: the connection no longer accepts set-points");
    return Status::kConnectionLost;
  }
  if (unsent_ <= max_missed_) return Status::kOk;
  why_ = Message("RTDE: no set-point could be sent for ");
  why_ << unsent_ << (unsent_ == 1 ? " period" : " periods") << ", limit " << max_missed_
       << "; check the network";
  return Status::kBusTimeout;
}

}  // namespace tactus::ur
