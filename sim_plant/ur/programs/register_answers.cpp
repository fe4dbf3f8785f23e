// Answers of ur_rtde's program: a flag in its second integer, six numbers in its first doubles.
#include <algorithm>
#include <array>
#include <cstdio>

#include "sim_plant/ur/programs/register_program.hpp"
#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

using Command = RegisterCommand;
using Program = RegisterProgram;

Program::Outcome Program::inverse_here(Machine& machine) {
  return answer_inverse(machine.motion.q(), machine);
}

Program::Outcome Program::inverse_near(Machine& machine) {
  return answer_inverse(six(6, machine), machine);
}

Program::Outcome Program::answer_inverse(const Joints& near, Machine& machine) {
  Joints q;
  if (!inverse(Frame::of(six(0, machine)), machine.motion.tool(), near, q))
    return no_posture(machine);
  return answer_six(q, machine);
}

Program::Outcome Program::has_inverse(Machine& machine) {
  Joints q;
  const Motion& motion = machine.motion;
  return answer_flag(inverse(Frame::of(six(0, machine)), motion.tool(), motion.q(), q), machine);
}

Program::Outcome Program::has_inverse_near(Machine& machine) {
  Joints q;
  return answer_flag(inverse(Frame::of(six(0, machine)), machine.motion.tool(), six(6, machine), q),
                     machine);
}

Program::Outcome Program::joints_within(Machine& machine) {
  const double most = machine.settings.motion.position;
  return answer_flag((six(0, machine).array().abs() <= most).all(), machine);
}

Program::Outcome Program::forward_here(Machine& machine) {
  return answer_six((forward(machine.measured_q()) * machine.motion.tool()).pose(), machine);
}

Program::Outcome Program::forward_of(Machine& machine) {
  return answer_six((forward(six(0, machine)) * Frame::of(six(6, machine))).pose(), machine);
}

Program::Outcome Program::flange_pose(Machine& machine) {
  return answer_six(forward(machine.measured_q()).pose(), machine);
}

Program::Outcome Program::pose_trans(Machine& machine) {
  return answer_six((Frame::of(six(0, machine)) * Frame::of(six(6, machine))).pose(), machine);
}

Program::Outcome Program::tcp_offset(Machine& machine) {
  return answer_six(machine.tcp_offset, machine);
}

/// Answers the joint torques without those that hold and move the arm itself.
Program::Outcome Program::joint_torques(Machine& machine) {
  return answer_six(machine.body.residual(), machine);
}

Program::Outcome Program::steady(Machine& machine) {
  return answer_flag(machine.motion.resting(), machine);
}

Program::Outcome Program::answer_flag(bool flag, Machine& machine) const {
  write(1, flag ? 1 : 0, machine);
  return Outcome::kDone;
}

/// Answers six values; NaN is not answered.
Program::Outcome Program::answer_six(const Vector6& values, Machine& machine) const {
  auto* doubles = machine.io.output.doubles.data() + double_offset_;
  if (values.allFinite()) std::copy(values.begin(), values.end(), doubles);
  return Outcome::kDone;
}

/// Raises the error of the script, which ends; the arm does not move.
Program::Outcome Program::no_posture(Machine& machine) const {
  const std::string_view before = text_.substr(0, text_.find("get_inverse_kin("));
  const auto line = static_cast<std::int32_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  machine.messages.runtime_exception(line, 1, "runtime_error:no inverse kinematics");
  return Outcome::kEnded;
}

/// On an e-Series, ends a program that has a branch for a command that is not emulated, with the
/// first line of that branch. A CB3, whose text has no such branch, goes on.
Program::Outcome Program::not_emulated(Command command, Machine& machine) const {
  std::array<char, 128> words;
  const auto number = static_cast<int>(command);
  std::snprintf(words.data(), words.size(), "cmd == %d:", number);
  const std::size_t at = text_.find(words.data());
  if (!machine.settings.version.at_least(5, 0) || at == std::string_view::npos)
    return Outcome::kDone;
  const std::string_view before = text_.substr(0, at);
  std::string_view rest = text_.substr(at), line;
  for (int i = 0; i < 2 && next_line(rest, line); ++i) {
  }
  line = trimmed(line).substr(0, 64);
  std::snprintf(words.data(), words.size(), "runtime_error:not emulated:command %d:%.*s", number,
                static_cast<int>(line.size()), line.data());
  const auto where = static_cast<std::int32_t>(std::count(before.begin(), before.end(), '\n')) + 2;
  machine.messages.runtime_exception(where, 1, words.data());
  return Outcome::kEnded;
}

}  // namespace tactus::ur
