// The functions of URScript that have a value. Parameters as in the script manual of version 3.15.
#include "sim_plant/ur/script/script_calls.hpp"

#include <cmath>

#include "sim_plant/ur/motion/kinematics.hpp"
#include "sim_plant/ur/script/script_signatures.hpp"

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

using Call = const ScriptCall&;
using Of = const Machine&;

ScriptValue six_value(Kind kind, const Vector6& six) {
  ScriptValue value;
  value.kind = kind;
  for (const double element : six) value.elements[value.count++] = element;
  return value;
}
ScriptValue list(const Vector6& six) {
  return six_value(Kind::kList, six);
}
ScriptValue pose(const Vector6& six) {
  return six_value(Kind::kPose, six);
}
ScriptValue tip(const Joints& q, Of machine) {
  return pose((forward(q) * machine.motion.tool()).pose());
}

ScriptValue of_registers(Call call, Of machine) {
  const bool input = starts_with(call.name, "read_input_");
  const Registers& registers = input ? machine.io.input : machine.io.output;
  const std::string_view kind = call.name.substr(input ? 11 : 12);
  const bool bits = kind == "boolean_register";
  const double index = call.number("address", 0, -1.0);
  if (!(index >= 0.0 && index < (bits ? kBitRegisters : kRegisters))) return {};
  const auto i = static_cast<std::size_t>(index);
  if (bits) return ScriptValue::of(registers.bit(static_cast<int>(i)));
  return ScriptValue::of(kind == "float_register" ? registers.doubles[i]
                                                  : static_cast<double>(registers.ints[i]));
}

ScriptValue of_digital(Call call, Of machine) {
  const int bit = digital_bit(call);
  if (bit < 0) return {};
  const bool input = call.name.substr(call.name.size() - 3) == "_in";
  const std::uint64_t bits = input ? machine.io.digital_inputs : machine.io.digital_outputs;
  return ScriptValue::of((bits >> bit & 1u) != 0);
}

/// Finds the argument at this place that is a list of six or a pose; null: there is none.
const ScriptValue* six_at(Call call, std::string_view name, std::size_t position) {
  const ScriptValue* value = call.find(name, position);
  return value != nullptr && value->six() ? value : nullptr;
}

/// get_inverse_kin and get_inverse_kin_has_solution.
ScriptValue inverse_kin(Call call, Of machine) {
  const ScriptValue* goal = six_at(call, "", 0);
  const ScriptValue* near = six_at(call, "qnear", 1);
  if (goal == nullptr) return {};
  Joints q = Joints::Zero();
  const bool found = inverse(Frame::of(goal->vector()), machine.motion.tool(),
                             near != nullptr ? near->vector() : machine.motion.q(), q);
  if (call.name != "get_inverse_kin") return ScriptValue::of(found);
  return found ? list(q) : ScriptValue();
}

ScriptValue forward_kin(Call call, Of machine) {
  const ScriptValue* q = six_at(call, "", 0);
  return q != nullptr ? tip(q->vector(), machine) : ScriptValue();
}

ScriptValue pose_inv(Call call, Of) {
  const ScriptValue* of = six_at(call, "", 0);
  return of != nullptr ? pose(Frame::of(of->vector()).inverse().pose()) : ScriptValue();
}

ScriptValue pose_trans(Call call, Of) {
  const ScriptValue *a = six_at(call, "", 0), *b = six_at(call, "", 1);
  if (a == nullptr || b == nullptr) return {};
  return pose((Frame::of(a->vector()) * Frame::of(b->vector())).pose());
}

/// Returns the length of a list or the magnitude of a number.
ScriptValue norm(Call call, Of) {
  const ScriptValue* of = call.find("", 0);
  if (of == nullptr) return {};
  if (of->numeric()) return ScriptValue::of(std::abs(of->number));
  double sum = 0.0;
  for (std::size_t i = 0; i < of->count; ++i) sum += of->elements[i] * of->elements[i];
  return ScriptValue::of(std::sqrt(sum));
}

template <double (*function)(double)>
ScriptValue of_one(Call call, Of) {
  const ScriptValue* x = call.find("", 0);
  return x != nullptr && x->numeric() ? ScriptValue::of(function(x->number)) : ScriptValue();
}
template <double (*function)(double, double)>
ScriptValue of_two(Call call, Of) {
  const ScriptValue* x = call.find("", 0);
  if (x == nullptr || !x->numeric()) return {};
  return ScriptValue::of(function(x->number, call.number("", 1, 0.0)));
}
double radians(double degrees) {
  return degrees * kDegree;
}
double degrees(double radians) {
  return radians / kDegree;
}

constexpr ValueCall kFunctions[] = {
    {{"atan2", "1 1", 2}, of_two<std::atan2>},
    {{"ceil", "1", 1}, of_one<std::ceil>},
    {{"cos", "1", 1}, of_one<std::cos>},
    {{"d2r", "1", 1}, of_one<radians>},
    {{"floor", "1", 1}, of_one<std::floor>},
    {{"force", "", 0},
     [](Call, Of m) { return ScriptValue::of(m.measured_wrench().head<3>().norm()); }},
    {{"get_actual_joint_positions", "", 0}, [](Call, Of m) { return list(m.measured_q()); }},
    {{"get_actual_joint_speeds", "", 0}, [](Call, Of m) { return list(m.measured_dq()); }},
    {{"get_actual_tcp_pose", "", 0}, [](Call, Of m) { return tip(m.measured_q(), m); }},
    {{"get_configurable_digital_in", "1n", 1}, of_digital},
    {{"get_configurable_digital_out", "1n", 1}, of_digital},
    {{"get_digital_in", "1n", 1}, of_digital},
    {{"get_digital_out", "1n", 1}, of_digital},
    {{"get_forward_kin", "6", 1}, forward_kin},
    {{"get_inverse_kin", "6 6qnear 1 1", 1}, inverse_kin},
    {{"get_inverse_kin_has_solution", "6 6qnear 1 1", 1}, inverse_kin},
    {{"get_standard_digital_in", "1n", 1}, of_digital},
    {{"get_standard_digital_out", "1n", 1}, of_digital},
    {{"get_steptime", "", 0}, [](Call, Of m) { return ScriptValue::of(m.cycle_s()); }},
    {{"get_target_joint_positions", "", 0}, [](Call, Of m) { return list(m.motion.q()); }},
    {{"get_target_joint_speeds", "", 0}, [](Call, Of m) { return list(m.motion.dq()); }},
    {{"get_target_payload", "", 0}, [](Call, Of m) { return ScriptValue::of(m.payload); }},
    {{"get_target_tcp_pose", "", 0}, [](Call, Of m) { return tip(m.motion.q(), m); }},
    {{"get_tcp_force", "", 0}, [](Call, Of m) { return pose(m.measured_wrench()); }},
    {{"get_tcp_offset", "", 0}, [](Call, Of m) { return pose(m.tcp_offset); }},
    {{"get_tool_digital_in", "1n", 1}, of_digital},
    {{"get_tool_digital_out", "1n", 1}, of_digital},
    {{"is_steady", "", 0}, [](Call, Of m) { return ScriptValue::of(m.motion.resting()); }},
    {{"norm", "*", 1}, norm},
    {{"pose_inv", "6", 1}, pose_inv},
    {{"pose_trans", "6 6", 2}, pose_trans},
    {{"pow", "1 1", 2}, of_two<std::pow>},
    {{"r2d", "1", 1}, of_one<degrees>},
    {{"read_input_boolean_register", "1address", 1}, of_registers},
    {{"read_input_float_register", "1address", 1}, of_registers},
    {{"read_input_integer_register", "1address", 1}, of_registers},
    {{"read_output_boolean_register", "1address", 1}, of_registers},
    {{"read_output_float_register", "1address", 1}, of_registers},
    {{"read_output_integer_register", "1address", 1}, of_registers},
    {{"sin", "1", 1}, of_one<std::sin>},
    {{"sqrt", "1", 1}, of_one<std::sqrt>},
    {{"tan", "1", 1}, of_one<std::tan>},
};

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

const ValueCall* find_function(std::string_view name) {
  return find_row(kFunctions, name);
}

}  // namespace tactus::ur
