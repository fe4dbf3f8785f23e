#include "sim_plant/ur/programs/line_program.hpp"

#include <algorithm>

#include "sim_plant/ur/script/script_signatures.hpp"
#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

void LineProgram::start(std::string_view text, int first_line, bool moves) {
  *this = {};
  text_ = text;
  now_ = here_ = {0, first_line};
  moves_ = moves;
}

ProgramStep LineProgram::poll(Machine& machine) {
  if (moves_ && machine.motion.busy()) return ProgramStep::kRunning;
  if (ended_) return end(machine);
  if (machine.time_s() < wait_until_s_) return ProgramStep::kRunning;
  std::string_view line;
  if (cycle_ != machine.cycle) work_ = std::max(0, work_ - kWorkPerCycle);
  cycle_ = machine.cycle;
  while (work_ < kWorkPerCycle) {
    const Line result = next(line) ? run_line(line, machine) : Line::kEnded;
    ended_ = ended_ || result == Line::kEnded;
    if (ended_) return end(machine);
    if (result == Line::kWait) break;
  }
  return ProgramStep::kRunning;
}

/// Ends the program; a move that returned because of its blend radius reaches its waypoint first.
ProgramStep LineProgram::end(const Machine& machine) const {
  return moves_ && machine.motion.arriving() ? ProgramStep::kRunning : ProgramStep::kEnded;
}

ProgramStep LineProgram::command(Machine& machine) {
  // The cycle may have time left when a motion returns within it.
  if (poll(machine) == ProgramStep::kEnded) return ProgramStep::kEnded;
  return machine.motion.busy() ? ProgramStep::kRunning : ProgramStep::kWaiting;
}

/// Returns the next line without blanks and comment. False: the text has ended.
bool LineProgram::next(std::string_view& line) {
  std::string_view rest = text_.substr(now_.at);
  if (!next_line(rest, line)) return false;
  reason_ = {};
  work_ += 1 + static_cast<int>(line.size() / 64);
  here_ = now_;
  now_ = {text_.size() - rest.size(), now_.line + 1};
  line = trimmed(without_comment(line));
  return true;
}

LineProgram::Line LineProgram::run_line(std::string_view line, Machine& machine) {
  if (line.empty()) return Line::kNext;
  const std::string_view word = leading_name(line);
  if (word == "end") return run_end();
  if (word == "break" || word == "continue") return run_jump(word == "break");
  if (word == "halt" || word == "return") return Line::kEnded;
  if (opens_block(line) || word == "elif" || word == "else") return run_block(word, line, machine);
  return run_statement(line, machine);
}

/// Evaluates the condition of "while ...:", "if ...:" or "elif ...:".
bool LineProgram::holds(std::string_view line, Machine& machine) {
  std::string_view condition = line.substr(leading_name(line).size());
  const std::size_t colon = condition.rfind(':');
  if (colon != std::string_view::npos) condition = condition.substr(0, colon);
  ScriptValue value;
  if (evaluate(condition, known(machine), value) && trimmed(condition).empty() && value.numeric())
    return value.number != 0.0;
  fail(line, machine);
  return false;
}

LineProgram::Line LineProgram::run_statement(std::string_view line, Machine& machine) {
  line = without_scope(line);
  Line result = Line::kNext;
  return assign(line, machine, result) ? result : run_call_line(line, machine);
}

/// Runs "name = value" or "name[index] = value"; "digital_out[n] = b" is the call of versions
/// before 3. False: the line is not an assignment.
bool LineProgram::assign(std::string_view line, Machine& machine, Line& result) {
  ScriptAssignment found;
  if (!read_assignment(line, found)) return false;
  const ScriptScope names = known(machine);
  ScriptValue index, value;
  if (found.element && !evaluate(found.index, names, index)) {
    fail(line, machine);
    return true;
  }
  std::string_view expression = found.value;
  if (!evaluate(expression, names, value)) {
    if (find_call(leading_name(found.value)) != nullptr)
      result =
          run_call_line(found.value, machine);  // such as socket_open(), which is taken to succeed
    else
      fail(line, machine);
    if (ended_) return true;
    value.kind = ScriptValue::Kind::kBool;
    value.number = 1.0;
  }
  ScriptValue* whole = variables_.find(found.name);
  if (found.element && whole == nullptr && found.name == "digital_out") {
    run_call({"set_digital_out", {{{"n", index}, {"b", value}}}, 2}, moves_, machine);
  } else if (found.element) {
    const bool fits = whole != nullptr && index.numeric() && index.number >= 0.0 &&
                      index.number < static_cast<double>(whole->count);
    if (fits)
      whole->elements[static_cast<std::size_t>(index.number)] = value.number;
    else
      fail(line, machine);
  } else if (!variables_.set(found.name, value)) {
    fail(line, machine, kTooManyVariables);
  }
  return true;
}

LineProgram::Line LineProgram::run_call_line(std::string_view line, Machine& machine) {
  ScriptCall call;
  std::string_view rest = line;
  if (!read_call(rest, known(machine), call)) {
    fail(line, machine);
    return Line::kEnded;
  }
  if (starts_with(call.name, "move")) work_ += kHeavyCall;
  const CallOutcome outcome = run_call(call, moves_, machine);
  switch (outcome.result) {
    case CallResult::kDone: return Line::kNext;
    case CallResult::kMotion: return machine.motion.busy() ? Line::kWait : Line::kNext;
    case CallResult::kWait:
      wait_until_s_ = machine.time_s() + outcome.wait_s - 0.5 * machine.cycle_s();
      return outcome.wait_s > 0.0 ? Line::kWait : Line::kNext;
    case CallResult::kHalt: return Line::kEnded;
    case CallResult::kNoReach:
      machine.messages.runtime_exception(here_.line, 3, "runtime_error:no inverse kinematics");
      return Line::kEnded;
    case CallResult::kOutOfRange: fail(line, machine, outcome.why); return Line::kEnded;
  }
  return Line::kNext;
}

/// Ends the program with a runtime exception, "runtime_error:what:line".
void LineProgram::fail(std::string_view line, Machine& machine, std::string_view what) {
  if (ended_) return;
  ended_ = true;
  if (what.empty()) what = reason_.empty() ? "no value" : reason_;
  Text<160> text("runtime_error:");
  text << what << (line.empty() ? "" : ":") << line;
  machine.messages.runtime_exception(here_.line, 1, text);
}

// Blocks of plain programs: loops and branches.

/// True if the line opens a block that an `end` closes.
bool LineProgram::opens_block(std::string_view line) {
  for (const std::string_view word : {"while", "if", "def", "thread", "sec", "switch"})
    if (leading_name(line) == word) return true;
  return false;
}

LineProgram::Line LineProgram::run_block(std::string_view word, std::string_view line,
                                         Machine& machine) {
  if (word == "while") {
    if (!holds(line, machine))
      skip_blocks(1);
    else if (!enter({true, here_}, machine))
      return Line::kEnded;
  } else if (word == "if") {
    if (!holds(line, machine))
      find_branch(machine);
    else if (!enter({false, here_}, machine))
      return Line::kEnded;
  } else if (word == "elif" || word == "else") {
    if (depth_ > 0) --depth_;  // the branch before was taken
    skip_blocks(1);
  } else {
    skip_blocks(1);
  }
  return Line::kNext;
}

LineProgram::Line LineProgram::run_end() {
  if (depth_ == 0) return Line::kEnded;
  const Block& block = blocks_[--depth_];
  if (block.loops) now_ = block.begin;
  return Line::kNext;
}

/// Runs a break (`out`) or a continue.
LineProgram::Line LineProgram::run_jump(bool out) {
  std::size_t left = 0;
  while (depth_ > 0) {
    ++left;
    const Block& block = blocks_[--depth_];
    if (!block.loops) continue;
    if (out)
      skip_blocks(left);
    else
      now_ = block.begin;
    return Line::kNext;
  }
  return Line::kEnded;  // outside any loop
}

/// Enters a block. False, after a runtime exception: there are too many.
bool LineProgram::enter(const Block& block, Machine& machine) {
  if (depth_ == blocks_.size()) {
    fail({}, machine, ScriptBlocks::kTooDeep);
    return false;
  }
  blocks_[depth_++] = block;
  return true;
}

/// After an `if` that is false, goes on in the branch that is true, or after the end.
void LineProgram::find_branch(Machine& machine) {
  std::string_view line;
  while (!ended_ && next(line)) {
    const std::string_view word = leading_name(line);
    if (opens_block(line)) {
      skip_blocks(1);
    } else if (word == "end") {
      return;
    } else if (word == "else" || (word == "elif" && holds(line, machine))) {
      enter({false, here_}, machine);
      return;
    }
  }
}

/// Goes on after the end of the innermost `count` blocks.
void LineProgram::skip_blocks(std::size_t count) {
  std::string_view line;
  while (count > 0 && next(line)) {
    if (opens_block(line)) ++count;
    if (leading_name(line) == "end") --count;
  }
}

}  // namespace tactus::ur
