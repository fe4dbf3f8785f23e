#include "hal/ur/dashboard_client.hpp"

namespace tactus::ur {

Status DashboardClient::connect(const char* address, int port, int timeout_ms, Message& why) {
  timeout_ms_ = timeout_ms;
  TRY(socket_.connect(address, port, timeout_ms, why));
  Line greeting;
  TRY(read_line(greeting, why));
  if (std::string_view(greeting).substr(0, 10) == "Connected:") return Status::kOk;
  why = Message("dashboard: this is no dashboard: '");
  why << greeting << "'";
  return Status::kRefusedByRobot;
}

Status DashboardClient::ask(std::string_view command, std::string_view expected, Message& why) {
  Text<127> request(command);
  request << "\n";
  if (!socket_.send_all(request, timeout_ms_)) {
    why = Message("dashboard: the connection was closed");
    return Status::kConnectionLost;
  }
  Line reply;
  TRY(read_line(reply, why));
  if (std::string_view(reply).substr(0, expected.size()) == expected) return Status::kOk;
  why = Message("dashboard: '");
  why << command << "': '" << reply << "'";
  return Status::kRefusedByRobot;
}

/// One line, character by character: there is little to read, and nothing behind it is taken.
Status DashboardClient::read_line(Line& line, Message& why) {
  constexpr std::int64_t kMillisecond_ns = 1'000'000;
  for (std::size_t i = 0; i <= Line::capacity();) {
    std::uint8_t byte = 0;
    const long got = socket_.receive(&byte, 1);
    if (got < 0) {
      why = Message("dashboard: the connection was closed");
      return Status::kConnectionLost;
    }
    if (got == 0 && !socket_.wait(timeout_ms_ * kMillisecond_ns)) break;
    if (got == 0) continue;
    if (byte == '\n') return Status::kOk;
    const char character = static_cast<char>(byte);
    if (character != '\r') line << std::string_view(&character, 1);
    ++i;
  }
  why = Message("dashboard: no whole line within ");
  why << timeout_ms_ << " ms";
  return Status::kBusTimeout;
}

}  // namespace tactus::ur
