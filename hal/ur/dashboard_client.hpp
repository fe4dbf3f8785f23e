// DashboardClient: power, brakes and protective stops, by the text commands of port 29999. For the
// start alone: in the cycle nobody asks it anything.
#pragma once

#include "hal/ur/socket.hpp"

namespace tactus::ur {

class DashboardClient {
 public:
  /// Connects and waits for the greeting. kConnectionLost, kBusTimeout. [init]
  Status connect(const char* address, int port, int timeout_ms, Message& why);
  /// One command; kRefusedByRobot, and `why` has command and reply, unless the reply begins with
  /// `expected`. [init]
  Status ask(std::string_view command, std::string_view expected, Message& why);
  void close() { socket_.close(); }

 private:
  using Line = Text<255>;
  Status read_line(Line& line, Message& why);

  Socket socket_;
  int timeout_ms_ = 0;
};

}  // namespace tactus::ur
