#include "sim_plant/ur/script_text.hpp"

#include <charconv>

namespace tactus::ur {
namespace {

bool is_name(char c, bool first) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         (!first && c >= '0' && c <= '9');
}

void skip_blanks(std::string_view& text) {
  while (!text.empty() && (text[0] == ' ' || text[0] == '\t' || text[0] == '\r'))
    text.remove_prefix(1);
}

bool eat(std::string_view& text, char c) {
  skip_blanks(text);
  if (text.empty() || text[0] != c) return false;
  text.remove_prefix(1);
  return true;
}

bool eat_word(std::string_view& text, std::string_view word) {
  if (leading_name(text) != word) return false;
  text.remove_prefix(word.size());
  return true;
}

bool read_number(std::string_view& text, double& value) {
  skip_blanks(text);
  std::string_view rest = text;
  const bool plus = !rest.empty() && rest[0] == '+';
  if (plus) rest.remove_prefix(1);
  const auto [end, code] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (code != std::errc()) return false;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  text = rest;
  return true;
}

bool read_elements(std::string_view& text, ScriptValue& value) {
  if (!eat(text, '[')) return false;
  while (!eat(text, ']')) {
    if (value.count > 0 && !eat(text, ',')) return false;
    if (value.count == value.elements.size() || !read_number(text, value.elements[value.count++]))
      return false;
  }
  return true;
}

bool read_argument(std::string_view& text, const ScriptVariables& variables,
                   ScriptCall::Argument& argument) {
  skip_blanks(text);
  const std::string_view name = leading_name(text);
  std::string_view rest = text.substr(name.size());
  if (!name.empty() && eat(rest, '=')) {
    argument.name = name;
    text = rest;
  }
  if (read_value(text, argument.value)) return true;
  skip_blanks(text);
  const std::string_view variable = leading_name(text);
  const ScriptValue* value = variables.find(variable);
  if (value == nullptr) return false;
  argument.value = *value;
  text.remove_prefix(variable.size());
  return true;
}

}  // namespace

bool next_line(std::string_view& text, std::string_view& line) {
  if (text.empty()) return false;
  const std::size_t end = text.find('\n');
  line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return true;
}

std::string_view trimmed(std::string_view text) {
  skip_blanks(text);
  while (!text.empty() &&
         (text.back() == ' ' || text.back() == '\t' || text.back() == '\r' || text.back() == '\n'))
    text.remove_suffix(1);
  return text;
}

std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == '#' && !quoted) return line.substr(0, i);
  }
  return line;
}

std::string_view leading_name(std::string_view text) {
  std::size_t size = 0;
  while (size < text.size() && is_name(text[size], size == 0)) ++size;
  return text.substr(0, size);
}

bool starts_with(std::string_view text, std::string_view word) {
  return text.substr(0, word.size()) == word;
}

bool number_after(std::string_view text, std::string_view key, double& value) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return false;
  text.remove_prefix(at + key.size());
  return read_number(text, value);
}

bool read_value(std::string_view& text, ScriptValue& value) {
  using Kind = ScriptValue::Kind;
  std::string_view rest = text;
  skip_blanks(rest);
  value = {};
  if (eat(rest, '"')) {
    const std::size_t end = rest.find('"');
    if (end == std::string_view::npos) return false;
    value.kind = Kind::kText;
    value.text = rest.substr(0, end);
    rest.remove_prefix(end + 1);
  } else if (eat_word(rest, "True") || eat_word(rest, "False")) {
    value.kind = Kind::kBool;
    value.number = rest.data()[-1] == 'e' && rest.data()[-2] == 'u' ? 1.0 : 0.0;
  } else if (starts_with(rest, "p[")) {
    rest.remove_prefix(1);
    value.kind = Kind::kPose;
    if (!read_elements(rest, value)) return false;
  } else if (starts_with(rest, "[")) {
    value.kind = Kind::kList;
    if (!read_elements(rest, value)) return false;
  } else {
    value.kind = Kind::kNumber;
    if (!read_number(rest, value.number)) return false;
  }
  text = rest;
  return true;
}

const ScriptValue* ScriptCall::find(std::string_view argument, std::size_t position) const {
  for (std::size_t i = 0; i < count; ++i) {
    if (arguments[i].name == argument) return &arguments[i].value;
    if (i == position && arguments[i].name.empty()) return &arguments[i].value;
  }
  return nullptr;
}

double ScriptCall::number(std::string_view argument, std::size_t position, double otherwise) const {
  const ScriptValue* value = find(argument, position);
  return value != nullptr && value->numeric() ? value->number : otherwise;
}

const ScriptValue* ScriptVariables::find(std::string_view name) const {
  for (std::size_t i = 0; i < count; ++i)
    if (rows[i].name == name) return &rows[i].value;
  return nullptr;
}

void ScriptVariables::set(std::string_view name, const ScriptValue& value) {
  for (std::size_t i = 0; i < count; ++i)
    if (rows[i].name == name) {
      rows[i].value = value;
      return;
    }
  if (count < rows.size()) rows[count++] = {name, value};
}

bool read_call(std::string_view text, const ScriptVariables& variables, ScriptCall& call) {
  call = {};
  skip_blanks(text);
  call.name = leading_name(text);
  text.remove_prefix(call.name.size());
  if (call.name.empty() || !eat(text, '(')) return false;
  while (!eat(text, ')')) {
    if (call.count > 0 && !eat(text, ',')) return false;
    if (call.count == ScriptCall::kMost) return false;
    if (!read_argument(text, variables, call.arguments[call.count++])) return false;
  }
  return true;
}

}  // namespace tactus::ur
