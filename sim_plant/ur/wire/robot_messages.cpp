#include "sim_plant/ur/wire/robot_messages.hpp"

namespace tactus::ur {
namespace {

constexpr std::size_t kLongest = 2048;
constexpr std::size_t kLongestText = 1500;

}  // namespace

void RobotMessages::begin(MessageSource source, MessageType type, ByteWriter& writer) const {
  writer.u32(0);
  writer.i8(static_cast<std::int8_t>(StateType::kRobotMessage));
  writer.u64(time_us_);
  writer.i8(static_cast<std::int8_t>(source));
  writer.u8(static_cast<std::uint8_t>(type));
}

template <class Write>
void RobotMessages::tell(MessageSource source, MessageType type, Write write) {
  std::array<std::uint8_t, kLongest> bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  begin(source, type, writer);
  write(writer);
  writer.set_u32(0, writer.size());
  if (writer.ok()) pending_.put(writer.data(), writer.size());
}

void RobotMessages::text(std::string_view text) {
  tell(MessageSource::kRuntimeMachine, MessageType::kText,
       [&](ByteWriter& writer) { writer.text(text.substr(0, kLongestText)); });
}

void RobotMessages::key(std::string_view title, std::string_view text) {
  tell(MessageSource::kRuntimeMachine, MessageType::kKey, [&](ByteWriter& writer) {
    writer.i32(0);
    writer.i32(0);
    writer.short_text(title);
    writer.text(text.substr(0, kLongestText));
  });
}

void RobotMessages::safety_mode(SafetyMode mode, const Stop& stop) {
  tell(MessageSource::kRobotInterface, MessageType::kSafetyMode, [&](ByteWriter& writer) {
    writer.i32(static_cast<std::int32_t>(stop.code));
    writer.i32(stop.argument);
    writer.u8(static_cast<std::uint8_t>(mode));
    writer.zeros(8);  // no data
  });
}

void RobotMessages::error(const Stop& stop, ReportLevel level) {
  tell(MessageSource::kRobotInterface, MessageType::kErrorCode, [&](ByteWriter& writer) {
    writer.i32(static_cast<std::int32_t>(stop.code));
    writer.i32(stop.argument);
    writer.i32(static_cast<std::int32_t>(level));
    writer.zeros(8);  // no data
  });
}

void RobotMessages::runtime_exception(std::int32_t line, std::int32_t column,
                                      std::string_view text) {
  tell(MessageSource::kRuntimeMachine, MessageType::kRuntimeException, [&](ByteWriter& writer) {
    writer.i32(line);
    writer.i32(column);
    writer.text(text.substr(0, kLongestText));
  });
}

void RobotMessages::popup(std::string_view title, std::string_view text, bool warning, bool error) {
  tell(MessageSource::kRuntimeMachine, MessageType::kPopup, [&](ByteWriter& writer) {
    writer.u32(++popups_);
    writer.u8(0);
    writer.u8(warning ? 1 : 0);
    writer.u8(error ? 1 : 0);
    writer.u8(0);  // not blocking
    writer.short_text(title);
    writer.text(text.substr(0, kLongestText));
  });
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
