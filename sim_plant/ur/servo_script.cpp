#include "sim_plant/ur/servo_script.hpp"

#include "sim_plant/ur/script_text.hpp"

namespace tactus::ur {

bool find_socket(std::string_view text, std::string_view function, int n, SocketPlace& place) {
  const ScriptVariables none;
  for (std::size_t at = text.find(function); at != std::string_view::npos;
       at = text.find(function, at + 1)) {
    ScriptCall call;
    if (!read_call(text.substr(at), none, call) || call.name != function) continue;
    const ScriptValue* host = call.find("", 0);
    if (host == nullptr || host->kind != ScriptValue::Kind::kText) continue;
    if (n-- > 0) continue;
    const ScriptValue* name = call.find("name", 2);
    place.host = host->text;
    place.port = static_cast<int>(call.number("port", 1, 0.0));
    place.name = name != nullptr ? name->text : "socket_0";
    return true;
  }
  return false;
}

bool find_socket_named(std::string_view text, std::string_view function, std::string_view name,
                       SocketPlace& place) {
  for (int n = 0; find_socket(text, function, n, place); ++n)
    if (place.name == name) return true;
  return false;
}

ServoLaw find_servo_law(std::string_view text) {
  ServoLaw law;
  for (std::size_t at = text.find("servoj("); at != std::string_view::npos;
       at = text.find("servoj(", at + 1)) {
    const std::string_view call = text.substr(at, text.substr(at).find('\n'));
    const bool lookahead = number_after(call, "lookahead_time=", law.lookahead_s);
    const bool gain = number_after(call, "gain=", law.gain);
    if (lookahead || gain) break;
  }
  return law;
}

}  // namespace tactus::ur
