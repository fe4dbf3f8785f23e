// Blocks of plain programs: loops, branches, and the program's own functions.
#include "sim_plant/ur/programs/line_program.hpp"
#include "sim_plant/ur/script/script_definition.hpp"
#include "sim_plant/ur/script/script_names.hpp"

namespace tactus::ur {

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
    else if (!enter({Block::kLoop, here_, {}}, machine))
      return Line::kEnded;
  } else if (word == "if") {
    if (!holds(line, machine))
      find_branch(machine);
    else if (!enter({Block::kBranch, here_, {}}, machine))
      return Line::kEnded;
  } else if (word == "elif" || word == "else") {
    if (depth_ > 0) --depth_;  // the branch before was taken
    skip_blocks(1);
  } else {
    skip_blocks(1);
  }
  return Line::kNext;
}

LineProgram::Line LineProgram::run_end(std::string_view line, Machine& machine) {
  if (depth_ == 0) return Line::kEnded;
  if (blocks_[depth_ - 1].kind == Block::kCall) return run_return(line, machine);
  const Block& block = blocks_[--depth_];
  if (block.kind == Block::kLoop) now_ = block.next;
  return Line::kNext;
}

/// Runs a break (`out`) or a continue.
LineProgram::Line LineProgram::run_jump(bool out) {
  std::size_t left = 0;
  while (depth_ > 0) {
    ++left;
    const Block& block = blocks_[--depth_];
    if (block.kind == Block::kCall) return Line::kEnded;  // the function has no loop around it
    if (block.kind != Block::kLoop) continue;
    if (out)
      skip_blocks(left);
    else
      now_ = block.next;
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

/// Returns from the running function, or ends the program outside of functions.
LineProgram::Line LineProgram::run_return(std::string_view line, Machine& machine) {
  std::string_view expression = trimmed(line.substr(leading_name(line).size()));
  ScriptValue value;
  const bool has_value = !expression.empty();
  if (has_value && !evaluate(expression, known(machine), value)) fail(line, machine);
  while (depth_ > 0 && !ended_) {
    const Block block = blocks_[--depth_];
    if (block.kind != Block::kCall) continue;
    variables_.leave();
    now_ = block.next;
    if (block.result.empty()) return Line::kNext;
    if (!has_value)
      fail(line, machine);
    else if (!variables_.set(block.result, value, block.scope))
      fail(line, machine, kTooManyVariables);
    return Line::kNext;
  }
  return Line::kEnded;
}

/// Finds the lines after "def name(parameters):". False: the program has no such function.
bool LineProgram::find_function(std::string_view name, Place& body,
                                std::string_view& parameters) const {
  std::string_view rest = text_, line;
  for (int number = first_line_; next_line(rest, line); ++number) {
    line = trimmed(without_comment(line));
    std::string_view found;
    if (!read_definition(line, found, parameters) || found != name) continue;
    body = {text_.size() - rest.size(), number + 1};
    return true;
  }
  return false;
}

/// Calls a function of the program by "name(arguments)"; its result becomes the value of a
/// variable. False: the line is not such a call.
bool LineProgram::call_own(std::string_view line, std::string_view result, Scope scope,
                           Machine& machine) {
  const std::string_view name = leading_name(line);
  std::string_view parameters, rest = line;
  Place body;
  if (name.empty() || !starts_with(trimmed(line.substr(name.size())), "(")) return false;
  if (is_urscript_function(name) || !find_function(name, body, parameters)) return false;
  ScriptCall call;
  const bool good = read_call(rest, known(machine), call) && trimmed(rest).empty() &&
                    enter({Block::kCall, now_, result, scope}, machine);
  if (good) variables_.enter();
  for (std::size_t i = 0; good && i < call.count; ++i)
    if (!variables_.set(take_parameter(parameters), call.arguments[i].value, Scope::kLocal))
      fail(line, machine, kTooManyVariables);
  if (good)
    now_ = body;
  else
    fail(line, machine);
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
      enter({Block::kBranch, here_, {}}, machine);
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
