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
    bool tells_left_only = false;        ///< left with no point to come, it says nothing
    bool counts_cancelled = false;       ///< who cancels a stream says how many points it had
    bool publishes_spline_time = false;  ///< in output_double_register_1
    PointFormat format;
  };
  void set_features(const Features& features) { features_ = features; }

  /// `points` follow; or, as a stream, as many as end_stream() will say. What is left of the last
  /// one is read away first.
  void start(std::int32_t points, bool stream, Machine& machine);
  /// The stream has `points` in all. One that has failed may still be told.
  void end_stream(std::int32_t points);
  /// Ends it, brakes, reads away the points that are left, and says so. `points`: as end_stream().
  void cancel(std::int32_t points, Machine& machine);
  /// The mode changes.
  void leave(Machine& machine);
  /// As cancel(), but says nothing.
  void drop(Machine& machine);

  /// The next motion command. kWaiting: none now. kEnded: there is no trajectory. [cyclic]
  ProgramStep command(Machine& machine);
  bool active() const { return phase_ != Phase::kIdle; }
  /// Points are being read away; until then the script hears no message.
  bool clearing() const { return phase_ == Phase::kClearing; }

 private:
  enum class Phase : std::uint8_t { kIdle, kPoints, kSpline, kStopping, kClearing };

  enum class Then : std::uint8_t { kTell, kNothing, kStart };

  void clear(Then then, Machine& machine);
  ProgramStep cleared(Machine& machine);
  void begin();
  void tell(Machine& machine);
  bool spline_step(Machine& machine);
  ProgramStep next_point(Machine& machine);
  void take_point(const std::array<std::int32_t, kTrajectoryInts>& point, Machine& machine);
  void take_spline(const std::array<std::int32_t, kTrajectoryInts>& point, bool last,
                   Machine& machine);
  bool take_move(const std::array<std::int32_t, kTrajectoryInts>& point, Machine& machine);
  bool read_away(Machine& machine);
  void finish(TrajectoryResult result, Machine& machine);

  Features features_;
  Phase phase_ = Phase::kIdle;
  Then then_ = Then::kNothing;  // what follows the clearing
  std::int32_t next_points_ = 0;
  bool next_stream_ = false;
  bool stream_ = false;  // its end is not known
  bool first_ = true;
  std::int64_t left_ = 0;  // of a stream: kEndless less those that were asked for
  double waited_s_ = 0.0;
  TrajectoryResult result_ = kSucceeded;
  SplineRun spline_;
};

}  // namespace tactus::ur
