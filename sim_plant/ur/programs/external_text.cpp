// Reads the text of external control: its sockets, and the lines that releases and tests differ in.
#include <algorithm>

#include "sim_plant/ur/programs/external_control.hpp"

namespace tactus::ur {
namespace {

constexpr std::string_view kConnect = "connect_socket_with_retry";

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

bool ExternalControl::recognises(std::string_view text) {
  SocketPlace place;
  return find_socket_named(text, kConnect, kSockets[2], place) ||
         find_socket_named(text, "socket_open", kSockets[2], place);
}

void ExternalControl::start(std::string_view text) {
  *this = {};
  for (std::size_t i = 0; i < kSockets.size(); ++i)
    if (!find_socket_named(text, kConnect, kSockets[i], places_[i]))
      find_socket_named(text, "socket_open", kSockets[i], places_[i]);
  law_ = find_servo_law(text);
  halts_when_silent_ = halts_when_silent(text);
  TrajectoryRun::Features features;
  features.tells_cancelled = says(text, "socket_send_int(TRAJECTORY_RESULT_CANCELED");
  features.tells_left_only = says(text, "if trajectory_points_left > 0");
  const std::size_t cancel = text.find("== TRAJECTORY_MODE_CANCEL");
  features.counts_cancelled =
      cancel != std::string_view::npos && says(text.substr(cancel), "STREAMING_SENTINEL -");
  features.publishes_spline_time = says(text, "write_output_float_register(1,");
  features.format = find_point_format(text);
  trajectory_.set_features(features);
  const std::size_t behind = behind_loop(text);
  if (behind == std::string_view::npos) return;
  behind_ = text.substr(behind);
  const auto before = text.substr(0, behind);
  behind_line_ = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
}

}  // namespace tactus::ur
