#include "sim_plant/ur/script/script_check.hpp"

#include <algorithm>

#include "sim_plant/ur/script/script_signatures.hpp"
#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

std::string_view ScriptBlocks::take(std::string_view line, int number) {
  if (line.empty()) return {};
  if (closed_) return "stands after the end of the program";
  const std::string_view word = leading_name(line);
  if (word == "def" || word == "sec") {
    whole_ = whole_ || number == 1;
    return open(Kind::kFunction, number);
  }
  if (word == "while") return open(Kind::kLoop, number);
  if (word == "if") return open(Kind::kIf, number);
  if (word == "end") return close();
  if ((word == "break" || word == "continue") && !in_loop()) return "stands outside of a loop";
  if (word != "else" && word != "elif") return {};
  if (depth_ == 0 || blocks_[depth_ - 1].kind == Kind::kLoop ||
      blocks_[depth_ - 1].kind == Kind::kFunction)
    return "belongs to no if";
  if (blocks_[depth_ - 1].kind == Kind::kElse) return "stands after else";
  if (word == "else") blocks_[depth_ - 1].kind = Kind::kElse;
  return {};
}

std::string_view ScriptBlocks::open(Kind kind, int number) {
  if (depth_ == blocks_.size()) return kTooDeep;
  blocks_[depth_++] = {kind, number};
  return {};
}

std::string_view ScriptBlocks::close() {
  if (depth_ == 0) return "ends no block";
  --depth_;
  closed_ = whole_ && depth_ == 0;
  return {};
}

/// True if a loop is around the line.
bool ScriptBlocks::in_loop() const {
  for (std::size_t i = 0; i < depth_; ++i)
    if (blocks_[i].kind == Kind::kLoop) return true;
  return false;
}

namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// True for a name that a program may not define or assign.
bool is_taken(std::string_view name) {
  return is_urscript_function(name) || is_one_of(name, {"True", "False"}) ||
         (is_urscript_word(name) && name != "p");
}

}  // namespace

ScriptCheck::ScriptCheck(std::string_view program) : program_(program), body_(program) {
  std::string_view first;
  if (starts_with(program, "def ") || starts_with(program, "sec ")) next_line(body_, first);
}

bool ScriptCheck::find(ScriptFault& fault) {
  collect_variables();
  std::string_view rest = program_, line;
  const auto tell = [&](int where, std::string_view text, std::string_view code) {
    const std::string_view at = strange_.empty() ? code : strange_;
    fault = {kind(), where, static_cast<int>(at.data() - text.data()) + 1, at, reason_};
    return true;
  };
  for (int number = 1; next_line(rest, line); ++number) {
    const std::string_view code = trimmed(without_comment(line));
    strange_ = reason_ = {};
    const bool first = number == 1 && body_.size() < program_.size();
    if (!good_place(code, number) || !(first || good_line(code))) return tell(number, line, code);
  }
  const int open = blocks_.open_line();
  if (open == 0) return false;
  rest = program_;
  for (int i = 0; i < open; ++i) next_line(rest, line);
  blame({}, "has no end");
  return tell(open, line, trimmed(without_comment(line)));
}

/// Notes every variable of the program, and the first line that has one too many.
void ScriptCheck::collect_variables() {
  std::string_view rest = program_, line;
  for (int number = 1; next_line(rest, line); ++number) {
    const std::string_view code = without_scope(trimmed(without_comment(line)));
    ScriptAssignment assignment;
    if (!read_assignment(code, assignment) || assignment.element) continue;
    if (variables_.set(assignment.name, {})) continue;
    overflow_ = number;
    return;
  }
}

/// True for a line whose block may have it, and whose variables have room.
bool ScriptCheck::good_place(std::string_view line, int number) {
  const std::string_view reason = blocks_.take(line, number);
  if (!reason.empty()) return blame({}, reason);
  return number != overflow_ || blame({}, kTooManyVariables);
}

bool ScriptCheck::good_line(std::string_view line) {
  const std::string_view word = leading_name(line);
  if (line.empty() || line == "end" || line == "else:") return true;
  if (is_one_of(word, {"break", "continue", "halt", "return"}) && line == word) return true;
  if (is_one_of(word, {"while", "if", "elif"})) return whole(line.substr(word.size()), ":");
  if (is_urscript_word(word) && !is_one_of(word, {"global", "local", "p", "not"}))
    return blame(word);
  return good_statement(without_scope(line));
}

/// The value of a call without one counts as True.
bool ScriptCheck::good_statement(std::string_view line) {
  ScriptAssignment found;
  if (!read_assignment(line, found)) return good_call(line);
  if (is_taken(found.name)) return blame(found.name, "is a name of the language");
  if (found.element && found.name != "digital_out" && variables_.find(found.name) == nullptr)
    return blame(found.name);
  if (found.element && !whole(found.index, "")) return false;
  return find_call(leading_name(found.value)) != nullptr ? good_call(found.value)
                                                         : whole(found.value, "");
}

bool ScriptCheck::good_call(std::string_view line) {
  const std::string_view name = leading_name(line);
  if (name.empty()) return false;
  if (find_call(name) == nullptr && find_function(name) == nullptr) return blame(name);
  ScriptCall call;
  return read_call(line, {&variables_, nullptr, &strange_, &reason_}, call) &&
         trimmed(line).empty();
}

/// Reads an expression and, to the end of the text, what follows it.
bool ScriptCheck::whole(std::string_view text, std::string_view after) {
  ScriptValue value;
  return evaluate(text, {&variables_, nullptr, &strange_, &reason_}, value) &&
         trimmed(text) == after;
}

/// Notes a name and what is wrong with it, unless it is not emulated; returns false.
bool ScriptCheck::blame(std::string_view name, std::string_view reason) {
  strange_ = name;
  reason_ = reason;
  return false;
}

/// True for a function or thread that the program defines.
bool ScriptCheck::defines(std::string_view name) const {
  std::string_view rest = body_, line;
  while (next_line(rest, line)) {
    line = trimmed(line);
    for (const std::string_view word : {"def ", "thread "})
      if (starts_with(line, word) && leading_name(trimmed(line.substr(word.size()))) == name)
        return true;
  }
  return false;
}

ScriptFault::Kind ScriptCheck::kind() const {
  if (starts_with(reason_, "limit of ")) return ScriptFault::Kind::kLimit;
  if (strange_.empty() || !reason_.empty()) return ScriptFault::Kind::kSyntax;
  const bool known =
      is_urscript_function(strange_) || is_urscript_word(strange_) || defines(strange_);
  return known ? ScriptFault::Kind::kNotEmulated : ScriptFault::Kind::kNameNotFound;
}

}  // namespace tactus::ur
