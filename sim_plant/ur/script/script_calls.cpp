#include "sim_plant/ur/script/script_calls.hpp"

#include <algorithm>
#include <cstdio>

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

CallResult move_j(const ScriptCall& call, Machine& machine) {
  Joints q;
  if (!joints_of(call.find("q", 0), machine, q)) return CallResult::kNoReach;
  const bool good = machine.motion.move_j(q, call.number("a", 1, 0.0), call.number("v", 2, 0.0),
                                          call.number("t", 3, 0.0), call.number("r", 4, 0.0));
  return good ? CallResult::kMotion : CallResult::kNoReach;
}

/// Runs movel(pose, a, v, t, r), movep(pose, a, v, r), movec(pose_via, pose_to, a, v, r, mode), and
/// servoc(pose, a, v, r) as a movep.
CallResult move_tool(const ScriptCall& call, Machine& machine) {
  Move move;
  move.kind = call.name == "movel"   ? Move::Kind::kL
              : call.name == "movec" ? Move::Kind::kC
                                     : Move::Kind::kP;
  const bool line = move.kind == Move::Kind::kL, arc = move.kind == Move::Kind::kC;
  const std::size_t first = arc ? 1 : 0;
  const ScriptValue* via = call.find("pose_via", 0);
  const ScriptValue* pose = call.find(arc ? "pose_to" : "pose", first);
  if (pose == nullptr || !pose->six() || (arc && (via == nullptr || !via->six())))
    return CallResult::kNoReach;
  move.target = frame_of(*pose, machine);
  if (arc) move.via = frame_of(*via, machine);
  move.fixed = arc && call.number("mode", 5, 0.0) == 1.0;
  move.a = call.number("a", first + 1, 0.0);
  move.v = call.number("v", first + 2, 0.0);
  if (line) move.t = call.number("t", 3, 0.0);
  move.r = call.number("r", line ? 4 : first + 3, 0.0);
  if (machine.motion.move(move)) return CallResult::kMotion;
  machine.protective_stop({Code::kSingularity, 0});
  return CallResult::kHalt;
}

CallResult servo_j(const ScriptCall& call, Machine& machine) {
  const ScriptValue* q = call.find("q", 0);
  if (q == nullptr || !q->six()) return CallResult::kDone;
  ServoLaw law;
  law.lookahead_s = call.number("lookahead_time", 4, law.lookahead_s);
  law.gain = call.number("gain", 5, law.gain);
  machine.motion.servo_j(q->vector(), call.number("t", 3, machine.cycle_s()), law);
  return CallResult::kMotion;
}

CallResult speed(const ScriptCall& call, bool joints, Machine& machine) {
  const ScriptValue* goal = call.find(joints ? "qd" : "xd", 0);
  if (goal == nullptr || !goal->six()) return CallResult::kDone;
  const double a = call.number("a", 1, 0.0), t = call.number("t", 2, call.number("t_min", 2, 0.0));
  if (joints)
    machine.motion.speed_j(goal->vector(), a, t);
  else
    machine.motion.speed_l(goal->vector(), a, t);
  return CallResult::kMotion;
}

CallResult run_motion(const ScriptCall& call, Machine& machine) {
  if (call.name == "movej") return move_j(call, machine);
  if (call.name == "servoj") return servo_j(call, machine);
  if (call.name == "speedj") return speed(call, true, machine);
  if (call.name == "speedl") return speed(call, false, machine);
  if (!starts_with(call.name, "stop")) return move_tool(call, machine);
  machine.motion.stop_j(call.number("a", 0, 0.0));
  return CallResult::kMotion;
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

/// Runs a call for force mode, freedrive or the watchdogs of inputs. False: the call is none of
/// them.
bool run_mode_call(const ScriptCall& call, Machine& machine) {
  const std::string_view name = call.name;
  if (name == "force_mode") {
    start_force_mode(call, machine);
  } else if (name == "end_force_mode") {
    machine.force_mode = {};
  } else if (name == "force_mode_set_damping") {
    machine.force_damping = call.number("damping", 0, kForceDamping);
  } else if (name == "freedrive_mode" || name == "teach_mode") {
    machine.freedrive = true;
  } else if (name == "end_freedrive_mode" || name == "end_teach_mode") {
    machine.freedrive = false;
  } else if (name == "rtde_set_watchdog") {
    set_watchdog(call, machine);
  } else {
    return false;
  }
  return true;
}

/// Appends a value as textmsg prints it.
void append(const ScriptValue& value, char* text, std::size_t capacity, std::size_t& size) {
  const auto add = [&](const char* format, auto... args) {
    const int more = std::snprintf(text + size, capacity - size, format, args...);
    if (more > 0) size = std::min(capacity - 1, size + static_cast<std::size_t>(more));
  };
  if (value.kind == Kind::kText)
    add("%.*s", static_cast<int>(value.text.size()), value.text.data());
  if (value.kind == Kind::kNumber) add("%.6g", value.number);
  if (value.kind == Kind::kBool) add("%s", value.number != 0.0 ? "True" : "False");
  if (value.kind != Kind::kList && value.kind != Kind::kPose) return;
  add("%s", value.kind == Kind::kPose ? "p[" : "[");
  for (std::size_t i = 0; i < value.count; ++i) add(i > 0 ? ", %.6g" : "%.6g", value.elements[i]);
  add("]");
}

void text_message(const ScriptCall& call, Machine& machine) {
  std::array<char, 512> text{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < call.count; ++i)
    append(call.arguments[i].value, text.data(), text.size(), size);
  machine.messages.text({text.data(), size});
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

}  // namespace

bool is_motion(std::string_view name) {
  constexpr std::string_view kNames[] = {"movej",  "movel",  "movep",  "movec", "servoj",
                                         "servoc", "speedj", "speedl", "stopj", "stopl"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

CallOutcome run_call(const ScriptCall& call, bool moves, Machine& machine) {
  const std::string_view name = call.name;
  if (is_motion(name) && moves) {
    const std::string_view why = range_fault(call);
    if (!why.empty()) return {CallResult::kOutOfRange, 0.0, why};
    return {run_motion(call, machine)};
  }
  if (is_motion(name)) return {};
  if (run_mode_call(call, machine)) return {};
  if (name == "sleep") return {CallResult::kWait, call.number("t", 0, 0.0)};
  if (name == "sync") return {CallResult::kWait, machine.cycle_s()};
  if (name == "halt" || name == "powerdown") return {CallResult::kHalt};
  if (name == "textmsg") text_message(call, machine);
  if (name == "protective_stop") {
    machine.protective_stop({Code::kFromScript, 0});
    return {CallResult::kHalt};
  }
  if (starts_with(name, "write_output_")) write_register(call, machine);
  if (const int bit = digital_bit(call); bit >= 0)
    machine.io.set_digital(bit, call.number("b", 1, 0.0) != 0.0);
  if (name == "set_standard_analog_out" || name == "set_analog_out") {
    const double n = call.number("n", 0, -1.0);
    if (n == 0.0 || n == 1.0) machine.io.set_analog(static_cast<int>(n), call.number("f", 1, 0.0));
  }
  if (name == "set_tool_voltage") machine.io.tool_voltage = integer(call.number("voltage", 0, 0.0));
  if (name == "set_payload" || name == "set_target_payload") set_payload(call, machine);
  const ScriptValue* pose = call.find("pose", 0);
  if (name == "set_tcp" && pose != nullptr && pose->six()) machine.set_tcp(pose->vector());
  if (name == "zero_ftsensor") machine.zero_force();
  if (name == "popup" && call.count > 0)
    machine.messages.popup("Message", call.arguments[0].value.text, false, false);
  if (starts_with(name, "socket_")) use_socket(call, machine);
  return {};
}

}  // namespace tactus::ur
