#include "sim_plant/ur/register_program.hpp"

#include <algorithm>

#include "sim_plant/ur/script_text.hpp"

namespace tactus::ur {
namespace {

using Command = RegisterCommand;

bool is_cyclic(Command command) {
  return command == Command::kServoJ || command == Command::kServoL ||
         command == Command::kSpeedJ || command == Command::kSpeedL ||
         command == Command::kForceMode;
}

/// An offset that the text assigns, on that line or, behind a comment, on the next.
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
  int_offset_ = offset(text, "global reg_offset_int");
  double_offset_ = offset(text, "global reg_offset_float");
  if (int_offset_ < 0 || int_offset_ > kRegisters / 2) int_offset_ = 0;
  if (double_offset_ < 0 || double_offset_ > kRegisters / 2) double_offset_ = 0;
  constexpr std::string_view kWatch = "rtde_set_watchdog(\"";
  const std::size_t watch = text.find(kWatch);
  if (watch != std::string_view::npos)
    watch_name_ = leading_name(text.substr(watch + kWatch.size()));
  async_ = text.find("thread move_thread():") != std::string_view::npos;
}

double RegisterProgram::input(int i, const Machine& machine) const {
  return machine.io.input
      .doubles[static_cast<std::size_t>(double_offset_) + static_cast<std::size_t>(i)];
}

std::int32_t RegisterProgram::integer(int i, const Machine& machine) const {
  return machine.io.input.ints[static_cast<std::size_t>(int_offset_) + static_cast<std::size_t>(i)];
}

Vector6 RegisterProgram::six(int first, const Machine& machine) const {
  Vector6 values;
  for (int i = 0; i < 6; ++i) values[i] = input(first + i, machine);
  return values;
}

void RegisterProgram::answer(std::int32_t value, Machine& machine) const {
  machine.io.output.ints[static_cast<std::size_t>(int_offset_)] = value;
}

void RegisterProgram::answer_six(const Vector6& values, Machine& machine) const {
  for (int i = 0; i < 6; ++i)
    machine.io.output
        .doubles[static_cast<std::size_t>(double_offset_) + static_cast<std::size_t>(i)] =
        values[i];
}

/// Bits 24-30 count operations, 16-22 writes; bit 15: one is under way.
void RegisterProgram::progress(bool running, Machine& machine) {
  if (!async_) return;
  writes_ = writes_ % 127 + 1;
  if (running) operations_ = operations_ % 127 + 1;
  machine.io.output.ints[static_cast<std::size_t>(int_offset_) + 2] =
      writes_ << 16 | operations_ << 24 | (running ? 1 << 15 : 0);
}

ProgramStep RegisterProgram::poll(Machine& machine) {
  if (!started_) {
    progress(false, machine);
    answer(kReady, machine);
    started_ = true;
  }
  if (watchdog_barks(machine)) {
    machine.messages.error({Code::kFieldbusDisconnected, 0}, ReportLevel::kViolation);
    return ProgramStep::kEnded;
  }
  if (moving_ && !machine.motion.busy()) {
    moving_ = false;
    progress(false, machine);
  }
  const auto command = static_cast<Command>(integer(0, machine));
  if (blocked_) {
    if (machine.motion.busy()) return ProgramStep::kRunning;
    blocked_ = false;
    answer(kDone, machine);
    return ProgramStep::kRunning;
  }
  if (command == Command::kStop) return ProgramStep::kEnded;
  if (is_cyclic(command)) {
    take_cyclic(command, machine);
    answer(kReady, machine);
  } else if (command == Command::kNone) {
    executing_ = false;
    answer(kReady, machine);
  } else if (!executing_) {
    executing_ = true;
    process(command, machine);
    if (!blocked_) answer(kDone, machine);
  }
  return ProgramStep::kRunning;
}

void RegisterProgram::process(Command command, Machine& machine) {
  switch (command) {
    case Command::kMoveJ:
    case Command::kMoveJPose:
    case Command::kMoveL:
    case Command::kMoveLJoints:
      return move(command, machine);
    case Command::kSpeedStop:
      return stop(async_ ? input(0, machine) : 10.0, machine);
    case Command::kServoStop:
      return stop(async_ ? input(0, machine) : 20.0, machine);
    case Command::kForceModeStop:
      return stop(10.0, machine);
    case Command::kStopJ:
    case Command::kStopL:
      return stop(input(0, machine), machine);
    case Command::kTeachMode:
    case Command::kEndTeachMode:
      machine.freedrive = command == Command::kTeachMode;
      return;
    case Command::kSetPayload:
      machine.set_payload(input(0, machine),
                          Vector3(input(1, machine), input(2, machine), input(3, machine)));
      return;
    case Command::kSetTcp:
      machine.set_tcp(six(0, machine));
      return;
    case Command::kProtectiveStop:
      machine.protective_stop({Code::kFromScript, 0});
      return;
    case Command::kWatchdog:
      watched_ = find_input(watch_name_, machine.settings.version);
      if (watched_.type == FieldType::kNotFound)
        watched_ = {FieldType::kInt32, Input::kInts, static_cast<std::uint8_t>(int_offset_)};
      watch_hz_ = input(0, machine);
      watched_from_ = machine.cycle;
      return;
    default:
      return ask(command, machine);
  }
}

void RegisterProgram::move(Command command, Machine& machine) {
  const Vector6 target = six(0, machine);
  const double v = input(6, machine), a = input(7, machine);
  Motion& motion = machine.motion;
  Joints q = target;
  bool good = true;
  cyclic_ = Cyclic::kNone;
  if (command == Command::kMoveJPose)
    good = inverse(Frame::of(target), motion.tool(), motion.q(), q);
  if (command == Command::kMoveJ || command == Command::kMoveJPose)
    good = good && motion.move_j(q, a, v, 0.0);
  if (command == Command::kMoveL) good = motion.move_l(Frame::of(target), a, v, 0.0);
  if (command == Command::kMoveLJoints)
    good = motion.move_l(forward(target) * motion.tool(), a, v, 0.0);
  if (!good) return machine.protective_stop({Code::kSingularity, 0});
  moving_ = async_ && integer(1, machine) == 1;
  blocked_ = !moving_;
  if (moving_) progress(true, machine);
}

void RegisterProgram::take_cyclic(Command command, Machine& machine) {
  const Vector6 values = six(0, machine);
  switch (command) {
    case Command::kSpeedJ:
    case Command::kSpeedL:
      cyclic_ = command == Command::kSpeedJ ? Cyclic::kSpeedJ : Cyclic::kSpeedL;
      goal_ = values;
      a_ = input(6, machine);
      t_ = input(7, machine);
      return;
    case Command::kServoL:
    case Command::kServoJ: {
      Joints q = values;
      if (command == Command::kServoL &&
          !inverse(Frame::of(values), machine.motion.tool(), machine.motion.q(), q))
        return machine.protective_stop({Code::kSingularity, 0});
      cyclic_ = Cyclic::kServo;
      goal_ = q;
      t_ = input(8, machine);
      law_ = {input(10, machine), input(9, machine)};
      return;
    }
    default:
      return;  // force mode: the arm keeps its place
  }
}

void RegisterProgram::stop(double a, Machine& machine) {
  cyclic_ = Cyclic::kNone;
  machine.motion.stop_j(a);
  blocked_ = true;
}

ProgramStep RegisterProgram::command(Machine& machine) {
  Motion& motion = machine.motion;
  if (cyclic_ == Cyclic::kServo) motion.servo_j(goal_, t_, law_);
  if (cyclic_ == Cyclic::kSpeedJ) motion.speed_j(goal_, a_, t_ > 0.0 ? t_ : machine.cycle_s());
  if (cyclic_ == Cyclic::kSpeedL) motion.speed_l(goal_, a_, t_ > 0.0 ? t_ : machine.cycle_s());
  return motion.busy() ? ProgramStep::kRunning : ProgramStep::kWaiting;
}

bool RegisterProgram::watchdog_barks(const Machine& machine) const {
  if (!(watch_hz_ > 0.0)) return false;
  const std::int64_t last = std::max(machine.io.written[watched_.variable()], watched_from_);
  return static_cast<double>(machine.cycle - last) * machine.cycle_s() > 1.0 / watch_hz_;
}

}  // namespace tactus::ur
