#include "hal/ur/robot_port.hpp"

#include <algorithm>

#include "hal/ur/stop_codes.hpp"

namespace tactus::ur {
namespace {

constexpr std::array<const char*, 6> kJoints = {"base",    "shoulder", "elbow",
                                                "wrist 1", "wrist 2",  "wrist 3"};

}  // namespace

Status RobotPort::connect(const char* address, int port, int timeout_ms, Message& why) {
  frames_.clear();
  stop_ = exception_ = Message();
  return socket_.connect(address, port, timeout_ms, why);
}

Status RobotPort::upload(std::string_view program, int timeout_ms, Message& why) {
  exception_ = Message();
  if (socket_.send_all(program, timeout_ms)) return Status::kOk;
  why = Message("the robot does not take the program");
  return Status::kConnectionLost;
}

/// Nothing here is needed for motion: a port that is lost or cannot be followed is closed, and RTDE
/// says what is to be done.
void RobotPort::receive() {
  if (!socket_.connected()) return;
  std::array<std::uint8_t, kMostBytes> bytes;
  const long got = socket_.receive(bytes.data(), std::min(bytes.size(), frames_.room()));
  if (got < 0) return socket_.close();
  frames_.take(bytes.data(), static_cast<std::size_t>(got));
  constexpr std::size_t kMostPackets = kMostBytes / 5;
  for (std::size_t i = 0; i < kMostPackets; ++i) {
    Packet packet;
    const NextPacket next = frames_.next(packet);
    if (next == NextPacket::kBroken) return socket_.close();
    if (next == NextPacket::kNone) return;
    take(packet);
  }
}

void RobotPort::take(const Packet& packet) {
  ByteReader in(packet.data, packet.size);
  in.i32();
  if (in.i8() != static_cast<std::int8_t>(StateType::kRobotMessage)) return;
  in.u64(), in.i8();  // time stamp, source
  const auto type = static_cast<MessageType>(in.u8());
  if (type == MessageType::kErrorCode) take_stop(in);
  if (type == MessageType::kRuntimeException) take_exception(in);
}

void RobotPort::take_stop(ByteReader& body) {
  const std::int32_t code = body.i32(), argument = body.i32(), level = body.i32();
  const bool a_stop = body.ok() && code > 0 && level >= static_cast<int>(ReportLevel::kWarning);
  if (!a_stop) return;
  stop_ = Message("C");
  stop_ << code << "A" << argument;
  const StopCode* row = find_stop_code(code);
  if (row == nullptr) return;
  stop_ << ": " << row->text;
  if (row->of_joint && argument >= 0 && argument < 6)
    stop_ << ", joint " << argument + 1 << " (" << kJoints[static_cast<std::size_t>(argument)]
          << ")";
}

void RobotPort::take_exception(ByteReader& body) {
  const std::int32_t line = body.i32(), column = body.i32();
  const std::string_view text = body.rest();
  if (!body.ok()) return;
  exception_ = Message("line ");
  exception_ << line << ", column " << column << ": " << text.substr(0, 200);
}

}  // namespace tactus::ur
