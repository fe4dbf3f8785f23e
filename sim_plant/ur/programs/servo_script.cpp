#include "sim_plant/ur/programs/servo_script.hpp"

#include <algorithm>

#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {
namespace {

/// Reads lookahead and gain of one call, by name or as its fifth and sixth argument. False: neither
/// is a number.
bool read_servo_law(std::string_view arguments, ServoLaw& law) {
  bool found = false;
  for (int i = 0; !arguments.empty(); ++i) {
    const std::size_t end = std::min(arguments.find(','), arguments.size());
    std::string_view argument = trimmed(arguments.substr(0, end));
    arguments.remove_prefix(std::min(end + 1, arguments.size()));
    const std::string_view name = leading_name(argument);
    const std::size_t equals = argument.find('=');
    const bool named = equals != std::string_view::npos;
    if (named) argument.remove_prefix(equals + 1);
    const bool lookahead = named ? name == "lookahead_time" : i == 4;
    const bool gain = named ? name == "gain" : i == 5;
    if (lookahead) found |= read_number(argument, law.lookahead_s);
    if (gain) found |= read_number(argument, law.gain);
  }
  return found;
}

/// Finds the next such call and cuts the text after its first letter.
bool next_socket(std::string_view& text, std::string_view function, SocketPlace& place) {
  for (std::size_t at = text.find(function); at != std::string_view::npos;
       at = text.find(function)) {
    ScriptCall call;
    std::string_view rest = text.substr(at);
    text.remove_prefix(at + 1);
    if (!read_call(rest, {}, call) || call.name != function) continue;
    const ScriptValue* host = call.find("", 0);
    if (host == nullptr || host->kind != ScriptValue::Kind::kText) continue;
    const ScriptValue* name = call.find("name", 2);
    place.host = host->text;
    place.port = integer(call.number("port", 1, 0.0));
    place.name = name != nullptr ? name->text : "socket_0";
    return true;
  }
  return false;
}

}  // namespace

bool find_socket_named(std::string_view text, std::string_view function, std::string_view name,
                       SocketPlace& place) {
  while (next_socket(text, function, place))
    if (place.name == name) return true;
  return false;
}

ServoLaw find_servo_law(std::string_view text) {
  ServoLaw law;
  for (std::size_t at = text.find("servoj("); at != std::string_view::npos;
       at = text.find("servoj(", at + 1)) {
    std::string_view call = text.substr(at + 7);
    call = call.substr(0, call.find_first_of(")\n"));
    if (read_servo_law(call, law)) break;
  }
  return law;
}

}  // namespace tactus::ur
