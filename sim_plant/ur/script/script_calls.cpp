// The calls of URScript that a line may make. Parameters as in the script manual of version 3.15.
#include "sim_plant/ur/script/script_calls.hpp"

#include <algorithm>

#include "sim_plant/ur/script/script_signatures.hpp"

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

/// Returns the joints of an argument that is a list, or finds those of a pose.
bool joints_of(const ScriptValue* value, const Machine& machine, Joints& q) {
  if (value == nullptr || !value->six()) return false;
  q = value->vector();
  if (value->kind == Kind::kList) return true;
  const Joints near = machine.motion.q();
  return inverse(Frame::of(value->vector()), machine.motion.tool(), near, q);
}

Frame frame_of(const ScriptValue& value, const Machine& machine) {
  if (value.kind == Kind::kPose) return Frame::of(value.vector());
  return forward(value.vector()) * machine.motion.tool();
}

CallOutcome move_j(const ScriptCall& call, Machine& machine) {
  Joints q;
  if (!joints_of(call.find("q", 0), machine, q)) return {CallResult::kNoReach};
  const bool good = machine.motion.move_j(q, call.number("a", 1, 0.0), call.number("v", 2, 0.0),
                                          call.number("t", 3, 0.0), call.number("r", 4, 0.0));
  return {good ? CallResult::kMotion : CallResult::kNoReach};
}

/// Runs movel(pose, a, v, t, r), movep(pose, a, v, r), movec(pose_via, pose_to, a, v, r, mode), and
/// servoc(pose, a, v, r) as a movep.
CallOutcome move_tool(const ScriptCall& call, Machine& machine) {
  Move move;
  move.kind = call.name == "movel"   ? Move::Kind::kL
              : call.name == "movec" ? Move::Kind::kC
                                     : Move::Kind::kP;
  const bool line = move.kind == Move::Kind::kL, arc = move.kind == Move::Kind::kC;
  const std::size_t first = arc ? 1 : 0;
  const ScriptValue* via = call.find("pose_via", 0);
  const ScriptValue* pose = call.find(arc ? "pose_to" : "pose", first);
  if (pose == nullptr || !pose->six() || (arc && (via == nullptr || !via->six())))
    return {CallResult::kNoReach};
  move.target = frame_of(*pose, machine);
  if (arc) move.via = frame_of(*via, machine);
  move.fixed = arc && call.number("mode", 5, 0.0) == 1.0;
  move.a = call.number("a", first + 1, 0.0);
  move.v = call.number("v", first + 2, 0.0);
  if (line) move.t = call.number("t", 3, 0.0);
  move.r = call.number("r", line ? 4 : first + 3, 0.0);
  if (machine.motion.move(move)) return {CallResult::kMotion};
  machine.protective_stop({Code::kSingularity, 0});
  return {CallResult::kHalt};
}

CallOutcome servo_j(const ScriptCall& call, Machine& machine) {
  const ScriptValue* q = call.find("q", 0);
  if (q == nullptr || !q->six()) return {};
  ServoLaw law;
  law.lookahead_s = call.number("lookahead_time", 4, law.lookahead_s);
  law.gain = call.number("gain", 5, law.gain);
  machine.motion.servo_j(q->vector(), call.number("t", 3, machine.cycle_s()), law);
  return {CallResult::kMotion};
}

/// speedj and speedl.
CallOutcome speed(const ScriptCall& call, Machine& machine) {
  const bool joints = call.name == "speedj";
  const ScriptValue* goal = call.find(joints ? "qd" : "xd", 0);
  if (goal == nullptr || !goal->six()) return {};
  const double a = call.number("a", 1, 0.0), t = call.number("t", 2, call.number("t_min", 2, 0.0));
  if (joints)
    machine.motion.speed_j(goal->vector(), a, t);
  else
    machine.motion.speed_l(goal->vector(), a, t);
  return {CallResult::kMotion};
}

CallOutcome stop(const ScriptCall& call, Machine& machine) {
  machine.motion.stop_j(call.number("a", 0, 0.0));
  return {CallResult::kMotion};
}

/// force_mode(task_frame, selection_vector, wrench, type, limits).
void start_force_mode(const ScriptCall& call, Machine& machine) {
  const ScriptValue* frame = call.find("task_frame", 0);
  const ScriptValue* selection = call.find("selection_vector", 1);
  const ScriptValue* wrench = call.find("wrench", 2);
  const ScriptValue* limits = call.find("limits", 4);
  for (const ScriptValue* value : {frame, selection, wrench, limits})
    if (value == nullptr || !value->six())
      return machine.messages.text("force_mode: six numbers are missing");
  ForceMode mode;
  mode.task_frame = frame->vector();
  mode.selection = selection->vector();
  mode.wrench = wrench->vector();
  mode.type = integer(call.number("type", 3, 2.0));
  mode.limits = limits->vector();
  machine.start_force_mode(mode);
}

/// rtde_set_watchdog(variable_name, min_frequency, action="pause").
void set_watchdog(const ScriptCall& call, Machine& machine) {
  const ScriptValue* name = call.find("variable_name", 0);
  const ScriptValue* word = call.find("action", 2);
  const bool named = name != nullptr && name->kind == Kind::kText;
  const InputField field = find_input(named ? name->text : "", machine.settings.version);
  if (field.type == FieldType::kNotFound)
    return machine.messages.text("rtde_set_watchdog: there is no such input");
  LateAction action = LateAction::kPause;
  if (word != nullptr && word->text == "stop") action = LateAction::kStop;
  if (word != nullptr && word->text == "ignore") action = LateAction::kIgnore;
  machine.watchdogs.set(field, call.number("min_frequency", 1, 0.0), action, machine.cycle);
}

void set_freedrive(const ScriptCall& call, Machine& machine) {
  machine.freedrive = !starts_with(call.name, "end_");
}

/// Appends a value as textmsg prints it.
void append(const ScriptValue& value, Text<511>& text) {
  if (value.kind == Kind::kText) text << value.text;
  if (value.kind == Kind::kNumber) text << value.number;
  if (value.kind == Kind::kBool) text << (value.number != 0.0 ? "True" : "False");
  if (value.kind != Kind::kList && value.kind != Kind::kPose) return;
  text << (value.kind == Kind::kPose ? "p[" : "[");
  for (std::size_t i = 0; i < value.count; ++i) text << (i > 0 ? ", " : "") << value.elements[i];
  text << "]";
}

void text_message(const ScriptCall& call, Machine& machine) {
  Text<511> text;
  for (std::size_t i = 0; i < call.count; ++i) append(call.arguments[i].value, text);
  machine.messages.text(text);
}

void write_register(const ScriptCall& call, Machine& machine) {
  const double index = call.number("address", 0, call.number("port_id", 0, -1.0)),
               value = call.number("value", 1, 0.0);
  const bool bits = call.name == "write_output_boolean_register";
  if (!(index >= 0.0 && index < (bits ? kBitRegisters : kRegisters))) return;
  const auto i = static_cast<std::size_t>(index);
  if (bits)
    machine.io.output.set_bit(static_cast<int>(i), value != 0.0);
  else if (call.name == "write_output_float_register")
    machine.io.output.doubles[i] = value;
  else
    machine.io.output.ints[i] = integer(value);
}

void set_payload(const ScriptCall& call, Machine& machine) {
  const ScriptValue* cog = call.find("cog", 1);
  const bool has_cog = cog != nullptr && cog->count == 3;
  machine.set_payload(call.number("m", 0, 0.0),
                      has_cog ? Vector3(cog->elements.data()) : machine.payload_cog);
}

void set_tcp(const ScriptCall& call, Machine& machine) {
  const ScriptValue* pose = call.find("pose", 0);
  if (pose != nullptr && pose->six()) machine.set_tcp(pose->vector());
}

void set_digital(const ScriptCall& call, Machine& machine) {
  const int bit = digital_bit(call);
  if (bit >= 0) machine.io.set_digital(bit, call.number("b", 1, 0.0) != 0.0);
}

void set_analog(const ScriptCall& call, Machine& machine) {
  const double n = call.number("n", 0, -1.0);
  if (n == 0.0 || n == 1.0) machine.io.set_analog(static_cast<int>(n), call.number("f", 1, 0.0));
}

std::string_view socket_name(const ScriptCall& call, std::size_t position) {
  const ScriptValue* name = call.find("socket_name", position);
  return name != nullptr && name->kind == Kind::kText ? name->text : "socket_0";
}

void use_socket(const ScriptCall& call, Machine& machine) {
  const bool opens = call.name == "socket_open";
  const std::size_t position = opens ? 2 : call.name == "socket_close" ? 0 : 1;
  Link* link = machine.links.find(socket_name(call, position));
  if (link == nullptr) return;
  const ScriptValue* first = call.find("", 0);
  if (opens && first != nullptr && first->kind == Kind::kText)
    link->want(socket_name(call, 2), first->text, integer(call.number("port", 1, 0.0)));
  if (call.name == "socket_close") link->close();
  if (call.name == "socket_send_int" && first != nullptr) link->send_int(integer(first->number));
  const bool line = call.name == "socket_send_line";
  if ((line || call.name == "socket_send_string") && first != nullptr) link->send_text(first->text);
  if (line) link->send_text("\n");
}

CallOutcome halt(const ScriptCall&, Machine&) {
  return {CallResult::kHalt};
}
/// sleep(t), and sync() for a cycle.
CallOutcome wait(const ScriptCall& call, Machine& machine) {
  return {CallResult::kWait, call.number("t", 0, machine.cycle_s())};
}
CallOutcome stop_protectively(const ScriptCall&, Machine& machine) {
  machine.protective_stop({Code::kFromScript, 0});
  return {CallResult::kHalt};
}

void show_popup(const ScriptCall& call, Machine& machine) {
  if (call.count > 0) machine.messages.popup("Message", call.arguments[0].value.text, false, false);
}

using Call = const ScriptCall&;
using On = Machine&;

constexpr LineCall kCalls[] = {
    {{"end_force_mode", "", 0}, [](Call, On m) { m.force_mode = {}; }},
    {{"end_freedrive_mode", "", 0}, set_freedrive},
    {{"end_teach_mode", "", 0}, set_freedrive},
    {{"force_mode", "6task_frame 6selection_vector 6wrench 1type 6limits", 5}, start_force_mode},
    {{"force_mode_set_damping", "1damping", 1},
     [](Call call, On m) { m.force_damping = call.number("damping", 0, kForceDamping); }},
    {{"freedrive_mode", "", 0}, set_freedrive},
    {{"halt", "", 0}, nullptr, halt},
    {{"movec", "6pose_via 6pose_to 1a 1v 1r 1mode", 2}, nullptr, move_tool, true},
    {{"movej", "6q 1a 1v 1t 1r", 1}, nullptr, move_j, true},
    {{"movel", "6pose 1a 1v 1t 1r", 1}, nullptr, move_tool, true},
    {{"movep", "6pose 1a 1v 1r", 1}, nullptr, move_tool, true},
    {{"popup", "*s *title *warning *error *blocking", 1}, show_popup},
    {{"powerdown", "", 0}, nullptr, halt},
    {{"protective_stop", "", 0}, nullptr, stop_protectively},
    {{"rtde_set_watchdog", "svariable_name 1min_frequency saction", 2}, set_watchdog},
    {{"servoc", "6pose 1a 1v 1r", 1}, nullptr, move_tool, true},
    {{"servoj", "6q 1a 1v 1t 1lookahead_time 1gain", 1}, nullptr, servo_j, true},
    {{"set_analog_out", "1n 1f", 2}, set_analog},
    {{"set_configurable_digital_out", "1n 1b", 2}, set_digital},
    {{"set_digital_out", "1n 1b", 2}, set_digital},
    {{"set_payload", "1m 3cog", 1}, set_payload},
    {{"set_standard_analog_out", "1n 1f", 2}, set_analog},
    {{"set_standard_digital_out", "1n 1b", 2}, set_digital},
    {{"set_target_payload", "1m 3cog 6inertia 1transition_time", 1}, set_payload},
    {{"set_tcp", "6pose", 1}, set_tcp},
    {{"set_tool_digital_out", "1n 1b", 2}, set_digital},
    {{"set_tool_voltage", "1voltage", 1},
     [](Call call, On m) { m.io.tool_voltage = integer(call.number("voltage", 0, 0.0)); }},
    {{"sleep", "1t", 1}, nullptr, wait},
    {{"socket_close", "ssocket_name", 0}, use_socket},
    {{"socket_open", "s 1port ssocket_name", 2}, use_socket},
    {{"socket_send_int", "1 ssocket_name", 1}, use_socket},
    {{"socket_send_line", "s ssocket_name", 1}, use_socket},
    {{"socket_send_string", "s ssocket_name", 1}, use_socket},
    {{"speedj", "6qd 1a 1t/t_min", 1}, nullptr, speed, true},
    {{"speedl", "6xd 1a 1t/t_min *aRot", 1}, nullptr, speed, true},
    {{"stopj", "1a", 1}, nullptr, stop, true},
    {{"stopl", "1a *aRot", 1}, nullptr, stop, true},
    {{"sync", "", 0}, nullptr, wait},
    {{"teach_mode", "", 0}, set_freedrive},
    {{"textmsg", "* *", 1}, text_message},
    {{"write_output_boolean_register", "1address/port_id 1value", 2}, write_register},
    {{"write_output_float_register", "1address/port_id 1value", 2}, write_register},
    {{"write_output_integer_register", "1address/port_id 1value", 2}, write_register},
    {{"zero_ftsensor", "", 0}, [](Call, On m) { m.zero_force(); }},
    // Settings that the emulated arm has no use for.
    {{"position_deviation_warning", kAnything}},
    {{"reset_revolution_counter", kAnything}},
    {{"set_analog_inputrange", kAnything}},
    {{"set_analog_outputdomain", kAnything}},
    {{"set_input_actions_to_default", kAnything}},
    {{"set_runstate_standard_analog_output_to_value", kAnything}},
    {{"set_safety_mode_transition_hardness", kAnything}},
    {{"set_standard_analog_input_domain", kAnything}},
    {{"set_tool_analog_input_domain", kAnything}},
    {{"set_tool_communication", kAnything}},
};

}  // namespace

const LineCall* find_call(std::string_view name) {
  return find_row(kCalls, name);
}

bool is_motion(std::string_view name) {
  const LineCall* known = find_call(name);
  return known != nullptr && known->moves;
}

CallOutcome run_call(const ScriptCall& call, bool moves, Machine& machine) {
  const LineCall* known = find_call(call.name);
  if (known == nullptr || (known->moves && !moves)) return {};
  const std::string_view why = known->moves ? range_fault(call, known->signature) : "";
  if (!why.empty()) return {CallResult::kOutOfRange, 0.0, why};
  if (known->run != nullptr) return known->run(call, machine);
  if (known->act != nullptr) known->act(call, machine);
  return {};
}

}  // namespace tactus::ur
