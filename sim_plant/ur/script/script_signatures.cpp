#include "sim_plant/ur/script/script_signatures.hpp"

#include <algorithm>

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

/// Takes the next word off a list; empty: there is none.
std::string_view take_word(std::string_view& list, char separator) {
  const std::size_t end = std::min(list.find(separator), list.size());
  const std::string_view word = list.substr(0, end);
  list.remove_prefix(std::min(end + 1, list.size()));
  return word;
}

/// Finds the parameter that an argument means, and its position. Empty: there is none.
std::string_view parameter_of(const ScriptSignature& signature, const ScriptCall& call,
                              std::size_t argument, std::size_t& position) {
  std::string_view rest = signature.parameters;
  const std::string_view wanted = call.arguments[argument].name;
  for (position = 0; !rest.empty(); ++position) {
    const std::string_view parameter = take_word(rest, ' ');
    if (wanted.empty() && position == argument) return parameter;
    std::string_view names = parameter.substr(1);
    while (!wanted.empty() && !names.empty())
      if (take_word(names, '/') == wanted) return parameter;
  }
  return {};
}

bool fits(char kind, const ScriptValue& value) {
  const bool list = value.kind == Kind::kList || value.kind == Kind::kPose;
  return value.kind == Kind::kNothing || kind == '*' || (kind == '1' && value.numeric()) ||
         (kind == '3' && list && value.count == 3) || (kind == '6' && value.six()) ||
         (kind == 's' && value.kind == Kind::kText);
}

/// Functions that are not emulated.
constexpr std::string_view kOthers =
    " acos asin atan binary_list_to_integer conveyor_pulse_decode direct_torque "
    "enable_external_ft_sensor encoder_enable_pulse_decode end_screw_driving "
    "force_mode_set_gain_scaling ft_rtde_input_enable get_actual_joint_positions_history "
    "get_actual_tcp_speed get_actual_tool_flange_pose get_analog_in get_analog_out "
    "get_controller_temp get_conveyor_tick_count get_euromap_input get_euromap_output "
    "get_flag get_joint_positions get_joint_speeds get_joint_temp get_joint_torques "
    "get_list_length get_standard_analog_in get_standard_analog_out get_target_payload_cog "
    "get_target_tcp_speed get_target_waypoint get_tcp_speed get_tool_accelerometer_reading "
    "get_tool_analog_in get_tool_current integer_to_binary_list interpolate_pose "
    "is_within_safety_limits length log modbus_add_signal modbus_delete_signal "
    "modbus_get_signal_status modbus_set_digital_output normalize point_dist pose_add "
    "pose_dist pose_sub random read_port_bit read_port_register "
    "request_boolean_from_primary_client request_float_from_primary_client "
    "request_integer_from_primary_client rotvec2rpy rpc_factory rpy2rotvec "
    "set_conveyor_tick_count set_euromap_output set_flag set_gravity set_payload_cog "
    "set_payload_mass socket_get_var socket_read_ascii_float socket_read_binary_integer "
    "socket_read_byte_list socket_read_line socket_read_string socket_send_byte "
    "socket_set_var stop_conveyor_tracking str_at str_cat str_empty str_find str_len str_sub "
    "to_num to_str tool_contact track_conveyor_circular track_conveyor_linear wrench_trans "
    "write_port_bit write_port_register ";
constexpr std::string_view kWords =
    " and break continue def elif else end enter_critical exit_critical global if join kill local "
    "not or p return run sec thread while xor ";

bool listed(std::string_view list, std::string_view name) {
  if (name.empty()) return false;
  for (std::size_t at = list.find(name); at != std::string_view::npos; at = list.find(name, at + 1))
    if (list[at - 1] == ' ' && list[at + name.size()] == ' ') return true;
  return false;
}

}  // namespace

std::string_view argument_fault(const ScriptCall& call, std::string_view& word) {
  const LineCall* command = find_call(call.name);
  const ValueCall* function = find_function(call.name);
  const ScriptSignature* signature = command != nullptr    ? &command->signature
                                     : function != nullptr ? &function->signature
                                                           : nullptr;
  if (signature == nullptr || signature->parameters == kAnything) return {};
  std::array<bool, ScriptCall::kMost> given{};
  for (std::size_t i = 0; i < call.count; ++i) {
    const std::string_view name = call.arguments[i].name;
    word = name.empty() ? call.name : name;
    if (name.empty() && i > 0 && !call.arguments[i - 1].name.empty())
      return "has an argument by position after one by name";
    std::size_t position = 0;
    const std::string_view parameter = parameter_of(*signature, call, i, position);
    if (parameter.empty()) return name.empty() ? "has too many arguments" : "is no parameter";
    if (given[position]) return "is given twice";
    given[position] = true;
    if (!fits(parameter[0], call.arguments[i].value)) return "has an argument of another kind";
  }
  word = call.name;
  const bool all = std::all_of(given.begin(), given.begin() + signature->required,
                               [](bool present) { return present; });
  return all ? std::string_view() : "lacks an argument";
}

std::string_view range_fault(const ScriptCall& call, const ScriptSignature& signature) {
  const bool moves = starts_with(call.name, "move");
  const double t = moves ? call.number("t", 3, 0.0) : 0.0;
  const bool timed = (call.name == "movej" || call.name == "movel") && t > 0.0;
  for (std::size_t i = 0; i < call.count; ++i) {
    std::size_t position = 0;
    const std::string_view parameter = parameter_of(signature, call, i, position);
    if (parameter.empty()) continue;
    const std::string_view name = leading_name(parameter.substr(1));
    const double value = call.arguments[i].value.number;
    const bool rate = name == "a" || name == "v";
    if (rate && call.name != "servoj" && !timed && !(value > 0.0))
      return name == "a" ? "a must be above 0" : "v must be above 0";
    if (name == "t" && !(value >= 0.0)) return "t must not be negative";
    if (name == "r" && !(value >= 0.0)) return "r must not be negative";
  }
  return {};
}

bool is_urscript_function(std::string_view name) {
  return find_call(name) != nullptr || find_function(name) != nullptr || listed(kOthers, name);
}

bool is_urscript_word(std::string_view name) {
  return listed(kWords, name);
}

}  // namespace tactus::ur
