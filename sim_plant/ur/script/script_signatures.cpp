// Parameters as in the script manual of version 3.15.
#include "sim_plant/ur/script/script_signatures.hpp"

#include <algorithm>

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;
using Use = ScriptSignature::Use;

constexpr ScriptSignature kSignatures[] = {
    {Use::kLine, "end_force_mode", "", 0},
    {Use::kLine, "end_freedrive_mode", "", 0},
    {Use::kLine, "end_teach_mode", "", 0},
    {Use::kLine, "force_mode", "6task_frame 6selection_vector 6wrench 1type 6limits", 5},
    {Use::kLine, "force_mode_set_damping", "1damping", 1},
    {Use::kLine, "freedrive_mode", "", 0},
    {Use::kLine, "halt", "", 0},
    {Use::kLine, "movec", "6pose_via 6pose_to 1a 1v 1r 1mode", 2},
    {Use::kLine, "movej", "6q 1a 1v 1t 1r", 1},
    {Use::kLine, "movel", "6pose 1a 1v 1t 1r", 1},
    {Use::kLine, "movep", "6pose 1a 1v 1r", 1},
    {Use::kLine, "popup", "*s *title *warning *error *blocking", 1},
    {Use::kLine, "powerdown", "", 0},
    {Use::kLine, "protective_stop", "", 0},
    {Use::kLine, "rtde_set_watchdog", "svariable_name 1min_frequency saction", 2},
    {Use::kLine, "servoc", "6pose 1a 1v 1r", 1},
    {Use::kLine, "servoj", "6q 1a 1v 1t 1lookahead_time 1gain", 1},
    {Use::kLine, "set_analog_out", "1n 1f", 2},
    {Use::kLine, "set_configurable_digital_out", "1n 1b", 2},
    {Use::kLine, "set_digital_out", "1n 1b", 2},
    {Use::kLine, "set_payload", "1m 3cog", 1},
    {Use::kLine, "set_standard_analog_out", "1n 1f", 2},
    {Use::kLine, "set_standard_digital_out", "1n 1b", 2},
    {Use::kLine, "set_target_payload", "1m 3cog 6inertia 1transition_time", 1},
    {Use::kLine, "set_tcp", "6pose", 1},
    {Use::kLine, "set_tool_digital_out", "1n 1b", 2},
    {Use::kLine, "set_tool_voltage", "1voltage", 1},
    {Use::kLine, "sleep", "1t", 1},
    {Use::kLine, "socket_close", "ssocket_name", 0},
    {Use::kLine, "socket_open", "s 1port ssocket_name", 2},
    {Use::kLine, "socket_send_int", "1 ssocket_name", 1},
    {Use::kLine, "socket_send_line", "s ssocket_name", 1},
    {Use::kLine, "socket_send_string", "s ssocket_name", 1},
    {Use::kLine, "speedj", "6qd 1a 1t/t_min", 1},
    {Use::kLine, "speedl", "6xd 1a 1t/t_min *aRot", 1},
    {Use::kLine, "stopj", "1a", 1},
    {Use::kLine, "stopl", "1a *aRot", 1},
    {Use::kLine, "sync", "", 0},
    {Use::kLine, "teach_mode", "", 0},
    {Use::kLine, "textmsg", "* *", 1},
    {Use::kLine, "write_output_boolean_register", "1address/port_id 1value", 2},
    {Use::kLine, "write_output_float_register", "1address/port_id 1value", 2},
    {Use::kLine, "write_output_integer_register", "1address/port_id 1value", 2},
    {Use::kLine, "zero_ftsensor", "", 0},
    {Use::kValue, "atan2", "1 1", 2},
    {Use::kValue, "ceil", "1", 1},
    {Use::kValue, "cos", "1", 1},
    {Use::kValue, "d2r", "1", 1},
    {Use::kValue, "floor", "1", 1},
    {Use::kValue, "force", "", 0},
    {Use::kValue, "get_actual_joint_positions", "", 0},
    {Use::kValue, "get_actual_joint_speeds", "", 0},
    {Use::kValue, "get_actual_tcp_pose", "", 0},
    {Use::kValue, "get_configurable_digital_in", "1n", 1},
    {Use::kValue, "get_configurable_digital_out", "1n", 1},
    {Use::kValue, "get_digital_in", "1n", 1},
    {Use::kValue, "get_digital_out", "1n", 1},
    {Use::kValue, "get_forward_kin", "6", 1},
    {Use::kValue, "get_inverse_kin", "6 6qnear 1 1", 1},
    {Use::kValue, "get_inverse_kin_has_solution", "6 6qnear 1 1", 1},
    {Use::kValue, "get_standard_digital_in", "1n", 1},
    {Use::kValue, "get_standard_digital_out", "1n", 1},
    {Use::kValue, "get_steptime", "", 0},
    {Use::kValue, "get_target_joint_positions", "", 0},
    {Use::kValue, "get_target_joint_speeds", "", 0},
    {Use::kValue, "get_target_payload", "", 0},
    {Use::kValue, "get_target_tcp_pose", "", 0},
    {Use::kValue, "get_tcp_force", "", 0},
    {Use::kValue, "get_tcp_offset", "", 0},
    {Use::kValue, "get_tool_digital_in", "1n", 1},
    {Use::kValue, "get_tool_digital_out", "1n", 1},
    {Use::kValue, "is_steady", "", 0},
    {Use::kValue, "norm", "*", 1},
    {Use::kValue, "pose_inv", "6", 1},
    {Use::kValue, "pose_trans", "6 6", 2},
    {Use::kValue, "pow", "1 1", 2},
    {Use::kValue, "r2d", "1", 1},
    {Use::kValue, "read_input_boolean_register", "1address", 1},
    {Use::kValue, "read_input_float_register", "1address", 1},
    {Use::kValue, "read_input_integer_register", "1address", 1},
    {Use::kValue, "read_output_boolean_register", "1address", 1},
    {Use::kValue, "read_output_float_register", "1address", 1},
    {Use::kValue, "read_output_integer_register", "1address", 1},
    {Use::kValue, "sin", "1", 1},
    {Use::kValue, "sqrt", "1", 1},
    {Use::kValue, "tan", "1", 1},
    {Use::kIgnored, "position_deviation_warning", "", 0},
    {Use::kIgnored, "reset_revolution_counter", "", 0},
    {Use::kIgnored, "set_analog_inputrange", "", 0},
    {Use::kIgnored, "set_analog_outputdomain", "", 0},
    {Use::kIgnored, "set_input_actions_to_default", "", 0},
    {Use::kIgnored, "set_runstate_standard_analog_output_to_value", "", 0},
    {Use::kIgnored, "set_safety_mode_transition_hardness", "", 0},
    {Use::kIgnored, "set_standard_analog_input_domain", "", 0},
    {Use::kIgnored, "set_tool_analog_input_domain", "", 0},
    {Use::kIgnored, "set_tool_communication", "", 0},
};

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

constexpr std::string_view kFunctions =
    " acos asin atan atan2 binary_list_to_integer ceil conveyor_pulse_decode cos d2r "
    "direct_torque enable_external_ft_sensor encoder_enable_pulse_decode end_force_mode "
    "end_freedrive_mode end_screw_driving end_teach_mode floor force force_mode "
    "force_mode_set_damping force_mode_set_gain_scaling freedrive_mode ft_rtde_input_enable "
    "get_actual_joint_positions get_actual_joint_positions_history get_actual_joint_speeds "
    "get_actual_tcp_pose get_actual_tcp_speed get_actual_tool_flange_pose get_analog_in "
    "get_analog_out get_configurable_digital_in get_configurable_digital_out get_controller_temp "
    "get_conveyor_tick_count get_digital_in get_digital_out get_euromap_input get_euromap_output "
    "get_flag get_forward_kin get_inverse_kin get_inverse_kin_has_solution get_joint_positions "
    "get_joint_speeds get_joint_temp get_joint_torques get_list_length get_standard_analog_in "
    "get_standard_analog_out get_standard_digital_in get_standard_digital_out get_steptime "
    "get_target_joint_positions get_target_joint_speeds get_target_payload get_target_payload_cog "
    "get_target_tcp_pose get_target_tcp_speed get_target_waypoint get_tcp_force get_tcp_offset "
    "get_tcp_speed get_tool_accelerometer_reading get_tool_analog_in get_tool_current "
    "get_tool_digital_in get_tool_digital_out halt integer_to_binary_list interpolate_pose "
    "is_steady is_within_safety_limits length log modbus_add_signal modbus_delete_signal "
    "modbus_get_signal_status modbus_set_digital_output movec movej movel movep norm normalize "
    "point_dist popup pose_add pose_dist pose_inv pose_sub pose_trans position_deviation_warning "
    "pow powerdown protective_stop r2d random read_input_boolean_register "
    "read_input_float_register read_input_integer_register read_output_boolean_register "
    "read_output_float_register read_output_integer_register read_port_bit read_port_register "
    "request_boolean_from_primary_client request_float_from_primary_client "
    "request_integer_from_primary_client reset_revolution_counter rotvec2rpy rpc_factory "
    "rpy2rotvec "
    "rtde_set_watchdog servoc servoj set_analog_inputrange set_analog_out set_analog_outputdomain "
    "set_configurable_digital_out set_conveyor_tick_count set_digital_out set_euromap_output "
    "set_flag set_gravity set_input_actions_to_default set_payload set_payload_cog "
    "set_payload_mass set_runstate_standard_analog_output_to_value "
    "set_safety_mode_transition_hardness "
    "set_standard_analog_input_domain set_standard_analog_out set_standard_digital_out "
    "set_target_payload set_tcp set_tool_analog_input_domain set_tool_communication "
    "set_tool_digital_out set_tool_voltage sin sleep socket_close socket_get_var socket_open "
    "socket_read_ascii_float socket_read_binary_integer socket_read_byte_list socket_read_line "
    "socket_read_string socket_send_byte socket_send_int socket_send_line socket_send_string "
    "socket_set_var speedj speedl sqrt stop_conveyor_tracking stopj stopl str_at str_cat str_empty "
    "str_find str_len str_sub sync tan teach_mode textmsg to_num to_str tool_contact "
    "track_conveyor_circular track_conveyor_linear wrench_trans write_output_boolean_register "
    "write_output_float_register write_output_integer_register write_port_bit "
    "write_port_register zero_ftsensor ";
constexpr std::string_view kWords =
    " and break continue def elif else end enter_critical exit_critical global if join kill local "
    "not or p return run sec thread while xor ";

bool listed(std::string_view list, std::string_view name) {
  for (std::size_t at = list.find(name); at != std::string_view::npos; at = list.find(name, at + 1))
    if (list[at - 1] == ' ' && list[at + name.size()] == ' ') return true;
  return false;
}

}  // namespace

const ScriptSignature* find_signature(std::string_view name) {
  const auto* const found =
      std::find_if(std::begin(kSignatures), std::end(kSignatures),
                   [&](const ScriptSignature& signature) { return signature.name == name; });
  return found != std::end(kSignatures) ? found : nullptr;
}

std::string_view argument_fault(const ScriptCall& call, std::string_view& word) {
  const ScriptSignature* signature = find_signature(call.name);
  if (signature == nullptr || signature->use == Use::kIgnored) return {};
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

std::string_view range_fault(const ScriptCall& call) {
  const ScriptSignature* signature = find_signature(call.name);
  if (signature == nullptr) return {};
  const bool moves = starts_with(call.name, "move");
  const double t = moves ? call.number("t", 3, 0.0) : 0.0;
  const bool timed = (call.name == "movej" || call.name == "movel") && t > 0.0;
  for (std::size_t i = 0; i < call.count; ++i) {
    std::size_t position = 0;
    const std::string_view parameter = parameter_of(*signature, call, i, position);
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
  return !name.empty() && listed(kFunctions, name);
}

bool is_urscript_word(std::string_view name) {
  return !name.empty() && listed(kWords, name);
}

bool is_emulated_call(std::string_view name) {
  const ScriptSignature* signature = find_signature(name);
  return signature != nullptr && signature->use != ScriptSignature::Use::kValue;
}

bool is_emulated_value(std::string_view name) {
  const ScriptSignature* signature = find_signature(name);
  return signature != nullptr && signature->use == ScriptSignature::Use::kValue;
}

}  // namespace tactus::ur
