#include "hal/ur/robot_port.hpp"

#include <algorithm>

#include "hal/net/printable.hpp"
#include "hal/ur/stop_codes.hpp"

namespace tactus::ur {
namespace {

constexpr std::array<const char*, 6> kJoints = {"base",    "shoulder", "elbow",
                                                "wrist 1", "wrist 2",  "wrist 3"};

}  // namespace

Status RobotPort::connect(const char* address, int port, const Deadline& deadline, Message& why) {
  frames_.clear();
  unsent_ = {};
  broken_ = false;
  exception_ = Message();
  calibration_ = {};
  forget_stop();
  const Status status = socket_.connect(address, port, deadline, why);
  if (status != Status::kOk) why << "; the robot answers at rtde_port, so check primary_port";
  return status;
}

void RobotPort::upload(std::string_view program) {
  exception_ = Message();
  unsent_ = program;
}

void RobotPort::send() {
  if (socket_.connected() && uploading() && !socket_.send_some(unsent_)) socket_.close();
  if (!socket_.connected()) unsent_ = {};
}

void RobotPort::forget_stop() {
  stop_ = Message();
  stop_code_ = 0;
}

/// Motion does not need this port: if it is lost or cannot be read, it is closed. RTDE decides
/// whether to stop, and only arming finds that the port is gone.
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
    broken_ = next == NextPacket::kBroken;
    if (broken_) return socket_.close();
    if (next == NextPacket::kNone) return;
    take(packet);
  }
}

void RobotPort::take(const Packet& packet) {
  ByteReader in(packet.data, packet.size);
  in.i32();
  const auto state = static_cast<StateType>(in.i8());
  if (state == StateType::kRobotState) take_state(in);
  if (state != StateType::kRobotMessage) return;
  in.u64();  // time stamp
  in.i8();   // source
  const auto type = static_cast<MessageType>(in.u8());
  if (type == MessageType::kErrorCode) take_stop(in);
  if (type == MessageType::kRuntimeException) take_exception(in);
}

/// A part is at least as long as its head, so the packet bounds their number.
void RobotPort::take_state(ByteReader& parts) {
  constexpr std::uint32_t kHead = 5;
  while (parts.left() >= kHead) {
    const std::uint32_t size = parts.u32();
    const auto part = static_cast<StatePart>(parts.u8());
    if (size < kHead) return;
    const std::string_view body = parts.text(size - kHead);
    if (part == StatePart::kKinematics)
      calibration_.take({reinterpret_cast<const std::uint8_t*>(body.data()), body.size()});
  }
}

void RobotPort::take_stop(ByteReader& body) {
  const std::int32_t code = body.i32(), argument = body.i32(), level = body.i32();
  const bool a_stop = body.ok() && code > 0 && level >= static_cast<int>(ReportLevel::kWarning);
  if (!a_stop) return;
  stop_code_ = static_cast<std::uint32_t>(code);
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
  exception_ << line << ", column " << column << ": " << printable(text.substr(0, 200));
}

}  // namespace tactus::ur
