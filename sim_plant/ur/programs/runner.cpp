#include "sim_plant/ur/programs/runner.hpp"

#include <algorithm>
#include <cstring>

#include "sim_plant/ur/script/script_calls.hpp"
#include "sim_plant/ur/script/script_check.hpp"

namespace tactus::ur {
namespace {

/// Returns the name after "def " or "sec "; a line without one gets a name of our own.
std::string_view program_name(std::string_view text) {
  for (const std::string_view word : {"def ", "sec "})
    if (starts_with(text, word)) return leading_name(trimmed(text.substr(word.size())));
  return "unnamed";
}

std::string_view copy(std::string_view from, char* to, std::size_t capacity) {
  const std::size_t size = std::min(from.size(), capacity);
  if (size > 0) std::memcpy(to, from.data(), size);
  return {to, size};
}

/// Returns the lines of a block after the first, or a single line as it is.
std::string_view body_of(std::string_view text, int& first_line) {
  first_line = 1;
  if (!starts_with(text, "def ") && !starts_with(text, "sec ")) return text;
  std::string_view line;
  next_line(text, line);
  first_line = 2;
  return text;
}

/// True for a single line that commands a motion, as clients stream them: the arm goes on from its
/// speed.
bool takes_over(std::string_view text) {
  return is_motion(leading_name(trimmed(text)));
}

/// Returns false, after a message, for a program that cannot be run as it is written.
bool compiles(std::string_view text, Machine& machine) {
  ScriptFault fault;
  if (!ScriptCheck(text).find(fault)) return true;
  const std::string_view what =
      fault.kind == ScriptFault::Kind::kNameNotFound  ? "compile_error_name_not_found:"
      : fault.kind == ScriptFault::Kind::kNotEmulated ? "compile_error_not_emulated:"
      : fault.kind == ScriptFault::Kind::kLimit       ? "compile_error_limit:"
                                                      : "compile_error_syntax:";
  Text<200> words(what);
  for (const std::string_view part : {fault.name, fault.reason})
    if (!part.empty()) words << part.substr(0, 72) << ":";
  machine.messages.runtime_exception(fault.line, fault.column, words);
  return false;
}

/// Takes a step of the program that there is.
template <class Programs, class Step>
ProgramStep step_of(Programs& programs, Step step) {
  return std::visit(
      [&](auto& program) {
        if constexpr (std::is_same_v<std::decay_t<decltype(program)>, std::monostate>)
          return ProgramStep::kWaiting;
        else
          return step(program);
      },
      programs);
}

}  // namespace

void Runner::upload(std::string_view text, Machine& machine) {
  if (!machine.power.running() || !machine.safety.normal()) return;  // without a message
  if (starts_with(text, "sec ")) return start_secondary(text, machine);
  if (text.size() > kLongestScript) return machine.messages.text("the program is too long");
  stop(machine);
  text = copy(text, text_.data(), text_.size());
  start(text, machine);
}

void Runner::start(std::string_view text, Machine& machine) {
  if (is_external_control(text)) {
    program_.emplace<ExternalControl>().start(text);
  } else if (RegisterProgram::recognises(text)) {
    program_.emplace<RegisterProgram>().start(text);
  } else {
    text = {text_.data(), join_lines(text_.data(), text.size())};
    if (!compiles(text, machine)) return;
    int first_line = 1;
    const std::string_view body = body_of(text, first_line);
    program_.emplace<LineProgram>().start(body, first_line, true);
  }
  paused_ = false;
  braking_ = !machine.motion.resting() && !takes_over(text);
  if (braking_) machine.motion.stop_j(0.0);
  name_ = program_name(text);
  machine.messages.program_started(name());
}

void Runner::start_secondary(std::string_view text, Machine& machine) {
  if (text.size() > kLongestSecondary) return machine.messages.text("the program is too long");
  if (!compiles(text, machine)) return;
  poll_secondary(machine);  // a secondary program of the same cycle runs first
  text = copy(text, secondary_text_.data(), secondary_text_.size());
  int first_line = 1;
  secondary_.start(body_of(text, first_line), first_line, false);
  secondary_name_ = program_name(text);
  secondary_running_ = true;
  machine.messages.program_started(secondary_name_);
}

void Runner::stop(Machine& machine) {
  if (!running()) return;
  program_.emplace<std::monostate>();
  paused_ = false;
  machine.motion.abandon();
  machine.links.close_all();
  machine.end_modes();
  machine.messages.program_stopped(name());
}

void Runner::fetch(Machine& machine) {
  stop(machine);
  program_.emplace<FetchProgram>();
  name_ = std::string_view("external_control");
  machine.messages.program_started(name());
}

/// Starts the fetched lines as the body of a program.
void Runner::start_fetched(std::string_view text, Machine& machine) {
  std::size_t size = 0;
  for (const std::string_view part :
       {std::string_view("def external_control():\n"), text, std::string_view("\nend\n")})
    size += copy(part, text_.data() + size, text_.size() - size).size();
  stop(machine);
  start({text_.data(), size}, machine);
}

void Runner::poll_secondary(Machine& machine) {
  if (!secondary_running_ || secondary_.poll(machine) != ProgramStep::kEnded) return;
  secondary_running_ = false;
  machine.messages.program_stopped(secondary_name_);
}

/// Reports C207 if an input with a watchdog is late.
void Runner::watch_inputs(Machine& machine) {
  if (!playing()) return;
  const LateAction action = machine.watchdogs.check(machine.io, machine.cycle, machine.cycle_s());
  if (action == LateAction::kStop) machine.protective_stop({Code::kFieldbusDisconnected, 0});
  if (action != LateAction::kPause) return;
  machine.messages.error({Code::kFieldbusDisconnected, 0}, ReportLevel::kWarning);
  pause();
}

void Runner::poll(Machine& machine) {
  poll_secondary(machine);
  watch_inputs(machine);
  braking_ = braking_ && machine.motion.busy();
  if (!playing() || braking_) return;
  const ProgramStep step = step_of(program_, [&](auto& program) { return program.poll(machine); });
  if (step == ProgramStep::kEnded) stop(machine);
  const FetchProgram* fetching = std::get_if<FetchProgram>(&program_);
  const std::string_view fetched = fetching != nullptr ? fetching->text(machine) : "";
  if (!fetched.empty()) start_fetched(fetched, machine);
}

void Runner::command(Machine& machine) {
  if (!playing()) return;
  const ProgramStep step =
      step_of(program_, [&](auto& program) { return program.command(machine); });
  if (step == ProgramStep::kEnded) stop(machine);
}

bool ScriptIntake::next(std::size_t& used, std::string_view& piece) {
  for (;;) {
    const std::string_view rest(text_.data() + scanned_, size_ - scanned_);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return false;
    const std::string_view line = rest.substr(0, end);
    scanned_ += end + 1;
    const std::string_view word = leading_name(line);
    const bool whole = trimmed(without_comment(line)) == "end" && word == "end";
    if (word == "def" || word == "sec") ++depth_;
    if (depth_ > 0) {
      if (word == "while" || word == "if" || word == "thread") ++depth_;
      if (!whole || --depth_ > 0) continue;
    }
    piece = std::string_view(text_.data() + used, scanned_ - used);
    used = scanned_;
    const bool dropped = dropping_;
    dropping_ = false;
    if (!dropped && !trimmed(without_comment(piece)).empty()) return true;
  }
}

void ScriptIntake::drop() {
  dropping_ = true;
  if (scanned_ == 0) {
    text_[0] = ' ';
    size_ = 1;
    return;
  }
  std::memmove(text_.data(), text_.data() + scanned_, size_ - scanned_);
  size_ -= scanned_;
  scanned_ = 0;
}

bool run_direct_command(std::string_view line, Runner& runner, Machine& machine) {
  line = trimmed(without_comment(line));
  double fraction = 0.0;
  if (line == "power on") {
    machine.power.switch_on();
  } else if (line == "power off") {
    runner.stop(machine);
    machine.power.switch_off();
  } else if (line == "set robotmode run") {
    machine.power.release_brakes();
  } else if (line == "set unlock protective stop") {
    machine.safety.unlock_soon();
  } else if (line == "stop program") {
    runner.stop(machine);
  } else if (line == "protective_stop()") {
    machine.protective_stop({Code::kFromScript, 0});
  } else if (number_after(line, "set speed ", fraction)) {
    machine.io.speed_fraction = std::clamp(fraction, 0.0, 1.0);
  } else {
    return line == "run program";
  }
  return true;
}

}  // namespace tactus::ur
