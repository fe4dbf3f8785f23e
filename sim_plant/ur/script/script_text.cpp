#include "sim_plant/ur/script/script_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tactus::ur {
namespace {

bool is_name(char c, bool first) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         (!first && c >= '0' && c <= '9');
}

/// Returns how many brackets are open after a line that begins with `open` of them.
int brackets_after(std::string_view line, int open) {
  bool quoted = false;
  for (const char c : without_comment(line)) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    open += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
  }
  return open;
}

/// Returns how many of the lines that follow close the brackets of `line`; 0: none, or not soon.
int lines_to_join(std::string_view line, std::string_view rest) {
  constexpr int kMost = 64;
  int open = brackets_after(line, 0), count = 0;
  for (; open > 0 && count < kMost && next_line(rest, line); ++count)
    open = brackets_after(line, open);
  return open == 0 ? count : 0;
}

}  // namespace

void skip_blanks(std::string_view& text) {
  while (!text.empty() && (text[0] == ' ' || text[0] == '\t' || text[0] == '\r'))
    text.remove_prefix(1);
}

bool read_number(std::string_view& text, double& value) {
  skip_blanks(text);
  double number = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || !std::isfinite(number)) return false;  // "nan" and "inf" are names
  value = number;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

std::int32_t integer(double value) {
  constexpr double kLeast = -2147483648.0, kMost = 2147483647.0;
  return std::isnan(value) ? 0 : static_cast<std::int32_t>(std::clamp(value, kLeast, kMost));
}

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

std::size_t join_lines(char* text, std::size_t size) {
  std::string_view rest(text, size), line;
  std::size_t to = 0;
  const auto put = [&](std::string_view part) {
    std::memmove(text + to, part.data(), part.size());
    to += part.size();
  };
  while (next_line(rest, line)) {
    const int more = lines_to_join(line, rest);
    int held = 0;
    put(more > 0 ? without_comment(line) : line);
    for (int i = 0; i < more && next_line(rest, line); ++i) {
      const std::string_view code = without_comment(line);
      const bool words =
          to > 0 && is_name(text[to - 1], false) && !code.empty() && is_name(code[0], false);
      put(words ? " " : "");
      held += words ? 0 : 1;
      put(code);
    }
    for (; held > 0; --held) put("\n");
    if (line.data() + line.size() < text + size) put("\n");
  }
  return to;
}

std::string_view without_scope(std::string_view line) {
  for (const std::string_view word : {"global ", "local "})
    if (starts_with(line, word)) return trimmed(line.substr(word.size()));
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

bool read_assignment(std::string_view line, ScriptAssignment& found) {
  found.name = leading_name(line);
  std::string_view rest = trimmed(line.substr(found.name.size()));
  found.element = starts_with(rest, "[");
  if (found.element) {
    std::size_t end = 1;
    for (int open = 1; open > 0 && end < rest.size(); ++end)
      open += rest[end] == '[' ? 1 : rest[end] == ']' ? -1 : 0;
    found.index = rest.substr(1, end - 2);
    rest = trimmed(rest.substr(end));
  }
  if (found.name.empty() || !starts_with(rest, "=") || starts_with(rest, "==")) return false;
  found.value = trimmed(rest.substr(1));
  return true;
}

const ScriptValue* ScriptCall::find(std::string_view argument, std::size_t position) const {
  for (std::size_t i = 0; i < count; ++i) {
    if (!argument.empty() && arguments[i].name == argument) return &arguments[i].value;
    if (i == position && arguments[i].name.empty()) return &arguments[i].value;
  }
  return nullptr;
}

double ScriptCall::number(std::string_view argument, std::size_t position, double otherwise) const {
  const ScriptValue* value = find(argument, position);
  return value != nullptr && value->numeric() ? value->number : otherwise;
}

const ScriptValue* ScriptVariables::find(std::string_view name) const {
  return const_cast<ScriptVariables*>(this)->find(name);
}

ScriptValue* ScriptVariables::find(std::string_view name) {
  for (std::size_t i = 0; i < count_; ++i)
    if (rows_[i].name == name) return &rows_[i].value;
  return nullptr;
}

bool ScriptVariables::set(std::string_view name, const ScriptValue& value) {
  if (ScriptValue* known = find(name)) {
    *known = value;
    return true;
  }
  if (count_ == rows_.size()) return false;
  rows_[count_++] = {name, value};
  return true;
}

}  // namespace tactus::ur
