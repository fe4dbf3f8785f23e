#include "sim_plant/ur/programs/external_text.hpp"

#include <algorithm>

#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {
namespace {

/// Finds the call of `function` with literal address and port, and this name for its socket.
bool find_socket(std::string_view text, std::string_view function, std::string_view name,
                 SocketPlace& place) {
  for (std::size_t at = text.find(function); at != std::string_view::npos;
       at = text.find(function)) {
    ScriptCall call;
    std::string_view rest = text.substr(at);
    text.remove_prefix(at + 1);
    if (!read_call(rest, {}, call) || call.name != function) continue;
    const ScriptValue *host = call.find("", 0), *socket = call.find("name", 2);
    if (host == nullptr || host->kind != ScriptValue::Kind::kText) continue;
    if (socket == nullptr || socket->text != name) continue;
    place = {host->text, integer(call.number("port", 1, 0.0))};
    return true;
  }
  return false;
}
bool find_socket(std::string_view text, std::string_view name, SocketPlace& place) {
  return find_socket(text, "connect_socket_with_retry", name, place) ||
         find_socket(text, "socket_open", name, place);
}

ServoLaw find_servo_law(std::string_view text) {
  ServoLaw law;
  for (std::size_t at = text.find("servoj("); at != std::string_view::npos;
       at = text.find("servoj(", at + 1)) {
    const std::string_view call = text.substr(at, text.find_first_of(")\n", at) - at);
    const bool lookahead = number_after(call, "lookahead_time=", law.lookahead_s);
    if (number_after(call, "gain=", law.gain) || lookahead) break;
  }
  return law;
}

/// True if some line, without its comment, contains the words.
bool says(std::string_view text, std::string_view words) {
  std::string_view line;
  while (next_line(text, line))
    if (without_comment(line).find(words) != std::string_view::npos) return true;
  return false;
}

/// Returns the position after the last socket close that follows the control loop, or npos.
std::size_t behind_loop(std::string_view text) {
  std::size_t behind = std::string_view::npos;
  for (const std::string_view closing :
       {"socket_close(\"trajectory_socket\")", "socket_close(\"script_command_socket\")",
        "socket_close(\"reverse_socket\")"}) {
    const std::size_t at = text.rfind(closing);
    if (at == std::string_view::npos) continue;
    const std::size_t end = at + closing.size();
    behind = behind == std::string_view::npos ? end : std::max(behind, end);
  }
  return behind;
}

/// True unless the program goes on after the loop when the control computer is silent, as early
/// releases of the client library do.
bool halts_when_silent(std::string_view text) {
  const std::size_t at = text.find("Socket timed out");
  if (at == std::string_view::npos) return true;
  text.remove_prefix(at);
  std::string_view line;
  while (next_line(text, line) && line.find("socket_close") == std::string_view::npos)
    if (trimmed(without_comment(line)) == "halt") return true;
  return false;
}

}  // namespace

bool is_external_control(std::string_view text) {
  SocketPlace place;
  return find_socket(text, kExternalSockets[2], place);
}

ExternalReading read_external_control(std::string_view text) {
  ExternalReading read;
  for (std::size_t i = 0; i < kExternalSockets.size(); ++i)
    find_socket(text, kExternalSockets[i], read.places[i]);
  read.law = find_servo_law(text);
  read.halts_when_silent = halts_when_silent(text);
  TrajectoryRun::Features& features = read.features;
  features.tells_cancelled = says(text, "socket_send_int(TRAJECTORY_RESULT_CANCELED");
  features.tells_left_only = says(text, "if trajectory_points_left > 0");
  const std::size_t cancel = text.find("== TRAJECTORY_MODE_CANCEL");
  features.counts_cancelled =
      cancel != std::string_view::npos && says(text.substr(cancel), "STREAMING_SENTINEL -");
  features.publishes_spline_time = says(text, "write_output_float_register(1,");
  features.format = find_point_format(text);
  const std::size_t behind = behind_loop(text);
  if (behind == std::string_view::npos) return read;
  read.behind = text.substr(behind);
  const std::string_view before = text.substr(0, behind);
  read.behind_line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
  return read;
}

}  // namespace tactus::ur
