// ScriptReader: takes one expression or call off a text, by recursive descent of bounded depth.
#pragma once

#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {

class ScriptReader {
 public:
  ScriptReader(std::string_view text, const ScriptScope& scope) : text_(text), scope_(scope) {}

  bool read(ScriptValue& value) { return level(0, value); }
  bool read(ScriptCall& call);
  std::string_view rest() const { return text_; }

 private:
  bool level(std::size_t at, ScriptValue& value);
  bool signed_value(ScriptValue& value);
  bool with_element(ScriptValue& value);
  bool primary(ScriptValue& value);
  bool name(ScriptValue& value);
  bool quoted(ScriptValue& value);
  bool elements(ScriptValue::Kind kind, ScriptValue& value);
  bool argument(ScriptCall::Argument& argument);
  std::string_view operator_of(std::size_t level);
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

}  // namespace tactus::ur
