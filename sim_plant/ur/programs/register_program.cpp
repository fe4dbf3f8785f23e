#include "sim_plant/ur/programs/register_program.hpp"

#include <algorithm>

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {
namespace {

/// Returns an offset that the text assigns on the line of `name` or, after a comment, on the next.
int offset(std::string_view text, std::string_view name) {
  const std::size_t at = text.find(name);
  if (at == std::string_view::npos) return 0;
  text = text.substr(at + name.size());
  std::string_view line;
  double value = 0.0;
  for (int i = 0; i < 2 && next_line(text, line); ++i) {
    std::string_view code = trimmed(without_comment(line));
    if (starts_with(code, "=")) code = trimmed(code.substr(1));
    if (number_after(code, "", value)) return integer(value);
  }
  return 0;
}

}  // namespace

bool RegisterProgram::recognises(std::string_view text) {
  for (const std::string_view part : {"def signal_ready():", "def rtde_cmd():", "def process_cmd("})
    if (text.find(part) == std::string_view::npos) return false;
  return true;
}

void RegisterProgram::start(std::string_view text) {
  *this = {};
  text_ = text;
  int_offset_ = offset(text, "global reg_offset_int");
  double_offset_ = offset(text, "global reg_offset_float");
  if (int_offset_ < 0 || int_offset_ > kRegisters / 2) int_offset_ = 0;
  if (double_offset_ < 0 || double_offset_ > kRegisters / 2) double_offset_ = 0;
  if (has("thread move_thread():"))
    progress_ = AsyncProgress(has("async_op_id") ? AsyncProgress::Coding::kCounted
                                                 : AsyncProgress::Coding::kValue);
}

double RegisterProgram::input(int i, const Machine& machine) const {
  return machine.io.input
      .doubles[static_cast<std::size_t>(double_offset_) + static_cast<std::size_t>(i)];
}

std::int32_t RegisterProgram::integer_input(int i, const Machine& machine) const {
  return machine.io.input.ints[static_cast<std::size_t>(int_offset_) + static_cast<std::size_t>(i)];
}

Vector6 RegisterProgram::six(int first, const Machine& machine) const {
  Vector6 values;
  for (int i = 0; i < 6; ++i) values[i] = input(first + i, machine);
  return values;
}

void RegisterProgram::write(int i, std::int32_t value, Machine& machine) const {
  machine.io.output.ints[static_cast<std::size_t>(int_offset_) + static_cast<std::size_t>(i)] =
      value;
}

void RegisterProgram::tell_progress(std::int32_t value, Machine& machine) {
  if (progress_.told()) write(2, progress_.write(value), machine);
}

ProgramStep RegisterProgram::poll(Machine& machine) {
  if (!started_) {
    tell_progress(-1, machine);
    write(0, kReady, machine);
    started_ = true;
  }
  const bool stands = !machine.motion.busy() && !machine.motion.arriving() && path_.empty();
  if (moving_ && stands) {
    moving_ = false;
    tell_progress(-1, machine);
  }
  if (blocked_) {
    blocked_ = !stands;
    if (stands) write(0, kDone, machine);
    return ProgramStep::kRunning;
  }
  const auto command = static_cast<RegisterCommand>(integer_input(0, machine));
  if (command == RegisterCommand::kStop) return ProgramStep::kEnded;
  if (command == RegisterCommand::kNone) {
    executing_ = false;
    write(0, kReady, machine);
  } else if (process(command, machine) == Outcome::kEnded) {
    return ProgramStep::kEnded;
  }
  last_ = command;
  return ProgramStep::kRunning;
}

RegisterProgram::Outcome RegisterProgram::process(RegisterCommand command, Machine& machine) {
  const Handshake shake = handshake_of(command);
  const bool once = shake == Handshake::kDone;
  if (once && executing_) return Outcome::kDone;
  executing_ = executing_ || once;
  const Outcome outcome = act(command, machine);
  blocked_ = outcome == Outcome::kMoves;
  const bool shows_done = once || (shake == Handshake::kBoth && command != last_);
  if (outcome == Outcome::kDone) write(0, shows_done ? kDone : kReady, machine);
  return outcome;
}

ProgramStep RegisterProgram::command(Machine& machine) {
  Motion& motion = machine.motion;
  const double t = t_ > 0.0 ? t_ : machine.cycle_s();
  if (!path_.empty()) {
    follow_path(machine);
  } else if (cyclic_ == Cyclic::kServo) {
    motion.servo_j(goal_, t_, law_);
  } else if (cyclic_ == Cyclic::kServoC) {
    if (!motion.move_l(Frame::of(goal_), a_, v_, 0.0))
      machine.protective_stop({Code::kSingularity, 0});
  } else if (cyclic_ == Cyclic::kSpeedJ) {
    motion.speed_j(goal_, a_, t);
  } else if (cyclic_ == Cyclic::kSpeedL) {
    motion.speed_l(goal_, a_, t);
  }
  return motion.busy() ? ProgramStep::kRunning : ProgramStep::kWaiting;
}

/// Raises the error of the script, which ends; the arm does not move.
RegisterProgram::Outcome RegisterProgram::no_posture(Machine& machine) const {
  const std::string_view before = text_.substr(0, text_.find("get_inverse_kin("));
  const auto line = static_cast<std::int32_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  machine.messages.runtime_exception(line, 1, "runtime_error:no inverse kinematics");
  return Outcome::kEnded;
}

/// On an e-Series, ends a program that has a branch for a command that is not emulated, with the
/// first line of that branch. A CB3, whose text has no such branch, goes on.
RegisterProgram::Outcome RegisterProgram::not_emulated(RegisterCommand command,
                                                       Machine& machine) const {
  const auto number = static_cast<int>(command);
  Text<32> branch("cmd == ");
  const std::size_t at = text_.find(branch << number << ":");
  if (!machine.settings.version.at_least(5, 0) || at == std::string_view::npos)
    return Outcome::kDone;
  const std::string_view before = text_.substr(0, at);
  std::string_view rest = text_.substr(at), line;
  for (int i = 0; i < 2 && next_line(rest, line); ++i) {
  }
  Text<127> words("runtime_error:not emulated:command ");
  words << number << ":" << trimmed(line).substr(0, 64);
  const auto where = static_cast<std::int32_t>(std::count(before.begin(), before.end(), '\n')) + 2;
  machine.messages.runtime_exception(where, 1, words);
  return Outcome::kEnded;
}

}  // namespace tactus::ur
