#include "sim_plant/ur/programs/waypoint_program.hpp"

#include <algorithm>
#include <cstdio>

#include "sim_plant/ur/script/script_expression.hpp"

namespace tactus::ur {
namespace {

constexpr double kSilence_s = 2.0;   // default time-out of a read in a script
constexpr int kSegmentsAtOnce = 32;  // segments of zero duration in one cycle

/// Returns the value that the first assignment to this name gives; no value if there is none.
ScriptValue assigned(std::string_view text, std::string_view name) {
  ScriptValue value;
  std::string_view line;
  while (next_line(text, line)) {
    line = trimmed(without_comment(line));
    if (starts_with(line, "global ")) line = trimmed(line.substr(7));
    if (leading_name(line) != name) continue;
    line = trimmed(line.substr(name.size()));
    if (!starts_with(line, "=")) continue;
    line.remove_prefix(1);
    if (evaluate(line, {}, value)) return value;
  }
  return {};
}

/// Reads "(1, -2.5, ...)"; returns the number of numbers, at most `numbers.size()`; 0: not a list.
std::size_t read_list(std::string_view line, std::array<double, 14>& numbers) {
  const std::size_t open = line.find('(');
  if (open == std::string_view::npos) return 0;
  line.remove_prefix(open + 1);
  for (std::size_t count = 0; count < numbers.size();) {
    skip_blanks(line);
    const double sign = starts_with(line, "-") ? -1.0 : 1.0;
    if (sign < 0.0) line.remove_prefix(1);
    if (!read_number(line, numbers[count])) return 0;
    numbers[count++] *= sign;
    skip_blanks(line);
    if (starts_with(line, ")")) return count;
    if (!starts_with(line, ",")) return 0;
    line.remove_prefix(1);
  }
  return 0;
}

}  // namespace

bool WaypointProgram::recognises(std::string_view text) {
  return text.find("servoj(") != std::string_view::npos &&
         text.find("socket_read_ascii_float(14") != std::string_view::npos &&
         assigned(text, "REVERSE_PORT").numeric();
}

void WaypointProgram::start(std::string_view text) {
  *this = {};
  place_.host = assigned(text, "REVERSE_IP").text;
  place_.name = assigned(text, "CONNECTION_NAME").text;
  place_.port = integer(assigned(text, "REVERSE_PORT").number);
  struct Row {
    std::string_view name;
    double& value;
  };
  for (const Row& row : {Row{"TIME_INTERVAL", interval_s_}, Row{"SERVOJ_TIME", servo_s_},
                         Row{"SERVOJ_TIME_WAITING", pause_s_}, Row{"MAX_WAITING_TIME", patience_s_},
                         Row{"MAX_JOINT_DIFFERENCE", near_}, Row{"SERVOJ_GAIN", law_.gain},
                         Row{"SERVOJ_LOOKAHEAD_TIME", law_.lookahead_s}}) {
    const ScriptValue value = assigned(text, row.name);
    if (value.numeric() && value.number > 0.0) row.value = value.number;
  }
}

ProgramStep WaypointProgram::poll(Machine& machine) {
  Link* link = machine.links.find(place_.name);
  if (link == nullptr) return ProgramStep::kEnded;
  if (!begun_) {
    machine.messages.text("Starting the program");
    link->want(place_.name, place_.host, place_.port);
    hold_ = machine.body.q();
    heard_s_ = machine.time_s();
    begun_ = true;
  }
  if (!stopping_) {
    ask(*link);
    take(*link, machine);
  }
  if (!stopping_ && machine.time_s() - heard_s_ > kSilence_s) {
    machine.messages.text("Not received trajectory for the last 2 seconds. Quitting");
    stopping_ = true;
  }
  return ProgramStep::kRunning;
}

/// Requests the waypoints that are needed and not yet requested.
void WaypointProgram::ask(Link& link) {
  std::array<char, 16> line;
  while (link.open() && asked_ < wanted_) {
    const int size = std::snprintf(line.data(), line.size(), "%d\n", ++asked_);
    link.send_text({line.data(), static_cast<std::size_t>(size)});
  }
}

void WaypointProgram::take(Link& link, Machine& machine) {
  std::array<char, 512> line;
  std::size_t size = 0;
  while (!stopping_ && link.read_line(line.data(), line.size(), size)) {
    std::array<double, 14> numbers{};
    heard_s_ = machine.time_s();
    if (read_list({line.data(), size}, numbers) == numbers.size()) {
      add(numbers);
    } else {
      machine.messages.text(
          "Received wrong number of floats in trajectory. This is certainly not OK.");
      stopping_ = true;
    }
  }
}

/// Adds a waypoint; one whose numbers after the first are all zero is the last.
void WaypointProgram::add(const std::array<double, 14>& numbers) {
  from_ = to_;
  to_ = next_;
  next_.q = Joints(numbers.data() + 1);
  next_.dq = Joints(numbers.data() + 7);
  next_.time_s = numbers[13];
  stopping_ =
      std::all_of(numbers.begin() + 1, numbers.end(), [](double value) { return value == 0.0; });
  received_ = integer(numbers[0] + (stopping_ ? 1.0 : 0.0));
}

ProgramStep WaypointProgram::command(Machine& machine) {
  for (int segments = 0; segments < kSegmentsAtOnce; ++segments) {
    if (phase_ == Phase::kWaiting) {
      if (received_ < wanted_) return wait(machine);
      begin_segment();
    }
    if (phase_ == Phase::kSettling) return settle(machine);
    if (elapsed_s_ <= to_.time_s) return follow(machine);
    phase_ = last_ ? Phase::kSettling : Phase::kWaiting;
  }
  return servo(hold_, machine.cycle_s(), machine);
}

void WaypointProgram::begin_segment() {
  phase_ = Phase::kFollowing;
  last_ = stopping_;
  waited_s_ = 0.0;
  ++wanted_;
}

/// Holds the position; a wait counts with the time of the text, although it takes a cycle.
ProgramStep WaypointProgram::wait(Machine& machine) {
  if (waited_s_ >= patience_s_) return end(machine, "Closing the connection on waiting too long.");
  waited_s_ += pause_s_;
  return servo(hold_, machine.cycle_s(), machine);
}

ProgramStep WaypointProgram::follow(Machine& machine) {
  hold_ = at(elapsed_s_ - from_.time_s);
  elapsed_s_ += interval_s_;
  return servo(hold_, servo_s_, machine);
}

ProgramStep WaypointProgram::settle(Machine& machine) {
  if (((machine.body.q() - to_.q).cwiseAbs().array() <= near_).all())
    return end(machine, "Finishing the controlling thread. Final position reached.");
  return servo(to_.q, servo_s_, machine);
}

ProgramStep WaypointProgram::servo(const Joints& q, double t, Machine& machine) {
  machine.motion.servo_j(q, t, law_);
  return ProgramStep::kRunning;
}

/// Returns the position at time t on the cubic with the positions and speeds of both ends.
Joints WaypointProgram::at(double t) const {
  const double whole = to_.time_s - from_.time_s;
  const Joints way = to_.q - from_.q;
  const Joints c = (3.0 * way - whole * (2.0 * from_.dq + to_.dq)) / (whole * whole);
  const Joints d = (-2.0 * way + whole * (from_.dq + to_.dq)) / (whole * whole * whole);
  return from_.q + t * (from_.dq + t * (c + t * d));
}

ProgramStep WaypointProgram::end(Machine& machine, std::string_view why) {
  machine.messages.text(why);
  if (Link* link = machine.links.find(place_.name); link != nullptr) link->close();
  return ProgramStep::kEnded;
}

}  // namespace tactus::ur
