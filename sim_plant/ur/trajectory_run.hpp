// TrajectoryRun: the trajectory thread of external control. Points come one by one over a socket of
// their own; the result goes back over it.
#pragma once

#include "sim_plant/ur/machine.hpp"
#include "sim_plant/ur/program_step.hpp"
#include "sim_plant/ur/spline_run.hpp"
#include "sim_plant/ur/trajectory_move.hpp"

namespace tactus::ur {

class TrajectoryRun {
 public:
  /// What the text of the script has, or not.
  struct Features {
    bool tells_cancelled = true;         ///< the line that sends the result "cancelled"
    bool publishes_spline_time = false;  ///< in output_double_register_1
    PointFormat format;
  };
  void set_features(const Features& features) { features_ = features; }

  /// `points` follow; or, as a stream, as many as end_stream() will say.
  void start(std::int32_t points, bool stream, Machine& machine);
  void end_stream(std::int32_t points);
  /// Ends it, reads away the points that are left, brakes, and says so.
  void cancel(Machine& machine);
  /// As cancel(), if one is running.
  void preempt(Machine& machine);

  /// The next motion command. kWaiting: none now. kEnded: there is no trajectory. [cyclic]
  ProgramStep command(Machine& machine);
  bool active() const { return phase_ != Phase::kIdle; }

 private:
  enum class Phase : std::uint8_t { kIdle, kPoints, kSpline, kStopping, kClearing };

  bool spline_step(Machine& machine);
  ProgramStep next_point(Machine& machine);
  void take_point(const std::array<std::int32_t, kTrajectoryInts>& point, Machine& machine);
  void take_spline(const std::array<std::int32_t, kTrajectoryInts>& point, bool last,
                   Machine& machine);
  bool take_move(const std::array<std::int32_t, kTrajectoryInts>& point, Machine& machine);
  void read_away(Machine& machine);
  void finish(TrajectoryResult result, Machine& machine);

  Features features_;
  Phase phase_ = Phase::kIdle;
  bool stream_ = false, stream_ended_ = false;
  bool first_ = true;
  std::int32_t left_ = 0, taken_ = 0;
  double waited_s_ = 0.0;
  TrajectoryResult result_ = kSucceeded;
  SplineRun spline_;
};

}  // namespace tactus::ur
