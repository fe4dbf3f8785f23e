#include "sim_plant/ur/line_program.hpp"

namespace tactus::ur {
namespace {

/// Words that open a block which an `end` closes.
bool opens_block(std::string_view line) {
  for (const std::string_view word : {"while", "if", "def", "thread", "sec", "switch"})
    if (leading_name(line) == word) return true;
  return false;
}

bool for_ever(std::string_view line) {
  return line == "while True:" || line == "while (True):" || line == "while(True):" ||
         line == "while 1:" || line == "while(1):" || line == "while (1):";
}

}  // namespace

void LineProgram::start(std::string_view text, int first_line, bool moves) {
  text_ = text;
  at_ = 0;
  line_ = first_line;
  moves_ = moves;
  ended_ = false;
  wait_until_s_ = -1.0;
  depth_ = 0;
  variables_.count = 0;
}

ProgramStep LineProgram::poll(Machine& machine) {
  if (ended_) return ProgramStep::kEnded;
  if (moves_ && machine.motion.busy()) return ProgramStep::kRunning;
  if (machine.time_s() < wait_until_s_) return ProgramStep::kRunning;
  for (int lines = 0; lines < kLinesAtOnce; ++lines) {
    std::string_view rest = text_.substr(at_), line;
    const int number = line_;
    if (!next_line(rest, line)) {
      ended_ = true;
      return ProgramStep::kEnded;
    }
    at_ = text_.size() - rest.size();
    line_ = number + 1;
    const Line result = run_line(trimmed(without_comment(line)), machine);
    if (result == Line::kEnded) {
      ended_ = true;
      return ProgramStep::kEnded;
    }
    if (result == Line::kWait) return ProgramStep::kRunning;
  }
  return ProgramStep::kRunning;
}

ProgramStep LineProgram::command(Machine& machine) {
  // The cycle may have time left when a motion returns within it.
  if (poll(machine) == ProgramStep::kEnded) return ProgramStep::kEnded;
  return machine.motion.busy() ? ProgramStep::kRunning : ProgramStep::kWaiting;
}

LineProgram::Line LineProgram::run_line(std::string_view line, Machine& machine) {
  if (line.empty()) return Line::kNext;
  if (line == "end") {
    if (depth_ == 0) return Line::kEnded;
    at_ = loops_[depth_ - 1].at;
    line_ = loops_[depth_ - 1].line;
    return Line::kNext;
  }
  if (for_ever(line) && depth_ < kDeepest) {
    loops_[depth_++] = {at_, line_};
    return Line::kNext;
  }
  if (opens_block(line)) {
    const bool condition = leading_name(line) == "if" || leading_name(line) == "while";
    if (condition) machine.messages.text("not emulated: a condition is left out with its block");
    skip_block();
    return Line::kNext;
  }
  return run_statement(line, machine);
}

LineProgram::Line LineProgram::run_statement(std::string_view line, Machine& machine) {
  for (const std::string_view word : {"global ", "local "})
    if (starts_with(line, word)) line = trimmed(line.substr(word.size()));
  const std::string_view name = leading_name(line);
  if (name == "halt") return Line::kEnded;
  const std::string_view rest = trimmed(line.substr(name.size()));
  if (!name.empty() && starts_with(rest, "=") && !starts_with(rest, "==")) {
    std::string_view expression = trimmed(rest.substr(1));
    ScriptValue value;
    if (leading_name(expression).empty() || expression.find('(') == std::string_view::npos) {
      if (read_value(expression, value)) variables_.set(name, value);
      return Line::kNext;
    }
    return run_call_line(expression, machine);
  }
  return run_call_line(line, machine);
}

LineProgram::Line LineProgram::run_call_line(std::string_view line, Machine& machine) {
  ScriptCall call;
  if (!read_call(line, variables_, call)) return Line::kNext;
  const CallOutcome outcome = run_call(call, moves_, machine);
  switch (outcome.result) {
    case CallResult::kDone:
      return Line::kNext;
    case CallResult::kMotion:
      return machine.motion.busy() ? Line::kWait : Line::kNext;
    case CallResult::kWait:
      wait_until_s_ = machine.time_s() + outcome.wait_s - 0.5 * kCycle_s;
      return outcome.wait_s > 0.0 ? Line::kWait : Line::kNext;
    case CallResult::kHalt:
      return Line::kEnded;
    case CallResult::kNoReach:
      machine.messages.runtime_exception(line_ - 1, 3, "runtime_error:no inverse kinematics");
      return Line::kEnded;
  }
  return Line::kNext;
}

void LineProgram::skip_block() {
  int open = 1;
  std::string_view rest = text_.substr(at_), line;
  while (open > 0 && next_line(rest, line)) {
    line = trimmed(without_comment(line));
    if (opens_block(line)) ++open;
    if (line == "end") --open;
    ++line_;
  }
  at_ = text_.size() - rest.size();
}

}  // namespace tactus::ur
