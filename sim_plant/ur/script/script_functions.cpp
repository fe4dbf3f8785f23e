#include "sim_plant/ur/script/script_calls.hpp"

#include <cmath>

#include "sim_plant/ur/motion/kinematics.hpp"
#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

ScriptValue six_value(Kind kind, const Vector6& six) {
  ScriptValue value;
  value.kind = kind;
  for (const double element : six) value.elements[value.count++] = element;
  return value;
}

bool of_registers(const ScriptCall& call, const Machine& machine, ScriptValue& value) {
  const bool input = starts_with(call.name, "read_input_");
  if (!input && !starts_with(call.name, "read_output_")) return false;
  const Registers& registers = input ? machine.io.input : machine.io.output;
  const std::string_view kind = call.name.substr(input ? 11 : 12);
  const double index = call.number("address", 0, -1.0);
  if (!(index >= 0.0 && index < (kind == "boolean_register" ? kBitRegisters : kRegisters)))
    return false;
  const auto i = static_cast<std::size_t>(index);
  if (kind == "boolean_register")
    value = ScriptValue::of(registers.bit(static_cast<int>(i)));
  else if (kind == "integer_register")
    value = ScriptValue::of(static_cast<double>(registers.ints[i]));
  else if (kind == "float_register")
    value = ScriptValue::of(registers.doubles[i]);
  else
    return false;
  return true;
}

bool of_arm(const ScriptCall& call, const Machine& machine, ScriptValue& value) {
  const Motion& motion = machine.motion;
  const std::string_view name = call.name;
  if (name == "get_actual_joint_positions")
    value = six_value(Kind::kList, machine.measured_q());
  else if (name == "get_actual_joint_speeds")
    value = six_value(Kind::kList, machine.measured_dq());
  else if (name == "get_target_joint_positions")
    value = six_value(Kind::kList, motion.q());
  else if (name == "get_target_joint_speeds")
    value = six_value(Kind::kList, motion.dq());
  else if (name == "get_actual_tcp_pose")
    value = six_value(Kind::kPose, (forward(machine.measured_q()) * motion.tool()).pose());
  else if (name == "get_target_tcp_pose")
    value = six_value(Kind::kPose, (forward(motion.q()) * motion.tool()).pose());
  else if (name == "get_tcp_force")
    value = six_value(Kind::kPose, machine.measured_wrench());
  else if (name == "force")
    value = ScriptValue::of(machine.measured_wrench().head<3>().norm());
  else if (name == "get_tcp_offset")
    value = six_value(Kind::kPose, machine.tcp_offset);
  else if (name == "get_target_payload")
    value = ScriptValue::of(machine.payload);
  else if (name == "get_steptime")
    value = ScriptValue::of(machine.cycle_s());
  else if (name == "is_steady")
    value = ScriptValue::of(motion.resting());
  else
    return false;
  return true;
}

bool of_poses(const ScriptCall& call, const Machine& machine, ScriptValue& value) {
  const ScriptValue* first = call.find("", 0);
  const ScriptValue* second = call.find("qnear", 1);
  if (first == nullptr || !first->six()) return false;
  const Frame& tool = machine.motion.tool();
  if (call.name == "get_inverse_kin" || call.name == "get_inverse_kin_has_solution") {
    const bool near = second != nullptr && second->six();
    Joints q = Joints::Zero();
    const bool found =
        inverse(Frame::of(first->vector()), tool, near ? second->vector() : machine.motion.q(), q);
    const bool asked = call.name != "get_inverse_kin";
    value = asked ? ScriptValue::of(found) : six_value(Kind::kList, q);
    return found || asked;
  }
  Frame frame;
  if (call.name == "get_forward_kin") {
    frame = forward(first->vector()) * tool;
  } else if (call.name == "pose_inv") {
    frame = Frame::of(first->vector()).inverse();
  } else if (call.name == "pose_trans" && second != nullptr && second->six()) {
    frame = Frame::of(first->vector()) * Frame::of(second->vector());
  } else {
    return false;
  }
  value = six_value(Kind::kPose, frame.pose());
  return true;
}

/// Returns the length of a list or the magnitude of a number.
double norm(const ScriptValue& value) {
  if (value.numeric()) return std::abs(value.number);
  double sum = 0.0;
  for (std::size_t i = 0; i < value.count; ++i) sum += value.elements[i] * value.elements[i];
  return std::sqrt(sum);
}

bool of_numbers(const ScriptCall& call, ScriptValue& value) {
  const ScriptValue* first = call.find("", 0);
  if (first == nullptr) return false;
  if (call.name == "norm") {
    value = ScriptValue::of(norm(*first));
    return true;
  }
  struct Row {
    std::string_view name;
    double (*function)(double, double);
  };
  constexpr Row kRows[] = {{"d2r", [](double x, double) { return x * kDegree; }},
                           {"r2d", [](double x, double) { return x / kDegree; }},
                           {"sqrt", [](double x, double) { return std::sqrt(x); }},
                           {"sin", [](double x, double) { return std::sin(x); }},
                           {"cos", [](double x, double) { return std::cos(x); }},
                           {"tan", [](double x, double) { return std::tan(x); }},
                           {"floor", [](double x, double) { return std::floor(x); }},
                           {"ceil", [](double x, double) { return std::ceil(x); }},
                           {"atan2", [](double x, double y) { return std::atan2(x, y); }},
                           {"pow", [](double x, double y) { return std::pow(x, y); }}};
  for (const Row& row : kRows) {
    if (row.name != call.name || !first->numeric()) continue;
    value = ScriptValue::of(row.function(first->number, call.number("", 1, 0.0)));
    return true;
  }
  return false;
}

bool of_digital(const ScriptCall& call, const Machine& machine, ScriptValue& value) {
  const int bit = digital_bit(call);
  if (bit < 0) return false;
  const bool input = call.name.substr(call.name.size() - 3) == "_in";
  const std::uint64_t bits = input ? machine.io.digital_inputs : machine.io.digital_outputs;
  value = ScriptValue::of((bits >> bit & 1u) != 0);
  return true;
}

}  // namespace

int digital_bit(const ScriptCall& call) {
  struct Row {
    std::string_view kind;
    int from, first, count;  // first number in the script, first bit, number of bits
  };
  constexpr Row kRows[] = {{"et_digital_", 0, 0, 8},  // before version 3 the tool's follow
                           {"et_digital_", 8, 16, 2},
                           {"et_standard_digital_", 0, 0, 8},
                           {"et_configurable_digital_", 0, 8, 8},
                           {"et_tool_digital_", 0, 16, 2}};
  const double n = call.number("n", 0, -1.0);
  for (const Row& row : kRows)
    if (starts_with(call.name.substr(1), row.kind) && n >= row.from && n < row.from + row.count)
      return row.first + static_cast<int>(n) - row.from;
  return -1;
}

bool call_function(const ScriptCall& call, const Machine& machine, ScriptValue& value) {
  return of_registers(call, machine, value) || of_arm(call, machine, value) ||
         of_digital(call, machine, value) || of_poses(call, machine, value) ||
         of_numbers(call, value);
}

}  // namespace tactus::ur
