// RobotMessages: the messages of the controller to the clients of port 30001, in order: text, key,
// error, change of the safety mode, runtime exception, popup. A message is built when its event
// happens, and is sent as soon as possible.
#pragma once

#include "hal/ur/protocol.hpp"
#include "sim_plant/ur/motion/safety_limits.hpp"
#include "sim_plant/ur/wire/outbox.hpp"

namespace tactus::ur {

class RobotMessages {
 public:
  explicit RobotMessages(const Version& version) : version_(version) {}

  /// Sets the stamp of later messages, us since the controller started.
  void set_time(std::uint64_t time_us) { time_us_ = time_us; }

  void text(std::string_view text);
  void program_started(std::string_view name) { key("PROGRAM_XXX_STARTED", name); }
  void program_stopped(std::string_view name) { key("PROGRAM_XXX_STOPPED", name); }
  void safety_mode(SafetyMode mode, const Stop& stop);
  void error(const Stop& stop, ReportLevel level);
  void runtime_exception(std::int32_t line, std::int32_t column, std::string_view text);
  void popup(std::string_view title, std::string_view text, bool warning, bool error);

  /// Writes the first message of every connection.
  void write_version(ByteWriter& writer) const;

  /// The messages that wait for the clients; call clear() after copying them.
  const Outbox& pending() const { return pending_; }
  void clear() { pending_.clear(); }

 private:
  void begin(MessageSource source, MessageType type, ByteWriter& writer) const;
  template <class Write>
  void tell(MessageSource source, MessageType type, Write write);
  void key(std::string_view title, std::string_view text);

  Version version_;
  std::uint64_t time_us_ = 0;
  std::uint32_t popups_ = 0;
  Outbox pending_;
};

}  // namespace tactus::ur
