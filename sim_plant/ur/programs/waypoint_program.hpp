// WaypointProgram: the low-bandwidth program of the ROS driver after 2015. It connects to the
// control computer and requests one waypoint after the other by a line with its number; the answer
// is a line of 14 numbers in brackets: number, six positions, six speeds, time. It servos along a
// cubic between waypoints. It ends after a waypoint of zeros, or if an answer does not come.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/programs/program_step.hpp"
#include "sim_plant/ur/programs/servo_script.hpp"

namespace tactus::ur {

class WaypointProgram {
 public:
  static bool recognises(std::string_view text);
  /// Starts the program; the text must outlive it.
  void start(std::string_view text);

  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

 private:
  struct Waypoint {
    Joints q = Joints::Zero(), dq = Joints::Zero();
    double time_s = 0.0;
  };
  enum class Phase : std::uint8_t { kWaiting, kFollowing, kSettling };

  void ask(Link& link);
  void take(Link& link, Machine& machine);
  void add(const std::array<double, 14>& numbers);
  void begin_segment();
  ProgramStep wait(Machine& machine);
  ProgramStep follow(Machine& machine);
  ProgramStep settle(Machine& machine);
  ProgramStep servo(const Joints& q, double t, Machine& machine);
  Joints at(double time_s) const;
  ProgramStep end(Machine& machine, std::string_view why);

  SocketPlace place_;
  ServoLaw law_;
  // Values set by the text, s and rad.
  double interval_s_ = 0.008, servo_s_ = 0.008, pause_s_ = 0.001, patience_s_ = 2.0, near_ = 0.01;

  bool begun_ = false, stopping_ = false, last_ = false;
  int asked_ = -1, wanted_ = 2, received_ = -1;  // numbers of waypoints
  double heard_s_ = 0.0;                         // when the last one came
  Waypoint from_, to_, next_;
  Phase phase_ = Phase::kWaiting;
  double waited_s_ = 0.0, elapsed_s_ = 0.0;
  Joints hold_ = Joints::Zero();
};

}  // namespace tactus::ur
