#include "sim_plant/ur/script/script_operators.hpp"

#include <cmath>

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

bool equal(const ScriptValue& a, const ScriptValue& b) {
  if (a.numeric() && b.numeric()) return a.number == b.number;
  if (a.kind != b.kind || a.count != b.count) return false;
  if (a.kind == Kind::kText) return a.text == b.text;
  return a.elements == b.elements;
}

}  // namespace

ScriptValue truth_value(bool value) {
  ScriptValue result;
  result.kind = Kind::kBool;
  result.number = value ? 1.0 : 0.0;
  return result;
}

ScriptValue number_value(double value) {
  ScriptValue result;
  result.kind = Kind::kNumber;
  result.number = value;
  return result;
}

bool apply_operator(std::string_view word, const ScriptValue& right, ScriptValue& left) {
  if (word == "==" || word == "!=") {
    left = truth_value(equal(left, right) == (word == "=="));
    return true;
  }
  if (!left.numeric() || !right.numeric()) return false;
  const double a = left.number, b = right.number;
  if (word == "or")
    left = truth_value(a != 0.0 || b != 0.0);
  else if (word == "and")
    left = truth_value(a != 0.0 && b != 0.0);
  else if (word == "<=")
    left = truth_value(a <= b);
  else if (word == ">=")
    left = truth_value(a >= b);
  else if (word == "<")
    left = truth_value(a < b);
  else if (word == ">")
    left = truth_value(a > b);
  else if (word == "+")
    left = number_value(a + b);
  else if (word == "-")
    left = number_value(a - b);
  else if (word == "*")
    left = number_value(a * b);
  else if (word == "/")
    left = number_value(a / b);
  else
    left = number_value(std::fmod(a, b));
  return true;
}

}  // namespace tactus::ur
