// TrajectoryRun: the trajectory thread of external control. Points come one by one over a socket of
// their own; the result goes back over it.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/programs/trajectory_points.hpp"

namespace tactus::ur {

/// Of the script: how it brakes, rad/s^2, and the speed, rad/s, from which a command is ignored.
inline constexpr double kStopDeceleration = 4.0, kIgnoreSpeed = 20.0;

class TrajectoryRun {
 public:
  /// Features in which the texts of the script differ.
  struct Features {
    bool tells_cancelled = true;         ///< sends the result "cancelled"
    bool tells_left_only = false;        ///< sends no result if left with no point to come
    bool counts_cancelled = false;       ///< the cancel of a stream gives its number of points
    bool publishes_spline_time = false;  ///< in output_double_register_1
    PointFormat format;
  };
  void set_features(const Features& features) { features_ = features; }

  /// Starts a trajectory of `points`, or a stream whose number end_stream() will give. Remaining
  /// points of the last trajectory are discarded first.
  void start(std::int32_t points, bool stream, Machine& machine);
  /// Ends a stream, which has `points` in total; also allowed after it has failed.
  void end_stream(std::int32_t points);
  /// Brakes, discards the remaining points, and sends the result. `points`: as for end_stream().
  void cancel(std::int32_t points, Machine& machine);
  /// Leaves the trajectory, because the mode changes.
  void leave(Machine& machine);
  /// As cancel(), but sends no result.
  void drop(Machine& machine);

  /// Gives the next motion command. kWaiting: none now. kEnded: there is no trajectory. [cyclic]
  ProgramStep command(Machine& machine);
  bool active() const { return phase_ != Phase::kIdle; }
  /// True while points are being discarded; until then the script reads no message.
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
  void take_point(const TrajectoryPoint& point, Machine& machine);
  void take_spline(const TrajectoryPoint& point, bool last, Machine& machine);
  bool take_move(const TrajectoryPoint& point, Machine& machine);
  bool read_away(Machine& machine);
  void finish(TrajectoryResult result, Machine& machine);

  Features features_;
  Phase phase_ = Phase::kIdle;
  Then then_ = Then::kNothing;  // what follows the clearing
  std::int32_t next_points_ = 0;
  bool next_stream_ = false;
  bool stream_ = false;  // a stream whose end is not known
  bool first_ = true;
  std::int64_t left_ = 0;  // points; of a stream: kEndless less the points requested
  double waited_s_ = 0.0;
  TrajectoryResult result_ = kSucceeded;
  SplineRun spline_;
};

}  // namespace tactus::ur
