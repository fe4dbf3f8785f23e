#include "sim_plant/ur/script/script_names.hpp"

#include "sim_plant/ur/script/script_signatures.hpp"

namespace tactus::ur {
namespace {

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
