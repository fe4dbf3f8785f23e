#include "sim_plant/ur/script/script_calls.hpp"

#include <algorithm>
#include <cstdio>

#include "sim_plant/ur/script/script_motion.hpp"
#include "sim_plant/ur/script/script_signatures.hpp"

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

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

void set_output(const ScriptCall& call, Machine& machine) {
  const double n = call.number("n", 0, -1.0);
  const bool on = call.number("b", 1, 0.0) != 0.0;
  struct Row {
    std::string_view name;
    int from, first, count;  // first number in the script, first bit, number of bits
  };
  constexpr Row kRows[] = {
      {"set_digital_out", 0, 0, 8},  // before version 3 the tool's follow the standard ones
      {"set_digital_out", 8, 16, 2},
      {"set_standard_digital_out", 0, 0, 8},
      {"set_configurable_digital_out", 0, 8, 8},
      {"set_tool_digital_out", 0, 16, 2}};
  for (const Row& row : kRows)
    if (row.name == call.name && n >= row.from && n < row.from + row.count)
      machine.io.set_digital(row.first + static_cast<int>(n) - row.from, on);
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
  if (starts_with(name, "set_") && name.find("digital_out") != std::string_view::npos)
    set_output(call, machine);
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
