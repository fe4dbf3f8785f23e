#include "sim_plant/ur/script/script_expression.hpp"

#include <algorithm>
#include <cmath>

#include "sim_plant/ur/script/script_calls.hpp"
#include "sim_plant/ur/script/script_signatures.hpp"

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

constexpr int kDeepest = 16;  // nesting of brackets and nots
constexpr std::string_view kTooDeep = "limit of 16 nested values";

bool equal(const ScriptValue& a, const ScriptValue& b) {
  if (a.numeric() && b.numeric()) return a.number == b.number;
  if (a.kind != b.kind || a.count != b.count) return false;
  if (a.kind == Kind::kText) return a.text == b.text;
  return a.elements == b.elements;
}

/// If two begin alike, the longer one comes first. Those of level 2 bind more tightly than those of
/// level 1.
struct Operator {
  int level;
  std::string_view word;
  ScriptValue (*apply)(double a, double b);  ///< null: of values of any kind
};
constexpr Operator kOperators[] = {
    {0, "or", [](double a, double b) { return ScriptValue::of(a != 0.0 || b != 0.0); }},
    {1, "and", [](double a, double b) { return ScriptValue::of(a != 0.0 && b != 0.0); }},
    {2, "==", nullptr},
    {2, "!=", nullptr},
    {2, "<=", [](double a, double b) { return ScriptValue::of(a <= b); }},
    {2, ">=", [](double a, double b) { return ScriptValue::of(a >= b); }},
    {2, "<", [](double a, double b) { return ScriptValue::of(a < b); }},
    {2, ">", [](double a, double b) { return ScriptValue::of(a > b); }},
    {3, "+", [](double a, double b) { return ScriptValue::of(a + b); }},
    {3, "-", [](double a, double b) { return ScriptValue::of(a - b); }},
    {4, "*", [](double a, double b) { return ScriptValue::of(a * b); }},
    {4, "/", [](double a, double b) { return ScriptValue::of(a / b); }},
    {4, "%", [](double a, double b) { return ScriptValue::of(std::fmod(a, b)); }}};
constexpr int kLevels = 5;

/// Computes left = left `op` right. False: these values have no such operator.
bool apply_operator(const Operator& op, const ScriptValue& right, ScriptValue& left) {
  if (op.apply == nullptr) {
    left = ScriptValue::of(equal(left, right) == (op.word == "=="));
    return true;
  }
  if (!left.numeric() || !right.numeric()) return false;
  left = op.apply(left.number, right.number);
  return true;
}

/// Takes one expression or call off a text, by recursive descent of bounded depth.
class ScriptReader {
 public:
  ScriptReader(std::string_view text, const ScriptScope& scope) : text_(text), scope_(scope) {}

  bool read(ScriptValue& value) { return level(0, value); }
  bool read(ScriptCall& call);
  std::string_view rest() const { return text_; }

 private:
  bool level(int at, ScriptValue& value);
  bool signed_value(ScriptValue& value);
  bool with_element(ScriptValue& value);
  bool primary(ScriptValue& value);
  bool name(ScriptValue& value);
  bool quoted(ScriptValue& value);
  bool elements(ScriptValue::Kind kind, ScriptValue& value);
  bool argument(ScriptCall::Argument& argument);
  const Operator* operator_of(int level);
  bool eat(std::string_view word);
  /// True for a value whose kind is only known when the program runs.
  bool open(const ScriptValue& value) const {
    return scope_.reads_only() && value.kind == ScriptValue::Kind::kNothing;
  }
  bool fail(std::string_view reason) const {
    if (scope_.reason != nullptr) *scope_.reason = reason;
    return false;
  }
  void work(int amount) const {
    if (scope_.work != nullptr) *scope_.work += amount;
  }
  bool finite(ScriptValue& value) const;
  bool call(std::string_view word, ScriptValue& value);
  bool numeric(const ScriptValue& value) const { return value.numeric() || open(value); }

  std::string_view text_;
  const ScriptScope& scope_;
  int depth_ = 0;
};

/// Takes a word off the text, unless it is the beginning of a longer one.
bool ScriptReader::eat(std::string_view word) {
  skip_blanks(text_);
  if (!starts_with(text_, word)) return false;
  const std::string_view begun = leading_name(text_);
  if (!begun.empty() && begun != word) return false;
  text_.remove_prefix(word.size());
  return true;
}

const Operator* ScriptReader::operator_of(int level) {
  for (const Operator& op : kOperators)
    if (op.level == level && eat(op.word)) return &op;
  return nullptr;
}

bool ScriptReader::level(int at, ScriptValue& value) {
  if (at == kLevels) return signed_value(value);
  if (!level(at + 1, value)) return false;
  for (const Operator* op = operator_of(at); op != nullptr; op = operator_of(at)) {
    ScriptValue right;
    if (!level(at + 1, right)) return false;
    if (open(value) || open(right))
      value = {};
    else if (!apply_operator(*op, right, value) || !finite(value))
      return false;
  }
  return true;
}

/// True for a finite value; what is only read is known when the program runs.
bool ScriptReader::finite(ScriptValue& value) const {
  const double* const first = value.elements.data();
  if (std::isfinite(value.number) &&
      std::all_of(first, first + value.count, [](double x) { return std::isfinite(x); }))
    return true;
  if (!scope_.reads_only()) return fail("not finite");
  value = {};
  return true;
}

bool ScriptReader::signed_value(ScriptValue& value) {
  if (eat("not")) {
    if (++depth_ > kDeepest) return fail(kTooDeep);
    if (!level(2, value) || !numeric(value)) return false;
    --depth_;
    if (!open(value)) value = ScriptValue::of(value.number == 0.0);
    return true;
  }
  bool negative = false;
  for (;;) {
    if (eat("-"))
      negative = !negative;
    else if (!eat("+"))
      break;
  }
  if (!with_element(value)) return false;
  if (!negative) return true;
  value.number = -value.number;
  return value.kind == Kind::kNumber || open(value);
}

bool ScriptReader::with_element(ScriptValue& value) {
  if (!primary(value)) return false;
  while (eat("[")) {
    ScriptValue index;
    if (!level(0, index) || !eat("]") || !numeric(index)) return false;
    if (open(value)) continue;
    if (open(index)) {
      value = {};
      continue;
    }
    if (!(index.number >= 0.0 && index.number < static_cast<double>(value.count))) return false;
    const double element = value.elements[static_cast<std::size_t>(index.number)];
    value = ScriptValue::of(element);
  }
  return true;
}

bool ScriptReader::primary(ScriptValue& value) {
  value = {};
  skip_blanks(text_);
  if (text_.empty()) return false;
  if (++depth_ > kDeepest) return fail(kTooDeep);
  work(1);
  bool good = false;
  if (text_[0] == '"') {
    good = quoted(value);
  } else if (eat("(")) {
    good = level(0, value) && eat(")");
  } else if (eat("[")) {
    good = elements(Kind::kList, value);
  } else if (starts_with(text_, "p[")) {
    text_.remove_prefix(2);
    good = elements(Kind::kPose, value);
  } else if (!leading_name(text_).empty()) {
    good = name(value);
  } else {
    value.kind = Kind::kNumber;
    good = read_number(text_, value.number);
  }
  --depth_;
  return good;
}

bool ScriptReader::quoted(ScriptValue& value) {
  const std::size_t end = text_.find('"', 1);
  if (end == std::string_view::npos) return false;
  value.kind = Kind::kText;
  value.text = text_.substr(1, end - 1);
  text_.remove_prefix(end + 1);
  return true;
}

bool ScriptReader::elements(Kind kind, ScriptValue& value) {
  value.kind = kind;
  while (!eat("]")) {
    ScriptValue element;
    if (value.count > 0 && !eat(",")) return false;
    if (value.count == value.elements.size()) return fail("limit of 8 elements");
    if (!level(0, element) || !numeric(element)) return false;
    value.elements[value.count++] = element.number;
  }
  return true;
}

bool ScriptReader::name(ScriptValue& value) {
  const std::string_view word = leading_name(text_);
  if (word == "True" || word == "False") {
    value = ScriptValue::of(word == "True");
    text_.remove_prefix(word.size());
    return true;
  }
  std::string_view behind = text_.substr(word.size());
  skip_blanks(behind);
  if (starts_with(behind, "(")) return call(word, value);
  const ScriptValue* variable = scope_.variables ? scope_.variables->find(word) : nullptr;
  if (variable == nullptr && scope_.reads_only()) *scope_.strange = word;
  if (variable == nullptr) return false;
  value = *variable;
  text_.remove_prefix(word.size());
  return true;
}

/// Reads a call with a value.
bool ScriptReader::call(std::string_view word, ScriptValue& value) {
  ScriptCall call;
  const ValueCall* function = find_function(word);
  if (scope_.reads_only()) {
    if (function == nullptr) *scope_.strange = word;
    return function != nullptr && read(call);
  }
  if (starts_with(word, "get_inverse_kin")) work(kHeavyCall);
  if (scope_.machine == nullptr || function == nullptr || !read(call)) return false;
  value = function->value(call, *scope_.machine);
  return value.kind != Kind::kNothing && finite(value);
}

bool ScriptReader::argument(ScriptCall::Argument& argument) {
  skip_blanks(text_);
  const std::string_view name = leading_name(text_);
  std::string_view rest = text_.substr(name.size());
  skip_blanks(rest);
  if (!name.empty() && starts_with(rest, "=") && !starts_with(rest, "==")) {
    argument.name = name;
    text_ = rest.substr(1);
  }
  return level(0, argument.value);
}

bool ScriptReader::read(ScriptCall& call) {
  call = {};
  skip_blanks(text_);
  call.name = leading_name(text_);
  text_.remove_prefix(call.name.size());
  if (call.name.empty() || !eat("(")) return false;
  while (!eat(")")) {
    if (call.count > 0 && !eat(",")) return false;
    if (call.count == ScriptCall::kMost) return fail("limit of 10 arguments");
    if (!argument(call.arguments[call.count++])) return false;
  }
  if (!scope_.reads_only()) return true;
  std::string_view word;
  const std::string_view fault = argument_fault(call, word);
  if (fault.empty()) return true;
  *scope_.strange = word;
  *scope_.reason = fault;
  return false;
}

}  // namespace

bool evaluate(std::string_view& text, const ScriptScope& scope, ScriptValue& value) {
  ScriptReader expression(text, scope);
  if (!expression.read(value)) return false;
  text = expression.rest();
  return true;
}

bool read_call(std::string_view& text, const ScriptScope& scope, ScriptCall& call) {
  ScriptReader expression(text, scope);
  if (!expression.read(call)) return false;
  text = expression.rest();
  return true;
}

}  // namespace tactus::ur
