// RobotMessages: what the controller has to say to the clients of port 30001, in order: text, key,
// error, change of the safety mode, runtime exception, popup. Bytes are built when something
// happens, and go out with the next chance.
#pragma once

#include "hal/ur/protocol.hpp"
#include "sim_plant/ur/outbox.hpp"
#include "sim_plant/ur/safety_codes.hpp"

namespace tactus::ur {

class RobotMessages {
 public:
  explicit RobotMessages(const Version& version) : version_(version) {}

  /// Stamps what follows, us since the controller started.
  void set_time(std::uint64_t time_us) { time_us_ = time_us; }

  void text(std::string_view text);
  void program_started(std::string_view name) { key("PROGRAM_XXX_STARTED", name); }
  void program_stopped(std::string_view name) { key("PROGRAM_XXX_STOPPED", name); }
  void safety_mode(SafetyMode mode, const Stop& stop);
  void error(const Stop& stop, ReportLevel level);
  void runtime_exception(std::int32_t line, std::int32_t column, std::string_view text);
  void popup(std::string_view title, std::string_view text, bool warning, bool error);

  /// The first message of every connection.
  void write_version(ByteWriter& writer) const;

  /// What waits for the clients; whoever has copied it clears it.
  const Outbox& pending() const { return pending_; }
  void clear() { pending_.clear(); }

 private:
  void begin(MessageSource source, MessageType type, ByteWriter& writer) const;
  void end(ByteWriter& writer);
  void key(std::string_view title, std::string_view text);

  Version version_;
  std::uint64_t time_us_ = 0;
  std::uint32_t popups_ = 0;
  Outbox pending_;
};

}  // namespace tactus::ur
