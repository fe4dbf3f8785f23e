#include "sim_plant/ur/programs/driver_program.hpp"

namespace tactus::ur {
namespace {

constexpr double kBrake = 1.0;       // rad/s^2
constexpr double kFarewell_s = 0.1;  // wait before the program closes its socket

}  // namespace

bool DriverProgram::recognises(std::string_view text) {
  SocketPlace place;
  return text.find("servoj(") != std::string_view::npos &&
         text.find("socket_read_binary_integer(") != std::string_view::npos &&
         find_socket(text, "socket_open", 0, place);
}

void DriverProgram::start(std::string_view text) {
  *this = {};
  find_socket(text, "socket_open", 0, place_);
  law_ = find_servo_law(text);
}

ProgramStep DriverProgram::poll(Machine& machine) {
  Link* link = machine.links.find(place_.name);
  if (link == nullptr) return ProgramStep::kEnded;
  if (!wanted_) {
    link->want(place_.name, place_.host, place_.port);
    wanted_ = true;
  }
  std::array<std::int32_t, kDriverInts> message;
  while (!ending_ && link->read_ints(message.data(), message.size())) {
    for (int i = 0; i < 6; ++i) q_[i] = message[static_cast<std::size_t>(i)] / kFixedPoint;
    fresh_ = true;
    ending_ = message[6] <= 0;
    end_s_ = machine.time_s() + kFarewell_s;
  }
  if (!ending_ || machine.time_s() < end_s_) return ProgramStep::kRunning;
  link->close();
  return ProgramStep::kEnded;
}

ProgramStep DriverProgram::command(Machine& machine) {
  if (fresh_) {
    machine.motion.servo_j(q_, machine.cycle_s(), law_);
  } else if (moving_) {
    machine.motion.stop_j(kBrake);
  }
  moving_ = fresh_;
  fresh_ = false;
  return machine.motion.busy() ? ProgramStep::kRunning : ProgramStep::kWaiting;
}

}  // namespace tactus::ur
