#include "sim_plant/ur/wire/robot_messages.hpp"

namespace tactus::ur {
namespace {

constexpr std::size_t kLongest = 2048;
constexpr std::size_t kLongestText = 1500;

using Bytes = std::array<std::uint8_t, kLongest>;

}  // namespace

void RobotMessages::begin(MessageSource source, MessageType type, ByteWriter& writer) const {
  writer.u32(0);
  writer.i8(static_cast<std::int8_t>(StateType::kRobotMessage));
  writer.u64(time_us_);
  writer.i8(static_cast<std::int8_t>(source));
  writer.u8(static_cast<std::uint8_t>(type));
}

void RobotMessages::end(ByteWriter& writer) {
  writer.set_u32(0, writer.size());
  if (writer.ok()) pending_.put(writer.data(), writer.size());
}

void RobotMessages::text(std::string_view text) {
  Bytes bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  begin(MessageSource::kRuntimeMachine, MessageType::kText, writer);
  writer.text(text.substr(0, kLongestText));
  end(writer);
}

void RobotMessages::key(std::string_view title, std::string_view text) {
  Bytes bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  begin(MessageSource::kRuntimeMachine, MessageType::kKey, writer);
  writer.i32(0);
  writer.i32(0);
  writer.short_text(title);
  writer.text(text.substr(0, kLongestText));
  end(writer);
}

void RobotMessages::safety_mode(SafetyMode mode, const Stop& stop) {
  Bytes bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  begin(MessageSource::kRobotInterface, MessageType::kSafetyMode, writer);
  writer.i32(static_cast<std::int32_t>(stop.code));
  writer.i32(stop.argument);
  writer.u8(static_cast<std::uint8_t>(mode));
  writer.u32(0);  // no data
  writer.u32(0);
  end(writer);
}

void RobotMessages::error(const Stop& stop, ReportLevel level) {
  Bytes bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  begin(MessageSource::kRobotInterface, MessageType::kErrorCode, writer);
  writer.i32(static_cast<std::int32_t>(stop.code));
  writer.i32(stop.argument);
  writer.i32(static_cast<std::int32_t>(level));
  writer.u32(0);  // no data
  writer.u32(0);
  end(writer);
}

void RobotMessages::runtime_exception(std::int32_t line, std::int32_t column,
                                      std::string_view text) {
  Bytes bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  begin(MessageSource::kRuntimeMachine, MessageType::kRuntimeException, writer);
  writer.i32(line);
  writer.i32(column);
  writer.text(text.substr(0, kLongestText));
  end(writer);
}

void RobotMessages::popup(std::string_view title, std::string_view text, bool warning, bool error) {
  Bytes bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  begin(MessageSource::kRuntimeMachine, MessageType::kPopup, writer);
  writer.u32(++popups_);
  writer.u8(0);
  writer.u8(warning ? 1 : 0);
  writer.u8(error ? 1 : 0);
  writer.u8(0);  // not blocking
  writer.short_text(title);
  writer.text(text.substr(0, kLongestText));
  end(writer);
}

void RobotMessages::write_version(ByteWriter& writer) const {
  const std::size_t at = writer.size();
  begin(MessageSource::kRobotInterface, MessageType::kVersion, writer);
  writer.short_text("URControl");
  writer.u8(static_cast<std::uint8_t>(version_.major));
  writer.u8(static_cast<std::uint8_t>(version_.minor));
  writer.u32(version_.bugfix);
  if (version_.at_least(3, 3)) writer.u32(version_.build);
  writer.text("01-01-2022, 00:00:00");
  writer.set_u32(at, writer.size() - at);
}

}  // namespace tactus::ur
